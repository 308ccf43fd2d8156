// The shapes of crawling cells by a script's formulas, as meshes.
#pragma once

#include "lang/program/shape_form.h"
#include "mesh/shape_parts.h"

#include <span>
#include <string>
#include <vector>

namespace cascade {

/// A shape's values, one for each of its quantities (ShapeForm::quantities).
using ShapeValues = std::vector<double>;

/// Coordinates of points beyond this make no picture.
inline constexpr double largest_of_shape = 1000;

/// The parts of a shape with these values.
std::vector<ShapePart> parts_of(const ShapeForm& form, std::span<const double> values);

/// Why a shape cannot be drawn, such as "is not finite at t = 0.5, s = 0". "" if it is sound at the
/// points tested.
std::string fault_of(const ShapeForm& form, std::span<const double> values);

/// The values of quantities for many cells at once.
struct QuantityValues {
    ItemId quantity;
    std::vector<double> of_cells;  ///< One for each cell, possibly not finite.
};

/// The shapes of cells. Values are clamped to the ranges of quantities and rounded, so that many
/// cells share one shape: to the step of the range, or to sixteenths of it or, without a range, of
/// the span of the cells' values. If there are still more than `most` shapes, the rounding is
/// doubled repeatedly.
struct SharedShapes {
    std::vector<ShapeValues> shapes;
    std::vector<std::uint32_t> of_cells;  ///< Indices. `none` where a value is not finite.
    static constexpr std::uint32_t none = UINT32_MAX;
};
inline constexpr std::size_t most_shapes = 1000;
SharedShapes share_shapes(const ShapeForm& form, std::span<const QuantityValues> values,
                          std::size_t cell_count, std::size_t most = most_shapes);

}  // namespace cascade
