// Reads settings from the syntax tree of a script or an option. A value may be a word, alone or
// with arguments in brackets, as in `surface: torus(1, 0.4)` (internal to the checker).
#pragma once

#include "lang/syntax/ast.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace cascade::checking {

inline const ast::Expr& value_of(const ast::Script& script, const ast::Statement& statement) {
    return script.expressions[statement.values[0].root];
}

/// The word of which a value consists, with or without arguments in brackets; "" for any other
/// expression.
inline std::string_view word_of(const ast::Expr& value) {
    if (const auto* name = std::get_if<ast::Name>(&value.node)) return name->name;
    if (const auto* call = std::get_if<ast::Call>(&value.node)) return call->function.text;
    return {};
}

/// The arguments of a call. In the script, the nodes of the arguments come before the node of the
/// call, one argument after the other.
inline std::vector<ast::Expression> arguments_of(const ast::Script& script,
                                                 ast::Expression written) {
    std::vector<ast::Expression> arguments;
    const auto* call = std::get_if<ast::Call>(&script.expressions[written.root].node);
    if (call == nullptr) return arguments;
    ast::ExprId first = written.first;
    for (std::uint32_t k = 0; k < call->argument_count; ++k) {
        const ast::ExprId root = script.arguments[call->first_argument + k];
        arguments.push_back({first, root});
        first = root + 1;
    }
    return arguments;
}

/// Returns the statement if it gives a value; else null.
inline const ast::Statement* value_statement(const ast::Statement& statement) {
    const bool usable = statement.kind == ast::StatementKind::value && !statement.name.empty() &&
                        !statement.values.empty();
    return usable ? &statement : nullptr;
}

/// Returns the statement of a `--set` if it may set a constant, because it names no stage, side or
/// member. Else returns null.
inline const ast::Statement* constant_statement(const ast::Override& change) {
    const ast::Statement& statement = change.statement;
    const bool is_plain = change.stage.empty() && statement.side.empty() && statement.index.empty();
    return is_plain ? value_statement(statement) : nullptr;
}

/// The statement that the option for this setting gives; null if the option is not used.
inline const ast::Statement* find_option(const ast::Script& script, std::string_view name) {
    const auto found =
        std::find_if(script.options.begin(), script.options.end(),
                     [&](const ast::Statement& option) { return option.name.text == name; });
    return found == script.options.end() ? nullptr : &*found;
}

}  // namespace cascade::checking
