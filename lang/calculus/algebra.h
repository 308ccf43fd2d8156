// Expression graphs that simplify themselves. Used for formulas that are derived from other
// formulas, such as derivatives. A pattern is always computed by the formulas as their author wrote
// them, without these simplifications.
#pragma once

#include "lang/program/flatten.h"

namespace cascade {

/// A graph in which functions of constants are evaluated, and sums and products are simplified if
/// an operand is 0 or 1. A product with 0 becomes 0, although the other factor may be infinite or
/// NaN.
class Algebra : public ExpressionGraph {
public:
    NodeId call(Function function, std::initializer_list<NodeId> operands,
                ValueType type = ValueType::number) override;
    /// Applies the function of a node to the node's operands. There must be one to three operands,
    /// which are nodes of this graph.
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

/// The largest formula to which the rules of calculus are applied. Derivatives of larger formulas
/// would cost more time than they save.
inline constexpr std::size_t most_calculus_nodes = 100'000;

/// The rates of a system in one graph.
struct FlatRates {
    /// The graph. The nodes of the rates come first, followed by nodes computed from them.
    Algebra algebra;
    Flattening flattening;
    /// The number of nodes that belong to the rates. They are the first nodes of the graph.
    std::size_t count = 0;

    /// If `space` is given, vectors of fields are expanded into components.
    explicit FlatRates(const System& system, const std::optional<FieldSpace>& space = {})
        : flattening(algebra, space) {
        flattening.add_rates(system);
        count = algebra.size();
    }
    FlatRates(const FlatRates&) = delete;
    NodeId rate(ItemId species) const { return flattening.rate(species); }
};

/// The formula, in which the formulas of definitions and rates take the place of the nodes that
/// read them. The system must be free of errors.
Formula without_definitions(const System& system, const Formula& formula);
/// The distances d of the sums `over near(d)` in a formula.
std::vector<Formula> near_distances(const Formula& formula);

}  // namespace cascade
