// Settings whose value is a word, alone or with arguments in brackets, as in `surface: torus(1,
// 0.4)` (internal to the checker).
#pragma once

#include "lang/syntax/ast.h"

#include <string_view>
#include <vector>

namespace cascade::checking {

inline const ast::Expr& value_of(const ast::Script& script, const ast::Statement& statement) {
    return script.expressions[statement.values[0].root];
}

/// The word, with or without arguments in brackets; "" for any other expression.
inline std::string_view word_of(const ast::Expr& value) {
    if (const auto* name = std::get_if<ast::Name>(&value.node)) return name->name;
    if (const auto* call = std::get_if<ast::Call>(&value.node)) return call->function.text;
    return {};
}

/// The arguments of a call, whose nodes come one after the other before it.
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

}  // namespace cascade::checking
