// Looks at all definitions again until no more vectors are found.
#include "lang/equations/vector_names.h"

#include <vector>

namespace cascade {

namespace {

using Names = std::set<std::string, std::less<>>;

/// Is the expression a vector, if these names are?
bool is_vector(const ast::Script& script, ast::Expression expression, const Names& names) {
    std::vector<bool> known(expression.root - expression.first + 1, false);
    const auto of = [&](ast::ExprId id) { return bool(known[id - expression.first]); };
    for (ast::ExprId id = expression.first; id <= expression.root; ++id) {
        const auto& node = script.expressions[id].node;
        bool is = false;
        if (const auto* name = std::get_if<ast::Name>(&node)) is = names.contains(name->name);
        if (const auto* member = std::get_if<ast::Indexed>(&node)) is = of(member->base);
        if (const auto* unary = std::get_if<ast::Unary>(&node)) is = of(unary->operand);
        if (const auto* binary = std::get_if<ast::Binary>(&node)) {
            const bool is_arithmetic = info(binary->op).kind == FunctionKind::arithmetic;
            is = is_arithmetic && (of(binary->left) || of(binary->right));
        }
        if (const auto* call = std::get_if<ast::Call>(&node); call && call->argument_count > 0) {
            const auto function = function_named(call->function.text);
            const ast::ExprId last =
                script.arguments[call->first_argument + call->argument_count - 1];
            const ast::ExprId first = script.arguments[call->first_argument];
            const auto result = function ? info(*function).result : ResultKind::number;
            is = result == ResultKind::vector ||
                 (result == ResultKind::like && (of(first) || of(last))) ||
                 (function == Function::curl && !of(first));
        }
        known[id - expression.first] = is;
    }
    return known.back();
}

}  // namespace

Names vector_names(const SystemStatements& system) {
    Names names;
    for (bool grows = true; grows;) {
        grows = false;
        for (const SaidStatement& said : system.all()) {
            const ast::Statement& statement = *said.statement;
            if (statement.kind != ast::StatementKind::definition) continue;
            if (names.contains(statement.name.text)) continue;
            if (!is_vector(*said.script, statement.values.front(), names)) continue;
            names.emplace(statement.name.text);
            grows = true;
        }
    }
    return names;
}

}  // namespace cascade
