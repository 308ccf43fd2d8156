// Adds the statements that u'' = e implies. An added statement has the source location of u'' = e,
// so that messages point there.
#include "lang/syntax/second_rates.h"

#include "lang/syntax/index_words.h"
#include "lang/syntax/kept_spellings.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

namespace {

ast::ExprId append(ast::Script& script, Span span, decltype(ast::Expr::node) node) {
    script.expressions.push_back({span, std::move(node)});
    return static_cast<ast::ExprId>(script.expressions.size() - 1);
}

/// Appends an expression that reads u_t, u_t[i], u_t[2] or u_t[i, 2].
ast::Expression read(ast::Script& script, const ast::Word& name, const ast::Word& index) {
    const ast::ExprId base = append(script, name.span, ast::Name{name.text});
    if (index.empty()) return {base, base};
    std::vector<ast::ExprId> which;
    for (const ast::Word& word : words_of_index(index)) {
        which.push_back(
            is_number(word)
                ? append(script, word.span,
                         ast::Number{std::strtod(std::string(word.text).c_str(), nullptr)})
                : append(script, word.span, ast::Name{word.text}));
    }
    const auto second = which.size() > 1 ? std::optional(which[1]) : std::nullopt;
    return {base, append(script, name.span, ast::Indexed{base, which[0], second})};
}

/// Whether the block gives a value to the name. A family has a value only if each member has.
bool has_value(const ast::Block& block, const ast::Word& name, const ast::Word& index) {
    return std::ranges::any_of(block.statements, [&](const ast::Statement& each) {
        return each.kind == ast::StatementKind::value && each.name.text == name.text &&
               (each.index.text == index.text || !is_of_some_members(each.index));
    });
}

}  // namespace

std::string_view name_of_rate(std::string_view species) {
    return kept_spelling(std::string(species) + "_t");
}

void complete_second_rates(ast::Script& script, ast::Block& block) {
    const std::size_t count = block.statements.size();
    for (std::size_t k = 0; k < count; ++k) {
        const ast::Statement second = block.statements[k];
        if (second.second.empty()) continue;
        ast::Statement added;
        added.index = second.index;
        added.span = second.span;
        // If a rate has several terms, u'' += e, it has several statements, but u' = u_t must be
        // added only once.
        const auto is_added = [&](const ast::Statement& each) {
            return each.kind == ast::StatementKind::rate && each.name.text == second.second.text &&
                   each.index.text == second.index.text;
        };
        if (std::none_of(block.statements.begin() + static_cast<std::ptrdiff_t>(count),
                         block.statements.end(), is_added)) {
            added.kind = ast::StatementKind::rate;
            added.name = second.second;
            added.values = {read(script, second.name, second.index)};
            block.statements.push_back(added);
        }
        if (block.base.empty() && !has_value(block, second.name, second.index)) {
            added.kind = ast::StatementKind::value;
            added.name = second.name;
            const ast::ExprId zero = append(script, second.name.span, ast::Number{0});
            added.values = {{zero, zero}};
            block.statements.push_back(added);
        }
    }
}

}  // namespace cascade
