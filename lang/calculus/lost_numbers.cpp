// Finds comparisons whose operands may be NaN.
#include "lang/calculus/lost_numbers.h"

#include "lang/program/nodes_of_rates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace cascade {
/// Whether the node can produce a NaN from finite numbers.
bool LostNumbers::makes_nan(const Node& node) const {
    const auto* const second = flat_.algebra[node.operands[1]].as<double>();
    switch (info(node.function).behaviour) {
        case Behaviour::plain:
        case Behaviour::jumps:
        case Behaviour::chooses: return false;
        case Behaviour::partial: return true;
        case Behaviour::divides: return second == nullptr;
        case Behaviour::raises: return second == nullptr || *second != std::floor(*second);
    }
    return false;
}

void LostNumbers::know_all_parts() {
    while (may_be_nan_.size() < flat_.algebra.size()) {
        const Node& node = flat_.algebra[may_be_nan_.next()];
        bool may = false, is_of_file = false;
        if (node.is<Call>()) {
            may = makes_nan(node);
            is_of_file = reads_file(node.function);
            for (const NodeId operand : node.reads()) {
                may = may || may_be_nan_[operand];
                is_of_file = is_of_file || reads_file_[operand];
            }
            // The result of a comparison is 0 or 1, even if an operand is NaN.
            may = may && !is_of_file && !is_comparison(node.function);
        }
        may_be_nan_.push_back(may);
        reads_file_.push_back(is_of_file);
    }
}

bool LostNumbers::is_random(NodeId root) const {
    return holds_in(flat_.algebra.formula(root), is_draw);
}

/// Finds the comparisons of a formula, and the conditions under which their results matter. Works
/// without recursion, so formulas may be of any depth.
class LostNumbers::Search {
public:
    Search(Algebra& algebra, const IdVector<NodeId, bool>& may_be_nan)
        : algebra_(algebra), may_be_nan_(may_be_nan), seen_(may_be_nan.size(), false) {}

    void find_comparisons(NodeId root) {
        visit_later(root, none);
        while (!waiting_.empty() && found_.size() < most_found) {
            const auto [id, guard] = waiting_.back();
            waiting_.pop_back();
            visit(id, guard);
        }
    }
    void find_whole(NodeId root) {
        if (may_be_nan_[root]) add(root, none);
    }
    std::vector<LostNumber> found() && { return std::move(found_); }

private:
    static constexpr std::size_t none = SIZE_MAX;
    /// Limits of the search. Formulas that people write have far fewer comparisons and conditions.
    static constexpr std::size_t most_found = 64, most_guards = 64;

    /// A condition that decides in which cells the values of some subexpressions matter. They
    /// matter where the node `part` is not 0 or, if `is_zero`, where `part` is 0. `around` is the
    /// index of the enclosing condition.
    struct Guard {
        NodeId part;
        bool is_zero = false;
        std::size_t around = none;
        std::size_t depth = 1;
    };

    std::size_t inside(std::size_t guard, NodeId part, bool is_zero) {
        const std::size_t depth = guard == none ? 1 : guards_[guard].depth + 1;
        guards_.push_back({part, is_zero, guard, depth});
        return guards_.size() - 1;
    }

    /// Adds a node to the nodes to visit. A node that several nodes read is visited only once.
    void visit_later(NodeId id, std::size_t guard) {
        if (seen_[id] || (guard != none && guards_[guard].depth > most_guards)) return;
        seen_[id] = true;
        waiting_.emplace_back(id, guard);
    }

    void visit(NodeId id, std::size_t guard) {
        const Node node = algebra_[id];
        if (!node.is<Call>()) return;
        const NodeId first = node.operands[0], second = node.operands[1];
        switch (node.function) {
            case Function::if_:
                visit_later(first, guard);
                visit_later(second, inside(guard, first, false));
                visit_later(node.operands[2], inside(guard, first, true));
                return;
            case Function::logical_and:
            case Function::multiply:
                visit_later(first, inside(guard, second, false));
                visit_later(second, inside(guard, first, false));
                return;
            case Function::logical_or:
                visit_later(first, inside(guard, second, true));
                visit_later(second, inside(guard, first, true));
                return;
            default: break;
        }
        for (const NodeId operand : node.reads()) {
            if (is_comparison(node.function) && may_be_nan_[operand]) add(operand, guard);
            visit_later(operand, guard);
        }
    }

    void add(NodeId id, std::size_t guard) {
        NodeId lost = algebra_.call(Function::not_equal, {id, id});
        for (; guard != none; guard = guards_[guard].around) {
            const Function holds = guards_[guard].is_zero ? Function::equal : Function::not_equal;
            lost = algebra_.call(Function::logical_and,
                                 {lost,
                                  algebra_.call(holds, {guards_[guard].part, algebra_.number(0)})});
        }
        found_.push_back({algebra_.formula(lost), algebra_[id].span});
    }

    Algebra& algebra_;
    const IdVector<NodeId, bool>& may_be_nan_;
    IdVector<NodeId, bool> seen_;
    /// The subexpressions to visit. For each, the index of its innermost guard.
    std::vector<std::pair<NodeId, std::size_t>> waiting_;
    std::vector<Guard> guards_;
    std::vector<LostNumber> found_;
};

std::vector<LostNumber> LostNumbers::in_comparisons(NodeId root) {
    know_all_parts();
    if (is_random(root)) return {};
    Search search(flat_.algebra, may_be_nan_);
    search.find_comparisons(root);
    return std::move(search).found();
}

std::vector<LostNumber> LostNumbers::in_comparisons(const Formula& formula) {
    return formula.nodes.empty() ? std::vector<LostNumber>()
                                 : in_comparisons(flat_.flattening.add(formula));
}

std::vector<LostNumber> LostNumbers::in_rate(ItemId species) {
    return in_comparisons(flat_.rate(species));
}

std::vector<LostNumber> LostNumbers::as_whole(const Formula& formula) {
    const NodeId root = flat_.flattening.add(formula);
    know_all_parts();
    if (is_random(root)) return {};
    Search search(flat_.algebra, may_be_nan_);
    search.find_whole(root);
    return std::move(search).found();
}

}  // namespace cascade
