// Collects names from the tables of the language. Reads only as much of a text as is needed to find
// the block and statement at its end.
#include "lang/service/known_names.h"

#include "core/palette.h"
#include "core/utf8.h"
#include "lang/library/library.h"
#include "lang/program/cell_items.h"
#include "lang/vocabulary/greek_letters.h"
#include "lang/vocabulary/settings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <iterator>

namespace cascade {
namespace {

constexpr std::string_view blank_characters = " \t\r\n";

bool is_word_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string_view first_word(std::string_view text) {
    const auto end = std::find_if_not(text.begin(), text.end(), is_word_character);
    return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

std::string_view without_blanks_before(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(blank_characters), text.size()));
}

void add_items(std::vector<KnownName>& names, const System& system) {
    for (const ItemId item : system.quantities.ids()) {
        const Quantity& quantity = system.quantities[item];
        if (is_component(system, item)) continue;
        names.push_back({quantity.name,
                         quantity.is_species ? NameKind::species : NameKind::parameter,
                         quantity.doc});
    }
    if (system.cells) names.push_back({"p", NameKind::species, "the place of a cell"});
}

std::vector<KnownName> names_of_program(const Program& program) {
    std::vector<KnownName> names;
    for (const System& system : program.systems) {
        add_items(names, system);
        for (const DefinitionId id : system.definitions.ids()) {
            const Definition& definition = system.definitions[id];
            const auto& cells = system.cells;
            if (cells && (id == cells->velocity || id == cells->spin)) continue;
            names.push_back({definition.name, NameKind::definition, ""});
        }
        names.push_back({system.name, NameKind::system, system.title});
    }
    for (const Stage& stage : program.stages) {
        names.push_back({stage.name, NameKind::stage, program.systems[stage.system].name});
    }
    return names;
}

std::vector<KnownName> names_of_language() {
    std::vector<KnownName> names;
    for (std::size_t k = 0; k < function_count; ++k) {
        const FunctionInfo& row = info(static_cast<Function>(k));
        if (!row.is_named) continue;
        names.push_back({std::string(row.spelling), NameKind::function, std::string(row.meaning)});
    }
    for (const std::string_view name : builtin_names) {
        names.push_back({std::string(name), NameKind::value, ""});
    }
    for (const std::string_view name : cell_value_names) {
        names.push_back({std::string(name), NameKind::value, "of cells that crawl"});
    }
    for (std::size_t k = 0; k < setting_count; ++k) {
        const auto setting = static_cast<Setting>(k);
        names.push_back({std::string(info(setting).word), NameKind::setting,
                         std::string(info(setting).meaning)});
        for (std::string& word : words_taken_by(setting)) {
            names.push_back({std::move(word), NameKind::word, ""});
        }
    }
    for (std::string& solver : solver_names()) {
        names.push_back({std::move(solver), NameKind::word, "a solver"});
    }
    for (const LibraryText& text : library_texts()) {
        names.push_back({std::string(text.system_name()), NameKind::system, "of the library"});
    }
    for (const LibraryText& text : library_shapes()) {
        names.push_back(
            {std::string(text.system_name()), NameKind::word, "a shape of the library"});
    }
    for (const std::string_view word : keywords) {
        names.push_back({std::string(word), NameKind::keyword, ""});
    }
    return names;
}

/// Sorts names. If several names are equal, keeps only the first.
std::vector<KnownName> sorted(std::vector<KnownName> names) {
    std::stable_sort(names.begin(), names.end(),
                     [](const auto& one, const auto& other) { return one.name < other.name; });
    const auto same = [](const auto& one, const auto& other) { return one.name == other.name; };
    names.erase(std::unique(names.begin(), names.end(), same), names.end());
    return names;
}

std::vector<KnownName> of_kinds(const Program& program, std::initializer_list<NameKind> kinds) {
    std::vector<KnownName> names = names_of_program(program), rest = names_of_language();
    std::move(rest.begin(), rest.end(), std::back_inserter(names));
    names.erase(std::remove_if(names.begin(), names.end(),
                               [&](const KnownName& name) {
                                   return std::find(kinds.begin(), kinds.end(), name.kind) ==
                                          kinds.end();
                               }),
                names.end());
    return names;
}

/// What is open at the end of a text: the blocks, the calls and the statement.
struct TextPlace {
    struct Block {
        /// For example, `stage` and `one` in `stage one: spots {`.
        std::string_view keyword, name;
    };
    std::vector<Block> blocks;            ///< The open blocks, outermost first.
    std::vector<std::string_view> calls;  ///< The words directly before the open brackets.
    std::string_view statement;           ///< The last statement, as far as the text contains it.
    bool is_comment = false;
    bool is_string = false;
};

/// Whether a statement continues in the next line if `last` is the last character of its line.
bool goes_on(char last) {
    return std::string_view("+-*/^,=<>:").find(last) != std::string_view::npos;
}

TextPlace place_at_end(std::string_view text) {
    TextPlace place;
    std::size_t begin = 0;
    char last = 0;  // The last character of the statement so far, without blanks and comments.
    const auto statement_to = [&](std::size_t end) {
        return without_blanks_before(text.substr(begin, end - begin));
    };
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '#' || c == '"') {
            const std::size_t end = text.find_first_of(c == '#' ? "\n" : "\"\n", k + 1);
            const bool is_open = end == std::string_view::npos;
            place.is_comment = is_open && c == '#';
            place.is_string = is_open && c == '"';
            if (is_open) break;
            k = text[end] == '\n' ? end - 1 : end;
        } else if (c == '{') {
            const std::string_view header = statement_to(k), keyword = first_word(header);
            place.blocks.push_back(
                {keyword, first_word(without_blanks_before(header.substr(keyword.size())))});
        } else if (c == '}') {
            if (!place.blocks.empty()) place.blocks.pop_back();
        } else if (c == '(' || c == '[') {
            place.calls.push_back(last_word(text.substr(0, k)));
        } else if (c == ')' || c == ']') {
            if (!place.calls.empty()) place.calls.pop_back();
        }
        const bool ends_line = c == '\n' && place.calls.empty() && !goes_on(last);
        const bool ends_statement = c == '{' || c == '}' || c == ';';
        if (ends_statement) place.calls.clear();
        if (ends_line || ends_statement) {
            begin = k + 1;
            last = 0;
        } else if (c != '#' && blank_characters.find(c) == std::string_view::npos) {
            last = c;
        }
    }
    place.statement = statement_to(text.size());
    return place;
}

