// Turns sums that have a product as an operand into multiply-adds, and turns divisions by a uniform
// value into products with its reciprocal. Whether a sum is fused depends only on the expressions,
// not on the planes to which nodes are written later. So every plan of a step computes the same
// bits.
#include "lang/lower/graph_passes.h"
#include "lang/lower/plan_graph.h"
#include "lang/program/calls.h"

#include <optional>

namespace cascade::lowering {

namespace {

class FusedProducts : public GraphPass {
public:
    FusedProducts(const Expressions& from, const PassContext& context)
        : GraphPass(from, context), facts_(from, context) {}

private:
    /// A product that may be fused. A uniform factor comes first.
    struct Product {
        NodeId first, second;
        bool has_coefficient = false;
    };

    /// Whether the value may change during a stage. A value that cannot change is computed once,
    /// and is rounded then.
    bool may_change(NodeId old) const {
        return !facts_.is_uniform(old) && !facts_.is_step_invariant(old) &&
               facts_.sides(old) == nullptr && facts_[old].type == ValueType::number;
    }

    bool is_scaled(NodeId old) const {
        return facts_[old].calls(Function::divide) && facts_.is_uniform(facts_[old].operands[1]);
    }

    std::optional<Product> product(NodeId old) {
        if (!may_change(old)) return std::nullopt;
        const auto [a, b, c, d, e, f] = facts_[old].operands;
        if (is_scaled(old)) {
            return Product{leaf(1.0) / term(image(b)), image(a), true};
        }
        if (!facts_[old].calls(Function::multiply)) return std::nullopt;
        const bool swaps = facts_.is_uniform(b);
        return Product{image(swaps ? b : a), image(swaps ? a : b), swaps || facts_.is_uniform(a)};
    }

    NodeId image_of(const Node& node) override {
        if (!may_change(at())) return keep(node);
        if (is_scaled(at())) {
            const auto quotient = product(at());
            return term(quotient->first) * term(quotient->second);
        }
        const auto [a, b, c, d, e, f] = facts_[at()].operands;
        if (!calls(node, is_sum) || a == b) return keep(node);
        const auto left = product(a), right = product(b);
        if (!left && !right) return keep(node);
        // Fuses the only product. If both operands are products, fuses the first if only the first
        // has a uniform factor, and otherwise fuses the second.
        const bool fuses_left =
            left && (!right || (left->has_coefficient && !right->has_coefficient));
        auto [first, second, has_coefficient] = fuses_left ? *left : *right;
        NodeId added = image(fuses_left ? b : a);
        if (node.calls(Function::subtract)) {
            // Negates the varying factor, because a negated uniform factor would need another
            // register.
            NodeId& turned = fuses_left ? added : second;
            turned = -term(turned);
        }
        Node sum = node;
        sum.function = Function::multiply_add;
        sum.operands = {first, second, added};
        sum.operand_count = 3;
        return keep(sum);
    }

    PlanGraph facts_;  ///< Facts about the old graph.
};

}  // namespace

Expressions fuse_products(const Expressions& from, const PassContext& context) {
    return FusedProducts(from, context).run();
}

}  // namespace cascade::lowering
