// Sentences: a name, what is said of it, and the expressions that say it.
#include "lang/syntax/script_parser.h"

#include "core/near_name.h"
#include "core/side.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

namespace cascade {

/// The sentence at the cursor; the cursor goes to its end. Empty, with a message, if not even its
/// name and form can be read; if only its value cannot, that is Garbage.
std::optional<ast::Sentence> ScriptParser::parse_sentence() {
    if (!cursor_.at(TokenKind::name)) {
        report_no_sentence();
        return std::nullopt;
    }
    ast::Sentence sentence;
    sentence.doc = docs_before();
    sentence.name = cursor_.word(cursor_.take());
    if (!parse_index(sentence)) return std::nullopt;
    parse_side(sentence);
    if (!parse_relation(sentence)) return std::nullopt;
    parse_values(sentence);
    sentence.span = join(sentence.name.span, cursor_.previous().span);
    add_docs(sentence.doc, docs_behind(sentence.name.span.begin));
    return sentence;
}

/// The `.left` of `u.left: e` or `u[1].left: e`, if there is one.
void ScriptParser::parse_side(ast::Sentence& sentence) {
    const bool is_dotted = cursor_.at(TokenKind::dot) && cursor_.kind(1) == TokenKind::name &&
                           cursor_.kind(2) == TokenKind::colon &&
                           cursor_.peek().span.begin == cursor_.previous().span.end &&
                           cursor_.peek(1).span.begin == cursor_.peek().span.end;
    if (!is_dotted) return;
    const std::string_view word = cursor_.text(cursor_.peek(1));
    const bool is_side = word == "sides" ||
                         std::find(side_names.begin(), side_names.end(), word) != side_names.end();
    if (!is_side) return;
    cursor_.take();
    sentence.side = cursor_.word(cursor_.take());
}

/// Sentences about sides go to a place of their own.
void ScriptParser::add_sentence(ast::Block& block, ast::Sentence sentence) {
    (!sentence.side.empty() ? block.sides : block.sentences).push_back(std::move(sentence));
}

std::string ScriptParser::docs_before() {
    return cursor_.take_docs(cursor_.taken_up_to(), cursor_.peek().span.begin);
}

std::string ScriptParser::docs_behind(std::uint32_t begin) {
    const bool is_last = cursor_.at(TokenKind::semicolon) && cursor_.kind(1) == TokenKind::newline;
    return cursor_.take_docs(begin, cursor_.peek(is_last ? 1 : 0).span.begin);
}

void ScriptParser::add_docs(std::string& doc, const std::string& more) {
    if (!doc.empty() && !more.empty()) doc += ' ';
    doc += more;
}

/// The `[i]` of `u[i]: e`, if there is one. False, with a message, if it cannot be read.
bool ScriptParser::parse_index(ast::Sentence& sentence) {
    const bool is_index = cursor_.at(TokenKind::open_square) &&
                          cursor_.peek().span.begin == sentence.name.span.end;
    if (!is_index) return true;
    const Token open = cursor_.take();
    const bool is_plain = cursor_.at(TokenKind::name) || cursor_.at(TokenKind::number);
    if (is_plain && cursor_.kind(1) == TokenKind::close_square) {
        sentence.index = cursor_.word(cursor_.take());
        cursor_.take();
        return true;
    }
    if (!cursor_.at(TokenKind::garbage)) {
        cursor_.error(join(sentence.name.span, open.span),
                      "the index that a sentence sets is a name or a whole number",
                      fmt::format("write {0}[i] or {0}[1]", shortened(sentence.name.text)));
    }
    cursor_.skip_sentence(1);
    return false;
}

/// What begins here is no sentence; always false.
bool ScriptParser::report_no_sentence() {
    const Token token = cursor_.peek();
    const std::string word = cursor_.describe(token);
    switch (token.kind) {
        case TokenKind::garbage: break;  // The lexer has given a message.
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
                          "blocks are system, stage, domain and picture");
            break;
        default:
            cursor_.error(token.span, fmt::format("no sentence begins with {}", word),
                          "a sentence is 'name: expression'");
    }
    cursor_.skip_sentence();
    return false;
}

/// Reads what stands between the name and the value. Forms of other languages are read as what they
/// mean, with a message. False if there is no value to read.
bool ScriptParser::parse_relation(ast::Sentence& sentence) {
    using Kind = ast::SentenceKind;
    const Token token = cursor_.peek();
    const std::string name(shortened(sentence.name.text));
    switch (token.kind) {
        case TokenKind::colon: sentence.kind = Kind::value; break;
        case TokenKind::assign: sentence.kind = Kind::definition; break;
        case TokenKind::greater_equal: sentence.kind = Kind::at_least; break;
        case TokenKind::less_equal: sentence.kind = Kind::at_most; break;
        case TokenKind::prime: cursor_.take(); return parse_rate_relation(sentence);
        case TokenKind::plus_assign:
            sentence.kind = Kind::rate_term;
            cursor_.error(token.span, "only a rate has terms to add to",
                          fmt::format("write {}' +=", name));
            break;
        case TokenKind::equal:
            sentence.kind = Kind::definition;
            cursor_.error(token.span, "'==' compares and defines nothing", "write '='");
            break;
        case TokenKind::greater:
            sentence.kind = Kind::at_least;
            cursor_.error(token.span, "an invariant is written with '>='", "write '>='");
            break;
        case TokenKind::less:
            sentence.kind = Kind::at_most;
            cursor_.error(token.span, "an invariant is written with '<='", "write '<='");
            break;
        case TokenKind::dot:
            report_dot(sentence);
            cursor_.skip_sentence();
            return false;
        case TokenKind::garbage: cursor_.skip_sentence(); return false;
        default: return take_paper_rate(sentence) || report_missing_colon(sentence);
    }
    cursor_.take();
    return true;
}

