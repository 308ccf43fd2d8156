// Derives values from the names in the tables of options: FILE, FOLDER, MODEL, a|b|c.
#include "app/completed.h"

#include "app/examples.h"
#include "core/palette.h"
#include "lang/library/library.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace cascade {
namespace {

using Kind = Completed::Kind;

std::vector<std::string> systems() {
    std::vector<std::string> names;
    for (const auto texts : {library_texts(), library_cells(), library_shapes()}) {
        for (const LibraryText& text : texts) names.emplace_back(text.system_name());
    }
    return names;
}

std::vector<std::string> palettes_by_name() {
    std::vector<std::string> names;
    for (const Palette& palette : palettes()) names.emplace_back(palette.name);
    return names;
}

std::vector<std::string> example_names() {
    std::vector<std::string> names;
    if (const auto examples = read_examples()) {
        for (const Example& example : *examples) names.push_back(example.name);
    }
    return names;
}

/// The commands and options whose values are names that Cascade knows.
struct Known {
    std::string_view name;
    std::vector<std::string> (*words)();
};
constexpr Known known_words[] = {{"systems", systems},
                                 {"new", systems},
                                 {"palettes", palettes_by_name},
                                 {"--palette", palettes_by_name},
                                 {"examples", example_names}};

/// Sets `values` to the names that Cascade knows for a command or an option. Returns false if it
/// knows none.
bool is_known(const std::string& name, Completed& values) {
    for (const Known& row : known_words) {
        if (row.name != name) continue;
        values = {Kind::words, row.words(), {}};
        return true;
    }
    return false;
}

/// Returns the words of a placeholder that a user types as they are. For "N|faces|vertices", these
/// are all words but N, which stands for a number.
std::vector<std::string> words_in(std::string_view value) {
    std::vector<std::string> words;
    while (!value.empty()) {
        const std::size_t end = std::min(value.find('|'), value.size());
        const std::string_view word = value.substr(0, end);
        const bool is_name = !word.empty() && std::none_of(word.begin(), word.end(), [](char c) {
            return std::isupper(static_cast<unsigned char>(c)) != 0;
        });
        if (is_name) words.emplace_back(word);
        value.remove_prefix(std::min(end + 1, value.size()));
    }
    return words;
}

}  // namespace

Completed values_of(const ManualOption& option) {
    Completed values;
    for (const std::string& name : option.names) {
        if (is_known(name, values)) return values;
    }
    const std::string& value = option.value;
    if (value.starts_with("FOLDER")) return {Kind::folders, {}, {}};
    if (value.starts_with("FILE.")) return {Kind::files, {}, {value.substr(4)}};
    if (value.starts_with("FILE") || value.starts_with("MODEL")) return {Kind::files, {}, {}};
    if (value.find('|') == std::string::npos) return {};
    return {Kind::words, words_in(value), {}};
}

Completed arguments_of(const ManualCommand& command) {
    if (command.arguments.empty()) return {};
    Completed values;
    if (is_known(command.name, values)) return values;
    const std::string& name = command.arguments.front().names.front();
    if (name.starts_with("SCRIPT")) return {Kind::files, {}, {".cascade", ".png"}};
    if (name.starts_with("MODEL")) {
        return {Kind::files, {}, {".ply", ".obj", ".off", ".stl", ".gltf", ".glb"}};
    }
    return {Kind::files, {}, {}};
}

}  // namespace cascade
