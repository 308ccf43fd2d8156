// Finds the library systems and shapes that a script names, and their bases. Parses only these
// texts of the library.
#include "lang/library/library.h"

#include "core/check.h"
#include "lang/syntax/parse.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace cascade {

namespace {

/// The source of a library text, if an earlier check has added the text to `sources`.
std::optional<SourceId> find_source(const LibraryText& text, const Sources& sources) {
    for (SourceId id = 0; id < sources.size(); ++id) {
        if (sources[id].name() == text.file_name && sources[id].text() == text.text) return id;
    }
    return std::nullopt;
}

/// The source of a library text. Adds the text to `sources` if no earlier check has added it.
SourceId source_of(const LibraryText& text, Sources& sources) {
    if (const auto known = find_source(text, sources)) return *known;
    return sources.add(std::string(text.file_name), std::string(text.text));
}

LibraryScript read_text(const LibraryText& text, Sources& sources, Diagnostics& diagnostics) {
    LibraryScript result{parse(source_of(text, sources), sources, diagnostics), 0};
    const auto& blocks = result.script.blocks;
    const auto found = std::find_if(blocks.begin(), blocks.end(), [&](const ast::Block& block) {
        const bool is_named =
            block.kind == ast::BlockKind::system || block.kind == ast::BlockKind::shape;
        return is_named && block.name.text == text.system_name();
    });
    CHECK(found != blocks.end(), "a text of the library holds the system of its name");
    result.block = static_cast<std::size_t>(found - blocks.begin());
    return result;
}

bool is_stage(const ast::Block& block) {
    return block.kind == ast::BlockKind::stage || block.kind == ast::BlockKind::classic_stage;
}

/// The names that the script may take from the library, without duplicates.
std::vector<std::string_view> names_wanted(const ast::Script& script) {
    std::unordered_set<std::string_view> own;
    for (const ast::Block& block : script.blocks) {
        if (block.kind == ast::BlockKind::system) own.insert(block.name.text);
    }
    std::vector<std::string_view> wanted;
    for (const ast::Block& block : script.blocks) {
        const bool is_derived = block.kind == ast::BlockKind::system;
        if (!is_derived && (!is_stage(block) || own.contains(block.base.text))) continue;
        // In `system a: a { … }` the base is the library's a. Any other base may be one of the
        // script's own systems.
        if (is_derived && block.base.text != block.name.text && own.contains(block.base.text)) {
            continue;
        }
        wanted.push_back(block.base.text);
        for (const ast::Word& base : block.joined) {
            if (!own.contains(base.text)) wanted.push_back(base.text);
        }
    }
    return wanted;
}

/// The text of the system or shape with this name; null if there is none. `texts` must be in
/// alphabetical order.
const LibraryText* text_of(std::span<const LibraryText> texts, std::string_view name) {
    const auto found = std::ranges::lower_bound(texts, name, {}, &LibraryText::system_name);
    return found != texts.end() && found->system_name() == name ? &*found : nullptr;
}

/// Parses the texts with these names, and the texts of their bases. In the result, each text comes
/// after its bases. `find` returns the text with a given name.
template <typename Find>
std::vector<LibraryScript> read_texts(const std::vector<std::string_view>& names, const Find& find,
                                      Sources& sources, Diagnostics& diagnostics) {
    std::vector<LibraryScript> result;
    std::unordered_set<std::string_view> read;
    for (const std::string_view name : names) {
        // Visits each text twice: the first visit adds the text's bases to `open`, and the second
        // visit adds the text to the result.
        std::vector<std::string_view> open{name};
        std::unordered_map<std::string_view, LibraryScript> waiting;
        while (!open.empty()) {
            const std::string_view next = open.back();
            if (const auto known = waiting.find(next); known != waiting.end()) {
                open.pop_back();
                result.push_back(std::move(known->second));
                waiting.erase(known);
                continue;
            }
            const LibraryText* const found = find(next);
            if (found == nullptr || !read.insert(next).second) {
                open.pop_back();
                continue;
            }
            const LibraryScript& each =
                waiting.emplace(next, read_text(*found, sources, diagnostics)).first->second;
            const ast::Block& block = each.script.blocks[each.block];
            for (const ast::Word& base : block.joined) open.push_back(base.text);
            if (!block.base.empty()) open.push_back(block.base.text);
        }
    }
    return result;
}

}  // namespace

const LibraryText* find_shape_text(std::string_view name) {
    return text_of(library_shapes(), name);
}

const LibraryText* find_library_text(std::string_view system_name) {
    const LibraryText* const found = text_of(library_texts(), system_name);
    return found != nullptr ? found : text_of(library_cells(), system_name);
}

ast::Script read_cell_functions(Sources& sources, Diagnostics& diagnostics) {
    return parse(source_of(cell_functions(), sources), sources, diagnostics);
}

ast::Script cell_functions_of(const Sources& sources) {
    const auto source = find_source(cell_functions(), sources);
    Diagnostics never_any;
    return source ? parse(*source, sources, never_any) : ast::Script();
}

std::vector<LibraryScript> read_library(const ast::Script& script, Sources& sources,
                                        Diagnostics& diagnostics) {
    return read_texts(names_wanted(script), find_library_text, sources, diagnostics);
}

std::vector<LibraryScript> read_library_shapes(const std::vector<std::string_view>& names,
                                               Sources& sources, Diagnostics& diagnostics) {
    return read_texts(names, find_shape_text, sources, diagnostics);
}

}  // namespace cascade
