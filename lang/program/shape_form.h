// A checked `shape` block: surfaces by formulas of t, from the root 0 to the tip 1, and s, around
// 0 … 1.
#pragma once

#include "core/vector3.h"
#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The most parts of a shape.
inline constexpr std::uint32_t most_shape_parts = 1000;

/// Formulas are made of numbers, items and functions of numbers and vectors; they read no
/// definitions. Those that a script does not say are empty.
struct ShapeForm {
    /// What formulas know besides the quantities: the first items.
    enum Known : std::uint32_t { t, s, part, known_count };

    std::string name;
    Span span;  ///< Of the name.
    bool built_in = false;
    IdVector<ItemId, Quantity> quantities;  ///< Those of Known, which have no values, then its own.
    std::vector<double> usual;              ///< The values of the same where a picture says none.
    Formula place;                          ///< A vector; else there is a radius.
    Formula radius, middle;  ///< A number and a vector; without `middle`, straight upwards to 1.
    Formula shade;           ///< A number, 0 … 1.
    std::uint32_t parts = 1;

    /// The quantity of a name that a picture can give.
    std::optional<ItemId> find(std::string_view quantity) const;
};

/// Computes a formula of a shape at points of one part, in binary64. What does not depend on t and
/// s is computed once, what does not depend on s once for each t. One thread at a time.
class ShapeFunction {
public:
    /// `values` are by item; those of Known are ignored. `formula` is not empty.
    ShapeFunction(const Formula& formula, std::span<const double> values, double part);

    /// A number is the x of the result.
    Vector3d operator()(double t, double s);

private:
    void compute(NodeId id);

    Nodes nodes_;
    IdVector<NodeId, Vector3d> values_;
    std::vector<NodeId> of_t_, of_s_;  ///< Those that depend on t alone, and on s.
    std::vector<NodeId> reads_t_, reads_s_;
    std::optional<double> t_;  ///< For which the values are.
};

}  // namespace cascade