std::optional<std::uint32_t> stage_named(const Program& program, std::string_view name) {
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (program.stages[k].name == name) return k;
    }
    return std::nullopt;
}

/// The stage that a block declares or, if the block declares a system, the first stage of that
/// system.
std::optional<std::uint32_t> stage_of_block(const Program& program, const TextPlace::Block& block) {
    if (block.keyword == "stage") return stage_named(program, block.name);
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (program.system_of(k).name == block.name) return k;
    }
    return std::nullopt;
}

/// The stage that is named before a dot at the end of a text.
std::optional<std::uint32_t> stage_before_dot(std::string_view text, const Program& program) {
    if (!text.ends_with('.')) return std::nullopt;
    return stage_named(program, last_word(text.substr(0, text.size() - 1)));
}

std::vector<KnownName> items_of(const Program& program, std::uint32_t stage) {
    std::vector<KnownName> names;
    const System& system = program.system_of(stage);
    add_items(names, system);
    for (const ItemId item : {system.frozen_item(), system.speed_item()}) {
        const std::string_view name = system.item_name(item);
        names.push_back({std::string(name), NameKind::setting,
                         std::string(info(*setting_named(name)).meaning)});
    }
    return names;
}

bool has_settings_of(std::string_view block, SettingBlock of) {
    if (block == "shape") return false;
    if (block == "picture") return of == SettingBlock::picture;
    if (of == SettingBlock::side) return true;
    if (block == "domain") return of == SettingBlock::domain;
    if (of == SettingBlock::system) return block == "system" || block == "cells";
    if (of == SettingBlock::cells) return block == "cells";
    const bool is_of_stages = of == SettingBlock::cell_stage || of == SettingBlock::field_stage;
    return of == SettingBlock::stage || (is_of_stages && block == "stage");
}

/// The names with which statements of a block can begin.
std::vector<KnownName> names_that_begin(std::string_view block, const Program& program) {
    std::vector<KnownName> names;
    if (block == "stage" || block == "system" || block == "cells") {
        names = of_kinds(program, {NameKind::species, NameKind::parameter});
    }
    for (const SettingInfo& row : setting_rows()) {
        if (!has_settings_of(block, row.block)) continue;
        names.push_back({std::string(row.word), NameKind::setting, std::string(row.meaning)});
    }
    return names;
}

