// Parses both texts. Then puts pieces of the added text into the script, going from the script's
// end to its beginning.
#include "lang/syntax/replace_blocks.h"

#include "lang/syntax/parse.h"
#include "lang/syntax/token.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace cascade {
namespace {

/// A block or function in a text.
struct TextPiece {
    int kind = 0;
    std::string_view name;
    Span span;
};

constexpr int function_kind = -1;

/// A text and its blocks and functions, in order.
struct ParsedText {
    explicit ParsedText(const std::string& text) {
        const SourceId source = sources.add("", text);
        tree = parse(source, sources, errors);
        for (const ast::Block& block : tree.blocks) {
            const bool is_classic = block.kind == ast::BlockKind::classic_stage;
            is_of_blocks = is_of_blocks && !is_classic && !block.is_damaged;
            if (!is_classic) {
                pieces.push_back({static_cast<int>(block.kind), block.name.text, block.span});
            }
        }
        for (const ast::FunctionDefinition& function : tree.functions) {
            pieces.push_back({function_kind, function.name.text, function.span});
        }
        std::sort(pieces.begin(), pieces.end(), [](const TextPiece& a, const TextPiece& b) {
            return a.span.begin < b.span.begin;
        });
        is_of_blocks = is_of_blocks && !errors.has_errors() && tree.uses.empty();
    }

    Sources sources;
    Diagnostics errors;
    ast::Script tree;
    std::vector<TextPiece> pieces;
    bool is_of_blocks = true;  ///< Whether the text contains nothing but blocks and functions.
};

/// The tokens outside of pictures and shapes. Several line breaks in a row become one line break,
/// and line breaks at both ends of the text are removed.
std::vector<std::string_view> words_without_pictures(const ParsedText& parsed) {
    Diagnostics never_any;
    std::vector<std::string_view> words;
    bool is_after_break = true;
    auto piece = parsed.pieces.begin();
    for (const Token& token : lex(0, parsed.sources, never_any)) {
        while (piece != parsed.pieces.end() && piece->span.end <= token.span.begin) ++piece;
        const bool is_of_picture = piece != parsed.pieces.end() &&
                                   token.span.begin >= piece->span.begin &&
                                   (piece->kind == static_cast<int>(ast::BlockKind::picture) ||
                                    piece->kind == static_cast<int>(ast::BlockKind::shape));
        const bool is_break = token.kind == TokenKind::newline;
        if (is_of_picture || (is_break && is_after_break)) continue;
        is_after_break = is_break;
        words.push_back(is_break ? "\n" : token.text);
    }
    while (!words.empty() && (words.back() == "\n" || words.back().empty())) words.pop_back();
    return words;
}

}  // namespace

bool differ_in_pictures_only(const std::string& one, const std::string& other) {
    const ParsedText first(one), second(other);
    return !first.errors.has_errors() && !second.errors.has_errors() &&
           words_without_pictures(first) == words_without_pictures(second);
}

std::string with_blocks(const std::string& script, const std::string& added) {
    const ParsedText old(script), more(added);
    if (!more.is_of_blocks) return script + added;
    struct Replacement {
        Span span;
        std::string text;
    };
    std::vector<Replacement> replacements;
    std::string at_end;
    std::size_t from = 0;
    for (const TextPiece& piece : more.pieces) {
        const auto same =
            std::find_if(old.pieces.begin(), old.pieces.end(), [&](const TextPiece& each) {
                return each.kind == piece.kind && each.name == piece.name;
            });
        if (same != old.pieces.end()) {
            replacements.push_back({same->span, std::string(more.sources.text(piece.span))});
        } else {
            // The added text includes the comments before the piece.
            at_end += added.substr(from, piece.span.end - from);
        }
        from = piece.span.end;
        while (from < added.size() && same != old.pieces.end() &&
               std::isspace(static_cast<unsigned char>(added[from])) != 0) {
            ++from;
        }
    }
    at_end += added.substr(from);
    std::sort(replacements.begin(), replacements.end(),
              [](const Replacement& a, const Replacement& b) {
                  return a.span.begin > b.span.begin;
              });
    std::string changed = script;
    for (const Replacement& each : replacements) {
        changed.replace(each.span.begin, each.span.end - each.span.begin, each.text);
    }
    return changed + at_end;
}

}  // namespace cascade
