// Expression graphs that simplify themselves, for formulas about formulas (derivatives): values
// that reach a user's pattern are computed by formulas as they were written.
#pragma once

#include "lang/program/flatten.h"

namespace cascade {

/// Numbers are computed. Sums and products are simplified where a 0, a 1 or two numbers meet; a
/// product with 0 is 0, whatever the other factor.
class Algebra : public ExpressionGraph {
public:
    NodeId call(Function function, std::initializer_list<NodeId> operands,
                ValueType type = ValueType::number) override;

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

/// The rules of calculus give up on formulas larger than this, which cost more than they tell.
inline constexpr std::size_t most_calculus_nodes = 100'000;

/// The rates of a system in one graph.
struct FlatRates {
    Algebra algebra;  ///< Holds the nodes of the rates first and whatever is made of them after.
    Flattening flattening{algebra};
    std::size_t count = 0;  ///< Nodes that the rates are made of are below this.

    explicit FlatRates(const System& system) {
        flattening.add_rates(system);
        count = algebra.size();
    }
    FlatRates(const FlatRates&) = delete;
    NodeId rate(std::uint32_t item) const { return flattening.rate(item); }
};

}  // namespace cascade
