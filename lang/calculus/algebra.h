// Expression graphs that simplify themselves. Used for formulas derived from other formulas, such
// as derivatives. A pattern is always computed by formulas as their author wrote them, without
// these simplifications.
#pragma once

#include "lang/program/flatten.h"

namespace cascade {

/// A graph in which functions of constants are evaluated, and sums and products are simplified if
/// an operand is 0 or 1 or if both operands are numbers. A product with 0 becomes 0, although the
/// other factor may be infinite or NaN.
class Algebra : public ExpressionGraph {
public:
    NodeId call(Function function, std::initializer_list<NodeId> operands,
                ValueType type = ValueType::number) override;
    /// Applies the function of a node to the node's operands, which must be one to three nodes of
    /// this graph.
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
    Algebra algebra;  ///< The nodes of the rates come first, then nodes computed from them.
    Flattening flattening;
    std::size_t count = 0;  ///< Nodes below this number belong to the rates.

    /// If `space` is given, vectors of fields are expanded into components.
    explicit FlatRates(const System& system, const std::optional<FieldSpace>& space = {})
        : flattening(algebra, space) {
        flattening.add_rates(system);
        count = algebra.size();
    }
    FlatRates(const FlatRates&) = delete;
    NodeId rate(ItemId species) const { return flattening.rate(species); }
};

/// The formula, with each definition and rate in it replaced by that definition's or rate's
/// formula. The system must be free of errors.
Formula without_definitions(const System& system, const Formula& formula);
/// The distances d of the sums `over near(d)` in a formula.
std::vector<Formula> near_distances(const Formula& formula);

}  // namespace cascade
