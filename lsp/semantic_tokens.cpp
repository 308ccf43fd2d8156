// The colours of words that may have several meanings, according to the meaning of each word at its
// place.
#include "core/utf8.h"
#include "lang/service/symbols.h"
#include "lang/syntax/parse.h"
#include "lang/syntax/token.h"
#include "lang/vocabulary/functions.h"
#include "lang/vocabulary/settings.h"
#include "lsp/answers.h"
#include "lsp/kinds.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

namespace cascade::lsp {
namespace {

/// The types of tokens that are not names.
constexpr std::string_view number_type = "number", text_type = "string", comment_type = "comment";
/// The bits of the modifiers, in the order of the legend.
constexpr unsigned is_declaration = 1, is_of_language = 2;

const std::vector<std::string_view>& token_types() {
    static const std::vector<std::string_view> types = [] {
        std::vector<std::string_view> all{number_type, text_type, comment_type};
        for (const KindNumbers& row : kind_numbers) {
            if (std::ranges::count(all, row.colour) == 0) all.push_back(row.colour);
        }
        return all;
    }();
    return types;
}

/// The kinds of the names that a text declares, by the byte where the name begins.
using Kinds = std::unordered_map<std::uint32_t, NameKind>;

void add_kinds(const std::vector<Symbol>& symbols, Kinds& kinds) {
    for (const Symbol& symbol : symbols) {
        kinds.try_emplace(symbol.name_span.begin, symbol.kind);
        add_kinds(symbol.inside, kinds);
    }
}

/// Finds what kind of name a declaration declares, in the script or in a text that it uses.
class DeclaredKinds {
public:
    explicit DeclaredKinds(const Script& script) : script_(script) {}

    std::optional<NameKind> at(Span declaration) {
        const auto [found, is_new] = kinds_.try_emplace(declaration.source);
        if (is_new) read(declaration.source, found->second);
        const auto kind = found->second.find(declaration.begin);
        if (kind == found->second.end()) return std::nullopt;
        return kind->second;
    }

private:
    void read(SourceId source, Kinds& kinds) const {
        add_kinds(symbols_of(script_.tree, source), kinds);
        if (!kinds.empty() || source == own_source) return;
        Diagnostics ignored;  // A text of the library, which is not in the tree.
        add_kinds(symbols_of(parse(source, script_.sources, ignored), source), kinds);
    }

    const Script& script_;
    std::map<SourceId, Kinds> kinds_;
};

struct Colour {
    std::string_view type;  ///< Empty if the token has no colour.
    unsigned modifiers = 0;
};

class Colourer {
public:
    explicit Colourer(Document& document)
        : document_(document), names_(document.names()), kinds_(document.script()) {
        for (const ast::Block& block : document.script().tree.blocks) {
            if (block.keyword.span.source == own_source)
                keywords_.push_back(block.keyword.span.begin);
        }
        std::ranges::sort(keywords_);
    }

    Json run() {
        Diagnostics ignored;
        const std::vector<Token> tokens = lex(own_source, document_.script().sources, ignored);
        std::uint32_t end = 0;
        for (std::size_t k = 0; k < tokens.size(); ++k) {
            const Span span = tokens[k].span;
            if (span.begin > end) add_comments(end, span.begin);
            end = std::max(end, span.end);
            if (span.begin == span.end) continue;
            add(span.begin, span.end,
                colour_of(tokens[k], tokens[std::min(k + 1, tokens.size() - 1)]));
        }
        return std::move(numbers_);
    }

private:
    Colour colour_of(const Token& token, const Token& next) {
        switch (token.kind) {
            case TokenKind::number: return {number_type};
            case TokenKind::text: return {text_type};
            case TokenKind::keyword_and:
            case TokenKind::keyword_or:
            case TokenKind::keyword_not: return {numbers_of(NameKind::keyword).colour};
            case TokenKind::name: return colour_of_name(token, next);
            default: return {};
        }
    }

    Colour colour_of_name(const Token& token, const Token& next) {
        const Span span = token.span;
        if (std::ranges::binary_search(keywords_, span.begin))
            return {numbers_of(NameKind::keyword).colour};
        if (const auto name = names_.name_at(span.begin); name && name->begin == span.begin) {
            const auto declared = names_.declaration_at(span.begin);
            const auto kind = declared ? kinds_.at(*declared) : std::nullopt;
            // Outlines do not contain indices and parameters of functions.
            const Colour colour{numbers_of(kind.value_or(NameKind::parameter)).colour};
            if (declared == *name) return {colour.type, is_declaration};
            return declared && declared->source != own_source ? Colour{colour.type, is_of_language}
                                                              : colour;
        }
        const bool has_value = next.kind == TokenKind::colon;
        if (has_value && setting_named(token.text))
            return {numbers_of(NameKind::setting).colour, is_of_language};
        const bool is_called = next.kind == TokenKind::open_round;
        if (is_called && function_named(token.text))
            return {numbers_of(NameKind::function).colour, is_of_language};
        if (builtin_named(token.text) || token.text == "pi")
            return {numbers_of(NameKind::value).colour, is_of_language};
        return {};
    }

    /// Adds the comments of a part of the text in which there are no tokens.
    void add_comments(std::size_t begin, std::size_t end) {
        const std::string& text = document_.text();
        for (std::size_t at = begin; at < end; ++at) {
            if (text[at] != '#') continue;
            const std::size_t last = std::min(text.find_first_of("\r\n", at), end);
            add(at, last, {comment_type});
            at = last;
        }
    }

    /// Adds five numbers: the distance from the previous token in lines and columns, the length,
    /// the type and the modifiers.
    void add(std::size_t begin, std::size_t end, Colour colour) {
        if (colour.type.empty()) return;
        const std::string& text = document_.text();
        const Position at = document_.lines().position_of(text, begin);
        const Position after = document_.lines().position_of(text, end);
        if (after.line != at.line || at < last_) return;
        const bool is_same_line = at.line == last_.line;
        numbers_.push_back(at.line - last_.line);
        numbers_.push_back(at.column - (is_same_line ? last_.column : 0));
        numbers_.push_back(after.column - at.column);
        numbers_.push_back(std::ranges::find(token_types(), colour.type) - token_types().begin());
        numbers_.push_back(colour.modifiers);
        last_ = at;
    }

    Document& document_;
    const NameIndex& names_;
    DeclaredKinds kinds_;
    std::vector<std::uint32_t> keywords_;  ///< Where the keywords of blocks begin.
    Position last_;
    Json numbers_ = Json::array();
};

}  // namespace

Json semantic_legend() {
    return {{"tokenTypes", token_types()}, {"tokenModifiers", {"declaration", "defaultLibrary"}}};
}

Result<Json> semantic_tokens(const Asked& asked) {
    return Json{{"data", Colourer(asked.document).run()}};
}

}  // namespace cascade::lsp