/// The names that are allowed in the value of a statement. If the statement is a setting, these
/// include the words of the setting.
std::vector<KnownName> names_in_value(std::string_view statement, const Program& program) {
    const std::string_view name = first_word(statement);
    const bool has_value = without_blanks_before(statement.substr(name.size())).starts_with(':');
    const auto setting = has_value ? setting_named(name) : std::nullopt;
    std::vector<KnownName> names;
    if (setting) {
        for (std::string& word : words_taken_by(*setting)) {
            names.push_back({std::move(word), NameKind::word, ""});
        }
        if (*setting == Setting::shape) {
            for (const LibraryText& text : library_shapes()) {
                names.push_back({std::string(text.system_name()), NameKind::word, ""});
            }
        }
        if (*setting == Setting::solver) {
            for (std::string& word : solver_names()) {
                names.push_back({std::move(word), NameKind::word, ""});
            }
        }
        const SettingValue value = info(*setting).value;
        if (value == SettingValue::word || value == SettingValue::words) return names;
    }
    for (KnownName& each :
         of_kinds(program, {NameKind::species, NameKind::parameter, NameKind::definition,
                            NameKind::stage, NameKind::function, NameKind::value})) {
        names.push_back(std::move(each));
    }
    for (const std::string_view word : {"and", "or", "not", "over", "domain", "in", "pi"}) {
        names.push_back({std::string(word), NameKind::keyword, ""});
    }
    return names;
}

}  // namespace

std::string_view last_word(std::string_view text) {
    std::size_t begin = text.size();
    while (const std::size_t size = last_letter_of_name(text.substr(0, begin))) begin -= size;
    return text.substr(begin);
}

std::string_view name_of(NameKind kind) {
    constexpr std::array<std::string_view, 12> names{"species",  "parameter", "definition",
                                                     "stage",    "system",    "shape",
                                                     "function", "value",     "setting",
                                                     "word",     "palette",   "keyword"};
    return names[static_cast<std::size_t>(kind)];
}

std::vector<KnownName> known_names(const Program& program) {
    std::vector<KnownName> names = names_of_program(program), rest = names_of_language();
    std::move(rest.begin(), rest.end(), std::back_inserter(names));
    return sorted(std::move(names));
}

std::size_t end_of_word(std::string_view text, std::size_t byte) {
    while (byte < text.size()) {
        const std::size_t next = byte + decode_utf8(text, byte).size;
        if (last_letter_of_name(text.substr(0, next)) == 0) break;
        byte = next;
    }
    return std::min(byte, text.size());
}

std::vector<KnownName> completions(std::string_view typed, std::size_t byte,
                                   const Program& program) {
    const std::string ascii = with_ascii_names(typed.substr(0, byte));
    std::string_view text = ascii;
    text.remove_suffix(last_word(text).size());
    const TextPlace place = place_at_end(text);
    if (place.is_comment) return {};
    if (place.is_string) {
        std::vector<KnownName> names;
        if (place.calls.empty() || place.calls.back() != "palette") return names;
        for (const Palette& palette : palettes()) {
            names.push_back(
                {std::string(palette.name), NameKind::palette, std::string(palette.description)});
        }
        return names;
    }
    if (const auto stage = stage_before_dot(text, program)) return items_of(program, *stage);
    const std::string_view keyword = first_word(place.statement);
    const bool is_header = keyword == "stage" || keyword == "system" || keyword == "cells";
    if (keyword == "use" || keyword == "system_name" ||
        (is_header && place.statement.find(':') != std::string_view::npos)) {
        return sorted(of_kinds(program, {NameKind::system}));
    }
    if (place.blocks.empty()) return known_names(program);
    if (place.statement.empty()) {
        return sorted(names_that_begin(place.blocks.back().keyword, program));
    }
    return sorted(names_in_value(place.statement, program));
}

std::optional<Mention> mention(std::string_view typed, std::size_t byte, const Program& program,
                               std::uint32_t stage) {
    const std::string ascii = with_ascii_names(typed.substr(0, end_of_word(typed, byte)));
    std::string_view text = ascii;
    const std::string_view word = last_word(text);
    text.remove_suffix(word.size());
    const TextPlace place = place_at_end(text);
    if (place.is_comment) return std::nullopt;
    const auto named_before = stage_before_dot(text, program);
    std::optional<std::uint32_t> first = named_before;
    if (!first && !place.blocks.empty()) first = stage_of_block(program, place.blocks.back());
    std::vector<std::uint32_t> stages{first.value_or(stage)};
    for (std::uint32_t k = 0; k < program.stages.size() && !named_before; ++k) stages.push_back(k);
    for (const std::uint32_t k : stages) {
        if (k >= program.stages.size()) continue;
        const System& system = program.system_of(k);
        for (const ItemId item : system.quantities.ids()) {
            const Quantity& quantity = system.quantities[item];
            if (quantity.name != word) continue;
            const auto kind = quantity.is_species ? NameKind::species : NameKind::parameter;
            return Mention{{quantity.name, kind, quantity.doc}, StageItem{k, item}};
        }
    }
    for (const auto& list : {completions(text, text.size(), program), known_names(program)}) {
        for (const KnownName& known : list) {
            if (known.name == word) return Mention{known, std::nullopt};
        }
    }
    return std::nullopt;
}

}  // namespace cascade
