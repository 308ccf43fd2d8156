// Crawling cells as things in space: a shape, a position and measures for each.
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

/// The cells of a stage that have a size, in ascending order of their numbers. All lengths are in
/// script units.
struct DrawnCells {
    std::shared_ptr<const FileShape> file;  ///< For the shape of a file. Otherwise null.
    ShapeForm form;                         ///< The shape of formulas, without a file.
    double detail = 0.5;                    ///< In pixels of pictures.
    std::vector<ShapeValues> shapes;        ///< The form's shapes in use.
    std::vector<Placement> placements;      ///< `mesh` is the shape. Without colours.
    std::vector<std::size_t> cells;    ///< By placement: the index of its cell in number_order().
    std::size_t count = 0;             ///< All cells, including those without a size.
    Colour skin{0.25F, 0.24F, 0.23F};  ///< The surface below them, sRGB, unless it has a coat.
    /// The grown body below them, in script lengths, and the colours of its points (sRGB). Null
    /// elsewhere.
    std::shared_ptr<const SurfaceMesh> body;
    std::vector<Colour> body_colours;
    /// Colours of the skin, held by fields in the cells of a model or plane. Otherwise null.
    std::shared_ptr<const ModelLook> coat;
    std::shared_ptr<const Image> floor;
    Vector3d extent;    ///< The size of the plane, or of the box in space.
    std::string fault;  ///< The message about cells that cannot be drawn. "" if all can.
};

/// True if a stage that runs has crawling cells.
bool has_cells(const Script& script);

/// Places the cells by the settings of the picture block, some of which may be missing. Settings
/// that read something without a value yet count as missing, too. `file` comes from picture_file().
/// Without it, the file is read.
DrawnCells drawn_cells(Script& script, const Simulation& simulation, std::uint32_t stage,
                       std::shared_ptr<const FileShape> file = nullptr);

/// The shape of the file named in the picture block. Null if none is named. Fails as read_shape()
/// does.
Result<std::shared_ptr<const FileShape>> picture_file(Script& script);

/// The values of a plane of a tissue in ascending order of the cells' numbers.
std::vector<double> number_order(const Field& field, const Tissue& tissue);

/// The same as one row of binary32, or a single NaN if there are no cells.
Field row_of_cells(const Field& field, const Tissue& tissue);

/// The cells of a stage in ascending order of their numbers, in script lengths.
struct PlacedFrames {
    std::vector<Vector3d> places;
    std::vector<Quaternion> turns;  ///< The rotations of their axes, of length 1.
    std::vector<double> radii;
};
PlacedFrames frames_of(const Simulation& simulation, std::uint32_t stage);

/// Meshes whose facets are at most `detail` pixels from their shapes, if a length of 1 has
/// `pixels`. Throws std::bad_alloc.
Instances instances_of(const DrawnCells& cells, double pixels, double detail);

}  // namespace cascade
