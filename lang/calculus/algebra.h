// Expression graphs that simplify themselves, for formulas derived from formulas (derivatives).
// Values of patterns are always computed by formulas as they were written.
#pragma once

#include "lang/program/flatten.h"

namespace cascade {

/// Constants are folded. Sums and products are simplified if an operand is 0 or 1 or both are
/// numbers. A product with 0 is 0, even if the other factor may be infinite or NaN.
class Algebra : public ExpressionGraph {
public:
    NodeId call(Function function, std::initializer_list<NodeId> operands,
                ValueType type = ValueType::number) override;
    /// The function of a node, applied to its one to three operands, which are nodes of this graph.
    NodeId call_of(const Node& node);

    NodeId sum(NodeId a, NodeId b) { return call(Function::add, {a, b}); }
    NodeId difference(NodeId a, NodeId b) { return call(Function::subtract, {a, b}); }
    NodeId product(NodeId a, NodeId b) { return call(Function::multiply, {a, b}); }
    NodeId quotient(NodeId a, NodeId b) { return call(Function::divide, {a, b}); }
    NodeId negative(NodeId a) { return call(Function::negate, {a}); }
    NodeId magnitude(NodeId a) { return call(Function::abs, {a}); }
    NodeId maximum(NodeId a, NodeId b) { return call(Function::max, {a, b}); }
    Formula formula(NodeId root) const { return formula_of(nodes(), root); }

private:
    std::optional<NodeId> simpler(Function function, const Operands& operands);
};

/// The rules of calculus give up on larger formulas, which would cost more than they are worth.
inline constexpr std::size_t most_calculus_nodes = 100'000;

/// The rates of a system in one graph.
struct FlatRates {
    Algebra algebra;  ///< Holds the nodes of the rates first, then nodes made from them.
    Flattening flattening;
    std::size_t count = 0;  ///< The nodes below this number belong to the rates.

    /// With a space, vectors of fields are written out.
    explicit FlatRates(const System& system, const std::optional<FieldSpace>& space = {})
        : flattening(algebra, space) {
        flattening.add_rates(system);
        count = algebra.size();
    }
    FlatRates(const FlatRates&) = delete;
    NodeId rate(ItemId species) const { return flattening.rate(species); }
};

/// What a formula reads of definitions and rates becomes part of it. The system must be sound.
Formula without_definitions(const System& system, const Formula& formula);
/// The distances of a formula's sums `over near(d)`.
std::vector<Formula> near_distances(const Formula& formula);

}  // namespace cascade
