// The table of settings.
#include "lang/vocabulary/settings.h"

#include "lang/vocabulary/functions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

namespace cascade {

namespace {

using Kind = SettingLimits::Kind;

constexpr SettingLimits between(double low, double high) { return {Kind::between, low, high}; }
constexpr SettingLimits above(double low, double high = std::numeric_limits<double>::max()) {
    return {Kind::above, low, high};
}
constexpr SettingLimits whole(double low, double high) { return {Kind::whole, low, high}; }
constexpr SettingLimits count(double low, double high) { return {Kind::count, low, high}; }
constexpr SettingLimits length(double low, double high) { return {Kind::length, low, high}; }
constexpr SettingLimits word() { return {Kind::word}; }

constexpr SettingInfo setting_table[] = {
#define CASCADE_SETTING(name, block, domains, value, words, ...) \
    {#name, SettingBlock::block, Domains::domains, SettingValue::value, words, __VA_ARGS__},
#define CASCADE_SETTING_AGAIN CASCADE_SETTING
#include "lang/vocabulary/settings.def"
};

}  // namespace

bool SettingLimits::contain(double value) const {
    if (!(value >= low && value <= high)) return false;
    if (kind == Kind::above) return value > low;
    const bool is_whole = kind == Kind::whole || kind == Kind::count;
    return !is_whole || value == std::floor(value);
}

const SettingInfo& info(Setting setting) {
    return setting_table[static_cast<std::size_t>(setting)];
}

std::span<const SettingInfo> setting_rows() { return setting_table; }

std::optional<Setting> setting_named(std::string_view word) {
    for (std::size_t i = 0; i < setting_count; ++i) {
        if (setting_table[i].word == word) return static_cast<Setting>(i);
    }
    return std::nullopt;
}

bool is_setting_of(SettingBlock block, std::string_view word) {
    return std::any_of(std::begin(setting_table), std::end(setting_table),
                       [&](const SettingInfo& row) {
                           return row.word == word && row.block == block;
                       });
}

std::vector<std::string> settings_of(std::initializer_list<SettingBlock> blocks) {
    std::vector<std::string> words;
    for (const SettingInfo& row : setting_table) {
        if (std::find(blocks.begin(), blocks.end(), row.block) == blocks.end()) continue;
        words.emplace_back(row.word);
    }
    return words;
}

std::vector<std::string> words_taken_by(const SettingInfo& setting) {
    std::istringstream words{std::string(setting.words)};
    return {std::istream_iterator<std::string>(words), {}};
}

std::string_view home_of(std::string_view word) {
    const auto setting = setting_named(word);
    if (!setting) return "";
    switch (info(*setting).block) {
        case SettingBlock::stage:
        case SettingBlock::field_stage: return "it is a setting of a stage";
        case SettingBlock::domain:
        case SettingBlock::side: return "it is a setting of the domain";
        case SettingBlock::picture: return "it is a setting of the picture";
        case SettingBlock::system: return "it is a text of a system";
        case SettingBlock::cells: return "it is a setting of a block of cells";
        case SettingBlock::cell_stage: return "it is a setting of a stage of cells";
    }
    return "";
}

Reserved reserved(std::string_view name) {
    if (is_setting_of(SettingBlock::stage, name)) return Reserved::setting;
    if (name == "pi" || builtin_named(name)) return Reserved::builtin;
    return Reserved::no;
}

}  // namespace cascade