/// `large.ka: 1`, or a side with a slip.
void ScriptParser::report_dot(const ast::Sentence& sentence) {
    std::string near;
    if (cursor_.kind(1) == TokenKind::name) {
        std::vector<std::string> sides(side_names.begin(), side_names.end());
        sides.emplace_back("sides");
        near = nearest_name(cursor_.text(cursor_.peek(1)), sides);
    }
    cursor_.error(sentence.name.span, "a sentence sets a name of its own stage only",
                  near.empty() ? "write the name without a stage"
                               : fmt::format("did you mean {}.{}?", sentence.name.text, near));
}

bool ScriptParser::parse_rate_relation(ast::Sentence& sentence) {
    if (cursor_.take_if(TokenKind::plus_assign)) {
        sentence.kind = ast::SentenceKind::rate_term;
        return true;
    }
    sentence.kind = ast::SentenceKind::rate;
    if (cursor_.take_if(TokenKind::assign)) return true;
    if (cursor_.at(TokenKind::prime)) return report_second_rate(sentence);
    if (!cursor_.at(TokenKind::garbage)) {
        cursor_.error(join(sentence.name.span, cursor_.previous().span),
                      "a rate is written with '=' or '+='",
                      fmt::format("write {}' = …", shortened(sentence.name.text)));
    }
    // A colon in its place is the likely slip: what follows is the rate.
    if (cursor_.take_if(TokenKind::colon) || cursor_.take_if(TokenKind::equal)) return true;
    cursor_.skip_sentence();
    return false;
}

/// `u'' = e`: what is said of it stays unread, for no first rate means the same.
bool ScriptParser::report_second_rate(const ast::Sentence& sentence) {
    while (cursor_.at(TokenKind::prime)) cursor_.take();
    const std::string name = shortened(sentence.name.text);
    cursor_.error(join(sentence.name.span, cursor_.previous().span),
                  "rates are first derivatives by time",
                  fmt::format("make the rate a species: write v: 0; {}' = v; v' = …", name));
    cursor_.skip_sentence();
    return false;
}

/// `du/dt = e`, read on as the rate of u.
bool ScriptParser::take_paper_rate(ast::Sentence& sentence) {
    const std::string_view name = sentence.name.text;
    const bool is_rate = name.size() > 1 && name[0] == 'd' && cursor_.at(TokenKind::slash) &&
                         cursor_.at_name("dt", 1) && cursor_.kind(2) == TokenKind::assign;
    if (!is_rate) return false;
    const Span derivative = join(sentence.name.span, cursor_.peek(1).span);
    for (int k = 0; k < 3; ++k) cursor_.take();
    sentence.kind = ast::SentenceKind::rate;
    sentence.name.text = name.substr(1);
    ++sentence.name.span.begin;
    cursor_.error(derivative, "a rate is written with a prime",
                  fmt::format("write {}' = …", shortened(sentence.name.text)));
    return true;
}

/// A name is followed by something that makes no sentence: mostly the colon is missing, or the name
/// should begin a block. True if the value can be read on.
bool ScriptParser::report_missing_colon(const ast::Sentence& sentence) {
    const ast::Word& name = sentence.name;
    const std::string quoted = cursor_.describe({TokenKind::name, name.span});
    if (has_shape_of_block(0)) {
        report_no_block(name);
        cursor_.skip_sentence();
        return false;
    }
    cursor_.error(name.span, fmt::format("':' is missing after {}", quoted),
                  "a sentence is 'name: expression'");
    if (cursor_.at(TokenKind::open_square) && cursor_.kind(2) == TokenKind::close_square &&
        cursor_.kind(3) != TokenKind::newline) {
        cursor_.skip_sentence();  // `u [i]: e`: what follows the name is no value.
        return false;
    }
    switch (cursor_.kind()) {
        case TokenKind::number:
        case TokenKind::name:
        case TokenKind::open_square:
        case TokenKind::minus:
        case TokenKind::text:
        case TokenKind::keyword_not: return true;
        default: cursor_.skip_sentence(); return false;
    }
}

