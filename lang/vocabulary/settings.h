// The settings of the language, and their values.
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

// The columns of settings.def, which explains each word.
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

/// Which numbers are values of a setting.
struct SettingLimits {
    enum class Kind : std::uint8_t {
        none,
        between,
        above,   ///< Above `low`, and finite.
        whole,   ///< Whole numbers.
        count,   ///< The same; what is wrong with another one is said exactly.
        length,  ///< From `low`, which is above 0.
        word,    ///< Only words.
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
/// All rows of the table: the rows of `Setting` in its order, then words that another block has,
/// too.
std::span<const SettingInfo> setting_rows();

std::optional<Setting> setting_named(std::string_view word);
/// True if the word is a setting of the block.
bool is_setting_of(SettingBlock block, std::string_view word);
/// The settings of some blocks, in the order of the table.
std::vector<std::string> settings_of(std::initializer_list<SettingBlock> blocks);
/// The words that are values of a setting.
std::vector<std::string> words_taken_by(const SettingInfo& setting);
inline std::vector<std::string> words_taken_by(Setting setting) {
    return words_taken_by(info(setting));
}
/// The block of a setting that belongs to another one. "" for words that are not settings.
std::string_view home_of(std::string_view word);

/// Words that begin statements and blocks or separate the parts of an expression.
inline constexpr std::string_view keywords[] = {
    "system", "cells", "stage", "domain", "picture", "shape", "system_name", "fn", "let",
    "use",    "and",   "or",    "not",    "over",    "in",    "after",       "pi"};

/// Words that the language gives a meaning, so that a script cannot declare them.
enum class Reserved : std::uint8_t { no, setting, builtin };
Reserved reserved(std::string_view name);

}  // namespace cascade
