// Makes the meshes of crawling cells from the formulas of a shape.
#pragma once

#include "lang/program/shape_form.h"
#include "mesh/shape_parts.h"

#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The values that determine a shape, one for each of its quantities (ShapeForm::quantities).
using ShapeValues = std::vector<double>;

/// The largest absolute value of a coordinate of a shape. A shape with larger coordinates is not
/// drawn.
inline constexpr double largest_of_shape = 1000;

/// Returns the parts of the shape that these values of its quantities give.
std::vector<ShapePart> parts_of(const ShapeForm& form, std::span<const double> values);

/// Says why a shape cannot be drawn, such as "is not finite at t = 0.5, s = 0". Returns an empty
/// string if all tested points of the shape are finite and not too far away.
std::string fault_of(const ShapeForm& form, std::span<const double> values);

/// The values of a quantity in all cells.
struct QuantityValues {
    ItemId quantity;
    /// The value in each cell. May contain values that are not finite.
    std::vector<double> of_cells;
};

/// Shapes that many cells share. To reduce the number of shapes, the values of quantities are
/// clamped to their ranges and rounded. If a range has a step, values are rounded to multiples of
/// it. If a range has no step, they are rounded to multiples of 1/16 of the range. Without a range,
/// they are rounded to multiples of 1/16 of the difference between the largest and the smallest
/// value. The distance between rounded values is doubled until there are at most `most` shapes.
struct SharedShapes {
    std::vector<ShapeValues> shapes;
    /// For each cell, the index of its shape. `none` if a value of the cell is not finite.
    std::vector<std::uint32_t> of_cells;
    static constexpr std::uint32_t none = UINT32_MAX;
};
inline constexpr std::size_t most_shapes = 1000;
SharedShapes share_shapes(const ShapeForm& form, std::span<const QuantityValues> values,
                          std::size_t cell_count, std::size_t most = most_shapes);

}  // namespace cascade