/// Does what stands `ahead` of here go on like a block behind its keyword? ` {`, ` large {`,
/// ` large: leopard {`.
bool ScriptParser::has_shape_of_block(std::size_t ahead) const {
    const bool is_derived = cursor_.kind(ahead) == TokenKind::name &&
                            cursor_.kind(ahead + 1) == TokenKind::colon &&
                            cursor_.kind(ahead + 2) == TokenKind::name;
    if (is_derived) return cursor_.kind(ahead + 3) == TokenKind::open_curly;
    if (cursor_.kind(ahead) == TokenKind::name) ++ahead;
    if (cursor_.kind(ahead) == TokenKind::newline) ++ahead;
    return cursor_.kind(ahead) == TokenKind::open_curly;
}

/// Says that a word begins no block; returns the keyword that is meant, if it can be told.
std::string ScriptParser::report_no_block(const ast::Word& word) {
    const std::array<std::string, 4> keywords = {"system", "stage", "domain", "picture"};
    std::string near = nearest_name(word.text, keywords);
    cursor_.error(word.span,
                  cursor_.describe({TokenKind::name, word.span}) + " begins no block",
                  near.empty() ? "blocks are system, stage, domain and picture"
                               : "did you mean '" + near + "'?");
    return near;
}

/// One expression, or several with commas between them.
void ScriptParser::parse_values(ast::Sentence& sentence) {
    const bool colon_is_missing = !wants_operand(cursor_.previous().kind) &&
                                  cursor_.previous().kind != TokenKind::colon;
    const std::string owner =
        fmt::format("the {} of {}",
                    sentence.kind == ast::SentenceKind::value        ? "value"
                    : sentence.kind == ast::SentenceKind::definition ? "definition"
                    : sentence.kind == ast::SentenceKind::rate ||
                            sentence.kind == ast::SentenceKind::rate_term
                        ? "rate"
                        : "bound",
                    cursor_.describe({TokenKind::name, sentence.name.span}));
    cursor_.mute(colon_is_missing);
    sentence.values.push_back(parse_behind_operator(owner, "in"));
    if (cursor_.at(TokenKind::dots)) parse_end_of_index(sentence);
    while (cursor_.at(TokenKind::comma)) {
        const Token comma = cursor_.take();
        if (cursor_.begins_sentence()) {
            cursor_.error(comma.span, "a comma stands between values, not between sentences",
                          "write ';'");
            break;
        }
        if (sentence.kind != ast::SentenceKind::value) {
            cursor_.error(comma.span, "only a value may be a list", "write one expression");
            cursor_.skip_sentence();
            break;
        }
        if (cursor_.at(TokenKind::newline) && !cursor_.begins_sentence(1)) cursor_.take();
        sentence.values.push_back(expressions_.parse(owner, "in"));
    }
    if (cursor_.at_name("in")) parse_range(sentence);
    if (cursor_.at(TokenKind::dots)) {
        cursor_.error(cursor_.peek().span, "'..' has no place here",
                      "a range is written 1..3, or p: 1 in 0 .. 2");
        cursor_.skip_sentence();
    }
    cursor_.mute(false);
}

/// An expression that may begin on the next line where an operator is the last word of this one.
/// The ':' is none.
ast::Expression ScriptParser::parse_behind_operator(const std::string& owner,
                                                    std::string_view end_word) {
    const bool goes_on = wants_operand(cursor_.previous().kind) &&
                         cursor_.at(TokenKind::newline) && !cursor_.begins_sentence(1) &&
                         cursor_.kind(1) != TokenKind::close_curly;
    if (goes_on) cursor_.take();
    return expressions_.parse(owner, end_word);
}

/// The `.. high` of `i: low .. high`.
void ScriptParser::parse_end_of_index(ast::Sentence& sentence) {
    const Token dots = cursor_.take();
    if (sentence.kind != ast::SentenceKind::value || !sentence.index.empty()) {
        cursor_.error(dots.span, "a range declares an index", "write i: 1..3");
        cursor_.skip_sentence();
        return;
    }
    sentence.kind = ast::SentenceKind::index;
    sentence.values.push_back(expressions_.parse("the end of the range"));
}

/// The `in low .. high [step e]` behind a value.
void ScriptParser::parse_range(ast::Sentence& sentence) {
    const Token word = cursor_.take();
    const std::string form = "write p: 1 in 0 .. 2";
    if (sentence.kind != ast::SentenceKind::value || sentence.values.size() != 1) {
        cursor_.error(word.span, "only the value of a parameter has a range", form);
        cursor_.skip_sentence();
        return;
    }
    ast::Range range;
    range.low = expressions_.parse("the lower end of the range");
    if (!cursor_.at(TokenKind::dots)) {
        const auto& low = script_.expressions[range.low.root].node;
        if (!std::holds_alternative<ast::Garbage>(low)) {
            cursor_.error(word.span, "a range has two ends with '..' between them", form);
        }
        cursor_.skip_sentence();
        return;
    }
    cursor_.take();
    range.high = expressions_.parse("the upper end of the range", "step");
    if (cursor_.at_name("step")) {
        cursor_.take();
        range.step = expressions_.parse("the step of the range");
    }
    range.span = join(word.span, cursor_.previous().span);
    sentence.range = range;
}

}  // namespace cascade
