// Formats a script, and checks that formatting has not changed the words.
#include "lang/format/format_script.h"

#include "core/check.h"
#include "lang/format/format_lines.h"
#include "lang/format/format_notation.h"
#include "lang/syntax/parse.h"

#include <algorithm>

namespace cascade {

namespace {

std::string write_lines(const std::vector<FormatWord>& words,
                        const std::vector<FormatLine>& lines) {
    std::string text;
    for (const FormatLine& line : lines) {
        if (line.blank_line_before) text += '\n';
        std::size_t column = 0;
        const auto write = [&](std::size_t word, std::size_t at) {
            text.append(at - column, ' ');
            text += words[word].text;
            column = at + width_of(words[word].text);
        };
        for (const FormatLine::Cell& cell : line.cells) write(cell.word, cell.column);
        if (line.comment) write(*line.comment, line.comment_column);
        text += '\n';
    }
    return text;
}

/// Whether both lists contain the same words. `;` is ignored, because it may have become a line
/// break.
bool same_words(const std::vector<FormatWord>& before, const std::vector<FormatWord>& after) {
    const auto is_written = [](const FormatWord& word) {
        return word.kind != TokenKind::semicolon;
    };
    auto left = before.begin(), right = after.begin();
    while (true) {
        left = std::find_if(left, before.end(), is_written);
        right = std::find_if(right, after.end(), is_written);
        if (left == before.end() || right == after.end()) break;
        // In the notation of papers, the product of (1 + lap)² and its operand is written without a
        // sign. So one list may lack the sign of such a product.
        const auto is_left_out = [](const FormatWord& word) {
            return word.kind == TokenKind::star && word.text.empty();
        };
        if (left->kind != right->kind && (is_left_out(*left) || is_left_out(*right))) {
            ++(is_left_out(*left) ? left : right);
            continue;
        }
        const bool are_comments = left->is_comment() && right->is_comment();
        if (left->kind != right->kind || left->spelling != right->spelling) return false;
        if (are_comments && left->text != right->text) return false;
        ++left;
        ++right;
    }
    return left == before.end() && right == after.end();
}

}  // namespace

std::optional<std::string> format_script(SourceId source, const Sources& sources,
                                         Diagnostics& diagnostics, ScriptNotation notation) {
    const std::size_t errors_before = diagnostics.error_count();
    parse(source, sources, diagnostics);
    if (diagnostics.error_count() > errors_before) return std::nullopt;
    const std::vector<FormatWord> all_words = format_words(source, sources);
    const std::vector<FormatWord> words = written_words(all_words, notation);
    std::vector<FormatLine> lines = format_lines(words);
    place_words(words, lines, notation != ScriptNotation::as_written);
    std::string text = write_lines(words, lines);

    Sources formatted;
    const SourceId copy = formatted.add("formatted", text);
    CHECK(same_words(all_words, format_words(copy, formatted)), "formatting keeps every word");
    return text;
}

}  // namespace cascade
