// Decides whether a product applies an operator, by searching its factors for a `lap` without
// brackets.
#include "lang/syntax/operator_polynomials.h"

#include "lang/vocabulary/function_groups.h"

#include <vector>

namespace cascade {

bool is_operator(const ast::Script& script, ast::ExprId node) {
    std::vector<ast::ExprId> waiting{node};
    while (!waiting.empty()) {
        const auto& part = script.expressions[waiting.back()].node;
        waiting.pop_back();
        if (const auto* name = std::get_if<ast::Name>(&part)) {
            if (name->name == "lap") return true;
        } else if (const auto* unary = std::get_if<ast::Unary>(&part)) {
            if (unary->op == Function::negate) waiting.push_back(unary->operand);
        } else if (const auto* binary = std::get_if<ast::Binary>(&part)) {
            const Function op = binary->op;
            const bool is_raised = op == Function::divide || op == Function::power;
            if (is_sum(op) || is_raised) waiting.push_back(binary->left);
            if (is_sum(op) || op == Function::multiply) waiting.push_back(binary->right);
        }
    }
    return false;
}

bool applies_operator(const ast::Script& script, ast::ExprId node) {
    return !std::holds_alternative<ast::Name>(script.expressions[node].node) &&
           is_operator(script, node);
}

}  // namespace cascade
