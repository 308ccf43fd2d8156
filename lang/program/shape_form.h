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

/// The formulas consist of numbers, items, and functions of numbers and vectors. They read no
/// definitions. A formula that the script does not give has no nodes.
struct ShapeForm {
    /// Values, besides the quantities, that formulas can read. They are the first items.
    enum Known : std::uint32_t { t, s, part, known_count };

    std::string name;
    Span span;  ///< Where the name is in the script.
    bool built_in = false;
    /// First the values of Known, then the shape's own quantities.
    IdVector<ItemId, Quantity> quantities;
    /// For each quantity, the value that applies if a picture gives no value.
    std::vector<double> usual;
    /// The position of a point of the surface, as a vector. Empty if `radius` is given.
    Formula place;
    /// If the shape is a tube: its radius, as a number, and the line in its middle, as a vector. If
    /// `middle` is empty, the line goes straight up from 0 to 1.
    Formula radius, middle;
    Formula shade;  ///< The shade of the surface, a number in 0 … 1.
    std::uint32_t parts = 1;

    /// The quantity with this name. nullopt if there is no such quantity, or if pictures cannot set
    /// it.
    std::optional<ItemId> find(std::string_view quantity) const;
};

/// Computes a formula of a shape at points of one part, in binary64. Nodes that depend on neither t
/// nor s are computed only once. Nodes that depend on t but not on s are computed once for each t.
/// Not thread-safe.
class ShapeFunction {
public:
    /// `values` are indexed by item. The values of Known are ignored. `formula` must not be empty.
    ShapeFunction(const Formula& formula, std::span<const double> values, double part);

    /// The value of the formula at t and s. If this value is a number, it is the x of the result.
    Vector3d operator()(double t, double s);

private:
    void compute(NodeId id);

    Nodes nodes_;
    IdVector<NodeId, Vector3d> values_;
    /// The nodes that depend only on t, and the nodes that depend on s.
    std::vector<NodeId> of_t_, of_s_;
    std::vector<NodeId> reads_t_, reads_s_;
    std::optional<double> t_;  ///< The t for which the stored values were computed.
};

}  // namespace cascade
