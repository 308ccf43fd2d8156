// Reads the description of a library text from the comments at its top. Finds these comments among
// the words of the text, without a syntax tree.
#include "lang/print/library_note.h"

#include "lang/format/format_words.h"
#include "lang/syntax/parse.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

std::string in_small_letters(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

/// The text of a comment without its `#` signs.
std::string_view said_in(std::string_view comment) {
    comment.remove_prefix(std::min(comment.find_first_not_of("# \t"), comment.size()));
    return comment;
}

/// If a text has no stage, these blocks are appended, so that the text can be run and drawn.
/// `block` is the last block of the text.
std::string rest_of_script(const ast::Block& block, std::string_view name) {
    if (block.kind == ast::BlockKind::shape) {
        return fmt::format(
            "\ncells herd {{ p' += cling(1) + push(1) }}\n"
            "domain {{ surface: sphere }}\n"
            "stage stand: herd {{ founders: 100; r: 0.06; duration: 2 }}\n"
            "picture {{ shape: {}; height: 2 * r; color: rgb(0.5, 0.6, 0.35) }}\n",
            name);
    }
    if (block.is_cells) {
        return fmt::format(
            "\ndomain {{ surface: sphere }}\n"
            "stage first: {} {{ founders: 400; duration: 10 }}\n",
            name);
    }
    return fmt::format("\nstage first: {} {{ }}\n", name);
}

}  // namespace

bool LibraryNote::mentions(std::string_view word) const {
    return words.find(in_small_letters(word)) != std::string::npos;
}

LibraryNote note_of(const LibraryText& text) {
    Sources sources;
    const SourceId source = sources.add(std::string(text.file_name), std::string(text.text));
    LibraryNote note;
    note.words = in_small_letters(text.system_name());
    bool in_head = true, in_about = true;
    for (const FormatWord& word : format_words(source, sources)) {
        in_head = in_head && word.is_comment();
        if (word.is_comment() || word.kind == TokenKind::text) {
            note.words += " " + in_small_letters(said_in(word.text));
        }
        if (!in_head) continue;
        const std::string_view line = said_in(word.text);
        note.lines.emplace_back(line);
        if (!in_about || line.empty()) continue;
        if (!note.about.empty()) note.about += ' ';
        note.about += line;
        in_about = !line.ends_with('.');
    }
    return note;
}

std::string starting_script(const LibraryText& text) {
    Sources sources;
    Diagnostics never_any;
    const SourceId source = sources.add(std::string(text.file_name), std::string(text.text));
    const ast::Script script = parse(source, sources, never_any);
    const bool has_stage =
        std::any_of(script.blocks.begin(), script.blocks.end(),
                    [](const ast::Block& block) { return block.kind == ast::BlockKind::stage; });
    std::string result(text.text);
    if (!has_stage) result += rest_of_script(script.blocks.back(), text.system_name());
    return result;
}

}  // namespace cascade
