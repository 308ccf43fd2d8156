// Divides the words of the tables into lists by the positions at which they have a meaning.
#include "lsp/words.h"

#include "ir/solver.h"
#include "lang/library/library.h"
#include "lang/syntax/paper_notation.h"
#include "lang/vocabulary/functions.h"
#include "lang/vocabulary/settings.h"

#include <nlohmann/json.hpp>

#include <set>

namespace cascade::lsp {
namespace {

using Words = std::set<std::string, std::less<>>;

/// The functions that are called by name, and the first words of functions such as `sum over
/// domain`. The last words of these functions are added to `regions`.
void add_functions(Words& functions, Words& regions) {
    constexpr std::string_view over = " over ";
    for (std::size_t k = 0; k < function_count; ++k) {
        const FunctionInfo& row = info(static_cast<Function>(k));
        if (row.is_named) functions.emplace(row.spelling);
        if (!row.is_reduction) continue;
        const std::size_t at = row.spelling.find(over);
        functions.emplace(row.spelling.substr(0, at));
        regions.emplace(row.spelling.substr(at + over.size()));
    }
}

void add_settings(Words& settings, Words& words) {
    for (const SettingInfo& row : setting_rows()) {
        settings.emplace(row.word);
        for (std::string& word : words_taken_by(row)) words.insert(std::move(word));
    }
    for (std::string& solver : solver_names()) words.insert(std::move(solver));
    for (const LibraryText& text : library_shapes()) words.emplace(text.system_name());
}

/// Divides the keywords into keywords that begin a statement and keywords between operands.
void add_keywords(Words& beginnings, Words& between) {
    for (const std::string_view word : keywords) {
        const bool is_logic = word == "and" || word == "or" || word == "not";
        if (word == "pi") continue;
        (is_logic || is_word_between_operands(word) ? between : beginnings).emplace(word);
    }
}

}  // namespace

std::string language_words() {
    Words beginnings, between, functions, regions, settings, words, values{"pi"};
    add_keywords(beginnings, between);
    add_functions(functions, regions);
    add_settings(settings, words);
    values.insert(builtin_names.begin(), builtin_names.end());
    // In `up: x` and `surface: box`, the words are coloured as the value x and the function box.
    std::erase_if(words, [&](const std::string& word) {
        return values.contains(word) || functions.contains(word);
    });
    return nlohmann::json{{"beginnings", beginnings},
                          {"between", between},
                          {"functions", functions},
                          {"regions", regions},
                          {"settings", settings},
                          {"values", values},
                          {"words", words}}
               .dump(1) +
           "\n";
}

}  // namespace cascade::lsp
