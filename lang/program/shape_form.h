// A checked `shape` block: surfaces given by formulas of t and s. The number t goes from 0 at the
// root to 1 at the tip, and s goes once around the shape, from 0 to 1.
#pragma once

#include "core/vector3.h"
#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The largest number of parts of a shape.
inline constexpr std::uint32_t most_shape_parts = 1000;

/// Formulas consist of numbers, items, and functions of numbers and vectors. They read no
/// definitions. A formula that the script does not give is empty.
struct ShapeForm {
    /// Values that formulas read besides the quantities. They are the first items.
    enum Known : std::uint32_t { t, s, part, known_count };

    std::string name;
    Span span;  ///< The span of the name.
    bool built_in = false;
    IdVector<ItemId, Quantity> quantities;  ///< First the values of Known, then the shape's own
                                            ///< quantities.
    std::vector<double> usual;  ///< For each quantity, the value if a picture gives none.
    Formula place;              ///< The position of a point, a vector. Empty if `radius` is given.
    Formula radius, middle;     ///< A tube: its radius, a number, and the line in its middle, a
                                ///< vector. If `middle` is empty, the line goes straight up to 1.
    Formula shade;              ///< A number, 0 … 1.
    std::uint32_t parts = 1;

    /// The quantity of this name. Empty if there is none that pictures can set.
    std::optional<ItemId> find(std::string_view quantity) const;
};

/// Computes a formula of a shape at points of one part, in binary64. Nodes that depend on neither t
/// nor s are computed once, and nodes that do not depend on s once for each t. Not thread-safe.
class ShapeFunction {
public:
    /// `values` are indexed by item. The values of Known are ignored. `formula` must not be empty.
    ShapeFunction(const Formula& formula, std::span<const double> values, double part);

    /// The value at t and s. If the formula is a number, the result's x is this number.
    Vector3d operator()(double t, double s);

private:
    void compute(NodeId id);

    Nodes nodes_;
    IdVector<NodeId, Vector3d> values_;
    std::vector<NodeId> of_t_, of_s_;  ///< Nodes that depend on t only, and nodes that depend on s.
    std::vector<NodeId> reads_t_, reads_s_;
    std::optional<double> t_;  ///< The t for which the stored values were computed.
};

}  // namespace cascade
