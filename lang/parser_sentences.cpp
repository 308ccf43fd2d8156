// Sentences: a name, what is said of it, and the expressions that say it.
#include "lang/script_parser.h"

#include "core/near_name.h"

#include <fmt/core.h>

#include <array>

namespace cascade {

/// The sentence at the cursor; the cursor goes to its end. Empty, with a message, if not even its
/// name and form can be read; if only its value cannot, that is Garbage.
std::optional<ast::Sentence> ScriptParser::parse_sentence() {
    if (!cursor_.at(TokenKind::name)) {
        report_no_sentence();
        return std::nullopt;
    }
    ast::Sentence sentence;
    sentence.name = cursor_.word(cursor_.take());
    if (!parse_relation(sentence)) return std::nullopt;
    parse_values(sentence);
    sentence.span = join(sentence.name.span, cursor_.previous().span);
    return sentence;
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
            cursor_.error(sentence.name.span, "a sentence sets a name of its own stage only",
                          "write the name without a stage");
            cursor_.skip_sentence();
            return false;
        case TokenKind::garbage: cursor_.skip_sentence(); return false;
        default: return report_missing_colon(sentence);
    }
    cursor_.take();
    return true;
}

bool ScriptParser::parse_rate_relation(ast::Sentence& sentence) {
    if (cursor_.take_if(TokenKind::plus_assign)) {
        sentence.kind = ast::SentenceKind::rate_term;
        return true;
    }
    sentence.kind = ast::SentenceKind::rate;
    if (cursor_.take_if(TokenKind::assign)) return true;
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

/// A name is followed by something that makes no sentence: mostly the colon is missing, or the name
/// should begin a block. True if the value can be read on.
bool ScriptParser::report_missing_colon(const ast::Sentence& sentence) {
    const ast::Word& name = sentence.name;
    const std::string quoted = cursor_.describe({TokenKind::name, name.span});
    std::size_t ahead = cursor_.at(TokenKind::name) ? 1 : 0;
    if (cursor_.kind(ahead) == TokenKind::newline) ++ahead;
    if (cursor_.kind(ahead) == TokenKind::open_curly || begins_misspelt_stage()) {
        const std::array<std::string, 4> keywords = {"system", "stage", "domain", "picture"};
        const std::string near = nearest_name(name.text, keywords);
        cursor_.error(name.span, quoted + " begins no block",
                      near.empty() ? "blocks are system, stage, domain and picture"
                                   : "did you mean '" + near + "'?");
        cursor_.skip_sentence();
        return false;
    }
    cursor_.error(name.span, fmt::format("':' is missing after {}", quoted),
                  "a sentence is 'name: expression'");
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

/// `stag large: leopard {`
bool ScriptParser::begins_misspelt_stage() const {
    return cursor_.kind() == TokenKind::name && cursor_.kind(1) == TokenKind::colon &&
           cursor_.kind(2) == TokenKind::name && cursor_.kind(3) == TokenKind::open_curly;
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
    // The line goes on behind an operator; ':' is none.
    if (wants_operand(cursor_.previous().kind) && cursor_.at(TokenKind::newline) &&
        !cursor_.begins_sentence(1) && cursor_.kind(1) != TokenKind::close_curly) {
        cursor_.take();
    }
    cursor_.mute(colon_is_missing);
    sentence.values.push_back(expressions_.parse(owner));
    while (cursor_.at(TokenKind::comma)) {
        const Token comma = cursor_.take();
        if (sentence.kind != ast::SentenceKind::value) {
            cursor_.error(comma.span, "only a value may be a list", "write one expression");
            cursor_.skip_sentence();
            break;
        }
        if (cursor_.at(TokenKind::newline) && !cursor_.begins_sentence(1)) cursor_.take();
        sentence.values.push_back(expressions_.parse(owner));
    }
    cursor_.mute(false);
}

}  // namespace cascade
