// Reads settings. The row of a setting in settings.def contains the allowed values, and the message
// about other values.
#include "lang/check/expressions/read_setting.h"

#include "core/check.h"
#include "lang/check/names/check_names.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/vocabulary/settings.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace cascade::checking {

namespace {

/// A hint about a number such as `0,0125`. Digits on both sides of a comma suggest that the comma
/// is a decimal point.
std::string hint_of_decimal_comma(const ast::Script& script, const ast::Statement& statement) {
    if (statement.values.size() != 2) return "";
    const Span whole = span_of(script, statement.values[0]);
    const Span part = span_of(script, statement.values[1]);
    const auto is_number = [&](std::size_t k) {
        return std::holds_alternative<ast::Number>(
            script.expressions[statement.values[k].root].node);
    };
    if (!is_number(0) || !is_number(1) || part.begin != whole.end + 1) return "";
    const std::string_view name = statement.name.text;
    const bool is_count = name == "iterations" || name == "interval" || name == "duration";
    if (is_count && part.end - part.begin == 3) {
        const auto number = [&](std::size_t k) {
            return std::get<ast::Number>(script.expressions[statement.values[k].root].node).value;
        };
        return fmt::format("write '{}'", 1000 * number(0) + number(1));
    }
    return "write '.' for ',': the decimal separator is a point";
}

}  // namespace

bool has_one_value(Workspace& work, const ast::Script& script, const ast::Statement& statement) {
    if (statement.values.size() == 1) return true;
    if (statement.values.empty()) return false;
    work.diagnostics.error(span_of(script, statement.values[1]),
                           fmt::format("'{}' takes one value", statement.name.text),
                           hint_of_decimal_comma(script, statement));
    return false;
}

namespace {

/// The dimension of a setting's numbers.
Dimension dimension_of(std::string_view setting) {
    static constexpr std::array<std::string_view, 2> lengths{"spacing", "size"};
    static constexpr std::array<std::string_view, 3> times{"duration", "every", "largest_step"};
    if (std::ranges::find(lengths, setting) != lengths.end()) {
        return Dimension::of(BaseQuantity::length);
    }
    if (std::ranges::find(times, setting) != times.end()) return Dimension::of(BaseQuantity::time);
    return {};
}

/// The message that explains why a setting does not accept a number.
std::string refusal_of(const SettingInfo& setting, double value) {
    using Kind = SettingLimits::Kind;
    const auto& [kind, low, high] = setting.limits;
    if (kind == Kind::count) {
        if (value < low) return fmt::format("{} must be at least {}", setting.word, low);
        if (value > high) return fmt::format("{} must be at most {}", setting.word, high);
        return fmt::format("{} must be a whole number", setting.word);
    }
    if (kind == Kind::length && !(value > 0)) {
        return fmt::format("{} must be above 0", setting.word);
    }
    if (!setting.refusal.empty()) return std::string(setting.refusal);
    return fmt::format("{} must be {}from {} to {}", setting.word,
                       kind == Kind::whole ? "a whole number " : "", low, high);
}

}  // namespace

std::optional<double> read_number(Workspace& work, const ast::Script& script,
                                  const ast::Statement& statement) {
    if (!has_one_value(work, script, statement)) return std::nullopt;
    const SettingInfo& row = info(*setting_named(statement.name.text));
    CHECK(row.limits.kind != SettingLimits::Kind::none, "the row says which numbers it takes");
    const auto value =
        check_constant(work, script, statement.values[0], row.word, dimension_of(row.word));
    if (!value || row.limits.contain(*value)) return value;
    // The hint fits any refused number, with one exception: for a number of steps, it fits only
    // between 0 and 1, where the author may mean a length of time.
    const bool fits = row.limits.kind != SettingLimits::Kind::count || (*value > 0 && *value < 1);
    work.diagnostics.error(value_of(script, statement).span, refusal_of(row, *value),
                           std::string(fits ? row.hint : ""));
    return std::nullopt;
}

std::optional<std::size_t> read_word(Workspace& work, const ast::Script& script,
                                     const ast::Statement& statement) {
    if (!has_one_value(work, script, statement)) return std::nullopt;
    const ast::Expr& value = value_of(script, statement);
    if (std::holds_alternative<ast::Garbage>(value.node)) return std::nullopt;
    const SettingInfo& row = info(*setting_named(statement.name.text));
    const auto* const name = std::get_if<ast::Name>(&value.node);
    const std::string_view word = name != nullptr ? name->name : std::string_view();
    const std::vector<std::string> words = words_taken_by(row);
    const auto found = std::find(words.begin(), words.end(), word);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    std::string hint;
    if (setting_named(row.word) == Setting::precision) {
        const auto* const number = std::get_if<ast::Number>(&value.node);
        hint = advice_about(number != nullptr ? fmt::format("{}", number->value) : word,
                            WordContext::precision);
    }
    if (hint.empty()) hint = did_you_mean(work, word, words);
    work.diagnostics.error(value.span, std::string(row.refusal), std::move(hint));
    return std::nullopt;
}

}  // namespace cascade::checking
