// Rules for comparisons and logic, from the whole condition to its parts.
#include "lang/calculus/margin.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace cascade {

namespace {

bool joins_conditions(const Node& node) {
    return node.calls(Function::logical_and) || node.calls(Function::logical_or) ||
           node.calls(Function::logical_not);
}

class MarginRules {
public:
    explicit MarginRules(const Formula& condition) : nodes_(condition.nodes) {}

    /// Goes through the list twice instead of down the operands, however deeply they are nested.
    Formula run() && {
        const std::size_t count = nodes_.size();
        std::vector<bool> is_condition(count, false);
        is_condition.back() = true;
        for (std::size_t k = count; k-- > 0;) {
            const Node& node = nodes_[NodeId(k)];
            if (!is_condition[k] || !joins_conditions(node)) continue;
            for (const NodeId part : node.reads()) is_condition[part.index()] = true;
        }
        margins_.resize(count);
        for (std::size_t k = 0; k < count; ++k) {
            if (is_condition[k]) margins_[k] = margin(NodeId(k));
        }
        return formula_of(nodes_, margins_.back());
    }

private:
    NodeId add(NodeKind kind) {
        Node node;
        node.kind = kind;
        nodes_.push_back(node);
        return NodeId(nodes_.size() - 1);
    }

    NodeId call(Function function, std::initializer_list<NodeId> operands) {
        const NodeId id = add(Call{});
        nodes_[id].function = function;
        nodes_[id].operand_count = static_cast<std::uint8_t>(operands.size());
        std::ranges::copy(operands, nodes_[id].operands.begin());
        return id;
    }

    NodeId margin(NodeId condition) {
        const Node node = nodes_[condition];
        const NodeId a = node.operands[0], b = node.operands[1];
        const auto of = [this](NodeId part) { return margins_[part.index()]; };
        if (node.is<Call>()) {
            switch (node.function) {
                case Function::greater:
                case Function::greater_equal: return call(Function::subtract, {a, b});
                case Function::less:
                case Function::less_equal: return call(Function::subtract, {b, a});
                case Function::logical_and: return call(Function::min, {of(a), of(b)});
                case Function::logical_or: return call(Function::max, {of(a), of(b)});
                case Function::logical_not: return call(Function::negate, {of(a)});
                default: break;
            }
        }
        return call(Function::if_, {condition, add(1.0), add(-1.0)});
    }

    Nodes nodes_;
    std::vector<NodeId> margins_;  ///< By node of the condition.
};

}  // namespace

Formula margin_of(const Formula& condition) { return MarginRules(condition).run(); }

}  // namespace cascade
