// The settings of the language, and the values that they take.
#pragma once

#include "lang/vocabulary/domains.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
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

// Columns of settings.def, where each word is explained.
enum class SettingBlock : std::uint8_t {
    stage,
    domain,
    side,
    picture,
    system,
    cells,
    cell_stage,
    field_stage,
};
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

/// The numbers that a setting accepts.
struct SettingLimits {
    enum class Kind : std::uint8_t {
        none,
        between,
        above,  ///< Finite numbers above `low`.
        whole,  ///< Whole numbers.
        /// Whole numbers. If any other number is given, the message states exactly what is wrong
        /// with it.
        count,
        length,  ///< Numbers of at least `low`, where `low` is above 0.
        word,    ///< No numbers, only words.
    };
    Kind kind = Kind::none;
    double low = 0, high = 0;

    bool contain(double value) const;
};

struct SettingInfo {
    std::string_view word;
    SettingBlock block;
    Domains domains;
    SettingValue value;
    std::string_view words;
    std::string_view meaning;
    SettingLimits limits = {};
    std::string_view refusal = "";
    std::string_view hint = "";
};
const SettingInfo& info(Setting setting);
/// All rows of the table: first the settings in the order of `Setting`, then the rows for words
/// that are also settings of another block.
std::span<const SettingInfo> setting_rows();

std::optional<Setting> setting_named(std::string_view word);
/// Whether the word is a setting of the block.
bool is_setting_of(SettingBlock block, std::string_view word);
/// The settings of the given blocks, in the order of the table.
std::vector<std::string> settings_of(std::initializer_list<SettingBlock> blocks);
/// The words that are values of a setting.
std::vector<std::string> words_taken_by(const SettingInfo& setting);
inline std::vector<std::string> words_taken_by(Setting setting) {
    return words_taken_by(info(setting));
}
/// The block in which a word is a setting, for hints in other blocks. "" for words that are not
/// settings.
std::string_view home_of(std::string_view word);

/// Words that begin statements and blocks, and words that separate the parts of an expression.
inline constexpr std::string_view keywords[] = {
    "system", "cells", "stage", "domain", "picture", "shape", "system_name", "fn", "let",
    "use",    "and",   "or",    "not",    "over",    "in",    "after",       "pi"};

/// Whether the language gives a word a meaning, so that scripts cannot declare it.
enum class Reserved : std::uint8_t { no, setting, builtin };
Reserved reserved(std::string_view name);

}  // namespace cascade
