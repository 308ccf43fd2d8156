// The settings of the language, and what each takes.
#pragma once

#include "lang/vocabulary/domains.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The settings of settings.def.
enum class Setting : std::uint8_t {
#define CASCADE_SETTING(word, ...) word,
#include "lang/vocabulary/settings.def"
};

inline constexpr std::size_t setting_count = 0
#define CASCADE_SETTING(...) +1
#include "lang/vocabulary/settings.def"
    ;

// The columns of settings.def, which says what each word means.
enum class SettingBlock : std::uint8_t { stage, domain, side, picture, system };
enum class SettingValue : std::uint8_t {
    count,
    number,
    numbers,
    expression,
    expressions,
    word,
    words,
    text,
};

struct SettingInfo {
    std::string_view word;
    SettingBlock block;
    Domains domains;
    SettingValue value;
    std::string_view words;
    std::string_view meaning;
};
const SettingInfo& info(Setting setting);

std::optional<Setting> setting_named(std::string_view word);
/// Is the word a setting of the block?
bool is_setting_of(SettingBlock block, std::string_view word);
/// The settings of some blocks, in their order in the table.
std::vector<std::string> settings_of(std::initializer_list<SettingBlock> blocks);
/// The words that mean something as the value of a setting.
std::vector<std::string> words_taken_by(Setting setting);
/// Where a word belongs that is a setting of another block than the one it was found in; "" for
/// words that are no settings.
std::string_view home_of(std::string_view word);

/// The words that begin statements and blocks, and those between the parts of an expression.
inline constexpr std::string_view keywords[] = {"system",      "stage", "domain", "picture",
                                                "system_name", "fn",    "use",    "and",
                                                "or",          "not",   "over",   "in",
                                                "pi"};

}  // namespace cascade
