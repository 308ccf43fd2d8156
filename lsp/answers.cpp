// The table of requests, and what all answers need: positions and ranges as JSON.
#include "lsp/answers.h"

#include "core/file.h"
#include "lang/library/library.h"
#include "lsp/file_uri.h"
#include "run/stage/kernel_cache.h"

#include <limits>

namespace cascade::lsp {

const Json& member(const Json& object, const char* name) {
    static const Json none;
    const auto found = object.find(name);
    return object.is_object() && found != object.end() ? *found : none;
}

std::string text_of_member(const Json& object, const char* name) {
    const Json& text = member(object, name);
    return text.is_string() ? text.get<std::string>() : std::string();
}

std::optional<Position> position_from(const Json& json) {
    const auto number = [&](const char* name) -> std::optional<std::size_t> {
        const Json& value = member(json, name);
        if (!value.is_number_unsigned()) return std::nullopt;
        return std::min<std::size_t>(value.get<std::uint64_t>(),
                                     std::numeric_limits<std::uint32_t>::max());
    };
    const auto line = number("line"), column = number("character");
    if (!line || !column) return std::nullopt;
    return Position{*line, *column};
}

Json json_of(Position position) {
    return {{"line", position.line}, {"character", position.column}};
}

namespace {

Json range_in(std::string_view text, const Lines& lines, std::size_t begin, std::size_t end) {
    return {{"start", json_of(lines.position_of(text, begin))},
            {"end", json_of(lines.position_of(text, end))}};
}

/// Writes the text of a system or a shape of the library to a file, so that editors can open it.
/// The file is in the folder of compiled kernels.
std::optional<std::filesystem::path> file_of_library(const Source& source) {
    const std::filesystem::path cache = usual_kernel_cache();
    if (cache.empty()) return std::nullopt;
    const auto folder = cache / "library";
    const auto file = folder / std::filesystem::path(source.name()).filename();
    const auto before = read_file(file, source.text().size());
    if (before && *before == source.text()) return file;
    if (!make_folder(folder) || !write_file(file, source.text())) return std::nullopt;
    return file;
}

}  // namespace

Json range_of(const Document& document, std::size_t begin, std::size_t end) {
    return range_in(document.text(), document.lines(), begin, end);
}

std::optional<std::pair<std::size_t, std::size_t>> bytes_of_range(const Document& document,
                                                                  const Json& json) {
    const auto from = position_from(member(json, "start")), to = position_from(member(json, "end"));
    if (!from || !to) return std::nullopt;
    const std::size_t begin = document.lines().byte_at(document.text(), *from);
    const std::size_t end = document.lines().byte_at(document.text(), *to);
    return std::pair(std::min(begin, end), std::max(begin, end));
}

Json location_of(Document& document, Span span) {
    if (span.source == own_source) {
        return {{"uri", document.uri()}, {"range", range_of(document, span)}};
    }
    const Source& source = document.script().sources[span.source];
    const std::filesystem::path name = source.name();
    const auto file = name.is_absolute() ? std::optional(name) : file_of_library(source);
    if (!file) return nullptr;
    return {{"uri", uri_of_path(*file)},
            {"range",
             range_in(source.text(), Lines(source.text(), document.unit()), span.begin, span.end)}};
}

std::span<const Answer> answers() {
    static constexpr Answer all[] = {
        {"textDocument/hover", true, hover},
        {"textDocument/completion", true, completion},
        {"textDocument/definition", true, definition},
        {"textDocument/references", true, references},
        {"textDocument/documentHighlight", true, highlights},
        {"textDocument/prepareRename", true, prepare_rename},
        {"textDocument/rename", true, rename},
        {"textDocument/formatting", false, formatting},
        {"textDocument/documentSymbol", false, symbols},
        {"textDocument/foldingRange", false, folding},
        {"textDocument/semanticTokens/full", false, semantic_tokens},
        {"textDocument/documentColor", false, colours},
        {"textDocument/colorPresentation", false, colour_texts},
        {"textDocument/codeAction", false, code_actions},
        {"textDocument/documentLink", false, links},
    };
    return all;
}

}  // namespace cascade::lsp
