// Cells that crawl as things in space: a shape, a place and measures for each.
#pragma once

#include "mesh/instances.h"
#include "picture/image.h"
#include "run/domain/model_cells.h"
#include "run/pictures/file_shape.h"
#include "run/pictures/shape_meshes.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cascade {

class Tissue;
struct ModelLook;

/// The cells of a stage that have a size, in ascending order of their numbers. Lengths are those of
/// scripts.
struct DrawnCells {
    std::shared_ptr<const FileShape> file;  ///< If the shape is that of a file, else null.
    ShapeForm form;                         ///< Else that of formulas.
    double detail = 0.5;                    ///< Of pictures, in pixels.
    std::vector<ShapeValues> shapes;        ///< Of the form: those in use.
    std::vector<Placement> placements;      ///< `mesh` is the shape. Without colours.
    std::vector<std::size_t> cells;    ///< By placement: the place of its cell in number_order().
    std::size_t count = 0;             ///< Of all cells, also of those without a size.
    Colour skin{0.25F, 0.24F, 0.23F};  ///< Of the surface below them, sRGB, unless it has a coat.
    /// The grown body that they are on, in lengths of scripts, and the colours of its points
    /// (sRGB); null elsewhere.
    std::shared_ptr<const SurfaceMesh> body;
    std::vector<Colour> body_colours;
    /// Colours of the skin at the cells of a model, or of a plane, that fields have; else null.
    std::shared_ptr<const ModelLook> coat;
    std::shared_ptr<const Image> floor;
    Vector3d extent;    ///< Of the plane, or of the box of space.
    std::string fault;  ///< The message about cells that cannot be drawn; "" if all can.
};

/// True if a stage that runs is one of cells that crawl.
bool has_cells(const Script& script);

/// Places the cells as the settings of the picture block say, of which some may be missing.
/// Settings that read what has no value yet count as missing, too. `file` is that of
/// picture_file(); without it, the file is read.
DrawnCells drawn_cells(Script& script, const Simulation& simulation, std::uint32_t stage,
                       std::shared_ptr<const FileShape> file = nullptr);

/// The shape of the file that the picture block names; null if it names none. Fails as read_shape()
/// does.
Result<std::shared_ptr<const FileShape>> picture_file(Script& script);

/// The values of a plane of a tissue in ascending order of the cells' numbers.
std::vector<double> number_order(const Field& field, const Tissue& tissue);

/// The same as one row of binary32; a single NaN if there are no cells.
Field row_of_cells(const Field& field, const Tissue& tissue);

/// The cells of a stage in ascending order of their numbers, in lengths of scripts.
struct PlacedFrames {
    std::vector<Vector3d> places;
    std::vector<Quaternion> turns;  ///< Of their axes, of length 1.
    std::vector<double> radii;
};
PlacedFrames frames_of(const Simulation& simulation, std::uint32_t stage);

/// Meshes whose facets are at most `detail` pixels from their shapes, if a length of 1 has
/// `pixels`. Throws std::bad_alloc.
Instances instances_of(const DrawnCells& cells, double pixels, double detail);

}  // namespace cascade
