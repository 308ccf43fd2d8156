// Crawling cells as objects in space, each with a shape, a position and a size.
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

/// The cells of a stage that are large enough to draw, in ascending order of their numbers. All
/// lengths are in the script's unit.
struct DrawnCells {
    /// The shape, if it comes from a file. Null if the shape is given by formulas.
    std::shared_ptr<const FileShape> file;
    ShapeForm form;  ///< The shape given by formulas, which is used if there is no file.
    /// The largest distance between facets and the shape, in pixels.
    double detail = 0.5;
    /// The shapes of `form` that are in use, each by the values of its quantities.
    std::vector<ShapeValues> shapes;
    /// A placement for each drawn cell. Its member `mesh` refers to a shape. It has no colour.
    std::vector<Placement> placements;
    /// For each placement, the index of its cell in number_order().
    std::vector<std::size_t> cells;
    /// The number of all cells, including cells that are too small to draw.
    std::size_t count = 0;
    /// The colour of the surface below the cells, in sRGB, unless it has a coat.
    Colour skin{0.25F, 0.24F, 0.23F};
    /// The grown body below the cells, in the script's unit of length, and the colours of its
    /// points in sRGB. Null if there is no body.
    std::shared_ptr<const SurfaceMesh> body;
    std::vector<Colour> body_colours;
    /// The coat: the colours that fields give to the points of a model below the cells. Null if
    /// there is no coat. The colours of a plane below the cells are in `floor`.
    std::shared_ptr<const ModelLook> coat;
    std::shared_ptr<const Image> floor;
    Vector3d extent;  ///< The size of the plane or box that contains the cells.
    /// A message about cells that cannot be drawn. Empty if all cells can be drawn.
    std::string fault;
};

/// Places the cells by the settings of the picture block. A setting has its default if it is
/// missing or reads a value that does not exist yet. `file` is the result of picture_file(). If it
/// is null, this function reads the file.
DrawnCells drawn_cells(Script& script, const Simulation& simulation, std::uint32_t stage,
                       std::shared_ptr<const FileShape> file = nullptr);

/// Reads the shape from the file that the picture block names. Returns null if the picture block
/// names no file. Fails in the same cases as read_shape().
Result<std::shared_ptr<const FileShape>> picture_file(Script& script);

/// Returns the values of a tissue's plane, in ascending order of the cells' numbers.
std::vector<double> number_order(const Field& field, const Tissue& tissue);

/// Returns the values of number_order() as one row in binary32. If there are no cells, the row is a
/// single NaN.
Field row_of_cells(const Field& field, const Tissue& tissue);

/// The positions, rotations and radii of a stage's cells, in ascending order of their numbers and
/// in the script's unit of length.
struct PlacedFrames {
    std::vector<Vector3d> places;
    /// The rotations of the cells' axes, as quaternions of length 1.
    std::vector<Quaternion> turns;
    std::vector<double> radii;
};
PlacedFrames frames_of(const Simulation& simulation, std::uint32_t stage);

/// Makes meshes whose facets deviate from their shapes by at most `detail` pixels, in a picture in
/// which a length of 1 is `pixels` pixels long. Throws std::bad_alloc.
Instances instances_of(const DrawnCells& cells, double pixels, double detail);

}  // namespace cascade
