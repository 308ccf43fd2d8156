// Reports statements that the grammar does not allow: foreign relations, missing colons, misspelt
// blocks.
#include "lang/syntax/script_parser.h"

#include "core/near_name.h"
#include "core/side.h"
#include "lang/syntax/index_words.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

namespace cascade {

namespace {

/// A word that other programs use for sides, and the sides that it means.
struct SideElsewhere {
    std::string_view word, side;
};
constexpr std::array sides_elsewhere = {
    SideElsewhere{"west", "left"},   SideElsewhere{"xmin", "left"},
    SideElsewhere{"inlet", "left"},  SideElsewhere{"east", "right"},
    SideElsewhere{"xmax", "right"},  SideElsewhere{"outlet", "right"},
    SideElsewhere{"north", "top"},   SideElsewhere{"up", "top"},
    SideElsewhere{"ymin", "top"},    SideElsewhere{"south", "bottom"},
    SideElsewhere{"down", "bottom"}, SideElsewhere{"ymax", "bottom"},
    SideElsewhere{"zmin", "front"},  SideElsewhere{"zmax", "back"},
    SideElsewhere{"all", "sides"},   SideElsewhere{"edges", "sides"},
    SideElsewhere{"walls", "sides"}, SideElsewhere{"boundary", "sides"},
};

/// The side that `word` means or resembles; "" if there is none.
std::string side_meant_by(std::string_view word) {
    const auto row = std::ranges::find(sides_elsewhere, word, &SideElsewhere::word);
    if (row != sides_elsewhere.end()) return std::string(row->side);
    std::vector<std::string> sides(side_names.begin(), side_names.end());
    sides.emplace_back("sides");
    return nearest_name(word, sides);
}

}  // namespace

/// A hint about the index of a statement. The cursor is at the index's first token. If the index is
/// a step in time, as in `u[t + 1] = e`, the hint suggests a rate.
std::string ScriptParser::hint_of_index(std::string_view name) const {
    const bool is_time = cursor_.at(TokenKind::name) && cursor_.kind(1) == TokenKind::plus &&
                         (cursor_.at_name("t") || cursor_.at_name("n"));
    if (is_time) return fmt::format("write its rate: {}' = …", name);
    return fmt::format("write {0}[i] or {0}[1]", name);
}

/// Reports that no statement begins at the cursor. Returns false.
bool ScriptParser::report_no_statement() {
    const Token token = cursor_.peek();
    const std::string word = cursor_.describe(token);
    switch (token.kind) {
        case TokenKind::garbage: break;  // An error has already been reported by the lexer.
        case TokenKind::keyword_and:
        case TokenKind::keyword_or:
        case TokenKind::keyword_not:
            cursor_.error(token.span, word + " is a word of the language and cannot be a name");
            break;
        case TokenKind::close_round:
        case TokenKind::close_square:
            cursor_.error(token.span, fmt::format("this {} closes nothing", word));
            break;
        case TokenKind::open_curly:
            cursor_.error(token.span, "no block begins here",
                          "blocks are system, cells, stage, domain, picture and shape");
            break;
        default:
            cursor_.error(token.span, fmt::format("no statement begins with {}", word),
                          "a statement is 'name: expression'");
    }
    cursor_.skip_statement();
    return false;
}

/// Reports a dot after the name, as in `large.ka: 1`, or a misspelt side.
void ScriptParser::report_dot(const ast::Statement& statement) {
    std::string near;
    if (cursor_.kind(1) == TokenKind::name) near = side_meant_by(cursor_.text(cursor_.peek(1)));
    cursor_.error(statement.name.span, "a statement can set only names of its own stage",
                  near.empty() ? "write the name without a stage"
                               : fmt::format("did you mean {}.{}?", statement.name.text, near));
}

/// Reports `u''' = e`, which cannot be converted to second rates, and skips the value.
bool ScriptParser::report_third_rate(const ast::Statement& statement) {
    while (cursor_.at(TokenKind::prime)) cursor_.take();
    const std::string name = shortened(cursor_.text(statement.name.span));
    cursor_.error(join(statement.name.span, cursor_.previous().span),
                  "a rate must be a first or second derivative with respect to time",
                  fmt::format("make the rate a species: write v: 0; {}' = v; v'' = …", name));
    cursor_.skip_statement();
    return false;
}

/// Reports `du/dt = e`, and continues as if it were the rate of u.
bool ScriptParser::take_paper_rate(ast::Statement& statement) {
    const std::string_view name = statement.name.text;
    const bool is_rate = name.size() > 1 && name[0] == 'd' && cursor_.at(TokenKind::slash) &&
                         cursor_.at_name("dt", 1) && cursor_.kind(2) == TokenKind::assign;
    if (!is_rate) return false;
    const Span derivative = join(statement.name.span, cursor_.peek(1).span);
    for (int k = 0; k < 3; ++k) cursor_.take();
    statement.kind = ast::StatementKind::rate;
    statement.name.text = name.substr(1);
    ++statement.name.span.begin;
    cursor_.error(derivative, "a rate is written with a prime",
                  fmt::format("write {}' = …", shortened(statement.name.text)));
    return true;
}

/// Reports a name without a relation. Usually a colon is missing, or the name is a misspelt keyword
/// of a block. Returns true if a value follows, with which parsing can continue.
bool ScriptParser::report_missing_colon(const ast::Statement& statement) {
    const ast::Word& name = statement.name;
    const std::string quoted = cursor_.describe({TokenKind::name, name.span});
    if (has_shape_of_block(0)) {
        report_no_block(name);
        cursor_.skip_statement();
        return false;
    }
    if (const std::string_view advice = advice_about(name.text, WordContext::statement);
        !advice.empty()) {
        cursor_.error(name.span, fmt::format("no statement begins with {}", quoted),
                      std::string(advice));
        cursor_.skip_statement();
        return false;
    }
    if (line_has_garbage()) {
        cursor_.skip_statement();
        return false;
    }
    cursor_.error(name.span, fmt::format("':' is missing after {}", quoted),
                  hint_of_missing_colon(name));
    const std::size_t next = after_index([this](std::size_t at) { return cursor_.kind(at); }, 0);
    if (next > 0 && cursor_.kind(next) != TokenKind::newline) {
        cursor_.skip_statement();  // For example, in `u [i]: e` no value follows the name.
        return false;
    }
    switch (cursor_.kind()) {
        case TokenKind::number:
        case TokenKind::name:
        case TokenKind::open_square:
        case TokenKind::minus:
        case TokenKind::text:
        case TokenKind::keyword_not: return true;
        default: cursor_.skip_statement(); return false;
    }
}

/// Whether the lexer has reported an error in the rest of this line.
bool ScriptParser::line_has_garbage() const {
    for (std::size_t ahead = 0;; ++ahead) {
        switch (cursor_.kind(ahead)) {
            case TokenKind::garbage: return true;
            case TokenKind::newline:
            case TokenKind::semicolon:
            case TokenKind::open_curly:
            case TokenKind::close_curly:
            case TokenKind::end_of_text: return false;
            default: break;
        }
    }
}

std::string ScriptParser::hint_of_missing_colon(const ast::Word& name) const {
    if (name.text == "end") return "a block ends with '}'";
    if (cursor_.at(TokenKind::text)) return "names have no quotes";
    if (!cursor_.at(TokenKind::open_round)) return "a statement is 'name: expression'";
    const std::string_view species = species_of_rate(name.text);
    if (!species.empty()) return fmt::format("a rate is written {}' = …", shortened(species));
    const bool is_side = cursor_.kind(1) == TokenKind::name &&
                         cursor_.kind(2) == TokenKind::assign &&
                         component_named(cursor_.text(cursor_.peek(1)));
    if (is_side) return fmt::format("a side is written {}.left: …", shortened(name.text));
    return fmt::format("write '{}: …' for a starting value", name.text);
}

/// Whether the tokens from `ahead` on look like the part of a block after the keyword: ` {`, `
/// large {`, ` large: leopard {`, ` thorn: scale, guide {`.
bool ScriptParser::has_shape_of_block(std::size_t ahead) const {
    const bool is_derived = cursor_.kind(ahead) == TokenKind::name &&
                            cursor_.kind(ahead + 1) == TokenKind::colon &&
                            cursor_.kind(ahead + 2) == TokenKind::name;
    if (is_derived) {
        ahead += 3;
        while (cursor_.kind(ahead) == TokenKind::comma &&
               cursor_.kind(ahead + 1) == TokenKind::name) {
            ahead += 2;
        }
        return cursor_.kind(ahead) == TokenKind::open_curly;
    }
    if (cursor_.kind(ahead) == TokenKind::name) ++ahead;
    if (cursor_.kind(ahead) == TokenKind::newline) ++ahead;
    return cursor_.kind(ahead) == TokenKind::open_curly;
}

/// Reports that no block begins with a word. Returns the keyword that was probably intended, or "".
std::string ScriptParser::report_no_block(const ast::Word& word) {
    const std::array<std::string, 6> of_blocks = {"system", "cells",   "stage",
                                                  "domain", "picture", "shape"};
    std::string near = nearest_name(word.text, of_blocks);
    cursor_.error(word.span,
                  cursor_.describe({TokenKind::name, word.span}) + " does not begin a block",
                  near.empty() ? "blocks are system, cells, stage, domain, picture and shape"
                               : "did you mean '" + near + "'?");
    return near;
}

/// Reports a type as other languages write it, `feed: float = 0.037`, and continues after the type.
void ScriptParser::skip_type(const ast::Word& name) {
    static constexpr std::array<std::string_view, 9> types = {"float",   "double", "int",
                                                              "integer", "real",   "number",
                                                              "bool",    "var",    "const"};
    const bool is_type = cursor_.at(TokenKind::name) && cursor_.kind(1) == TokenKind::assign &&
                         std::ranges::find(types, cursor_.text(cursor_.peek())) != types.end();
    if (!is_type) return;
    const Token type = cursor_.take();
    cursor_.error(join(type.span, cursor_.take().span), "values are declared without a type",
                  fmt::format("write '{}: …'", shortened(name.text)));
}

}  // namespace cascade
