// Lists are split at commas outside of brackets. From run to run, the first name varies fastest.
#include "run/commands/variation.h"

#include "lang/syntax/script_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace cascade {

namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

template <typename Number>
std::optional<Number> read_all(std::string_view text) {
    Number number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end) return std::nullopt;
    return number;
}

Failure wrong(std::string_view text, const std::string& why) {
    return {fmt::format("'{}' does not say what to vary: {}", text, why),
            "write NAME=LOW..HIGH:COUNT or NAME=VALUE,VALUE, as in feed=0.02..0.06:9"};
}

bool is_joint(const Variation& variation) {
    return variation.name.starts_with('(') && variation.name.ends_with(')');
}

/// Returns the error for LOW:HIGH:COUNT, in which other programs write ranges. Returns an empty
/// optional for any other text.
std::optional<Failure> colons_for_dots(std::string_view text, std::string_view name,
                                       std::string_view values) {
    const std::size_t first = values.find(':'), last = values.rfind(':');
    if (first == values.npos || first == last || values.find("..") != values.npos) return {};
    const std::string_view low = trimmed(values.substr(0, first)),
                           high = trimmed(values.substr(first + 1, last - first - 1)),
                           count = trimmed(values.substr(last + 1));
    if (!read_number(low) || !read_number(high) || !read_number(count)) return {};
    Failure failure = wrong(text, "'..' must separate the ends of a range");
    const bool is_count = read_all<std::int64_t>(count).has_value();
    failure.hint = fmt::format("write {}={}..{}:{}", name, low, high, is_count ? count : "COUNT");
    return failure;
}

enum class Distances : std::uint8_t { equal, equal_ratios };

/// The ends of a range, in the same unit.
struct RangeEnds {
    double low = 0, high = 0;
    std::string unit;
};

/// Reads the ends of a range. A unit after the second end is the unit of both.
std::optional<RangeEnds> read_ends(std::string_view low, std::string_view high) {
    const auto first = read_with_unit(trimmed(low)), second = read_with_unit(trimmed(high));
    if (!first || !second || !std::isfinite(first->number) || !std::isfinite(second->number)) {
        return std::nullopt;
    }
    if (!first->unit.empty() && first->unit != second->unit) return std::nullopt;
    return RangeEnds{first->number, second->number, std::string(second->unit)};
}

constexpr std::string_view what_ends_are =
    "the ends of a range must be numbers, and may have the same unit";

/// `count` numbers from `low` to `high` as short texts. Successive numbers have equal differences
/// or equal ratios.
std::vector<std::string> spread(double low, double high, std::int64_t count, Distances distances) {
    std::vector<std::string> values;
    for (std::int64_t k = 0; k < count; ++k) {
        const double share =
            count == 1 ? 0 : static_cast<double>(k) / static_cast<double>(count - 1);
        const double value = distances == Distances::equal ? low + (high - low) * share
                                                           : low * std::pow(high / low, share);
        // A result that is closer to 0 than this is the rounding error of a result that should be
        // 0.
        const double least = 1e-12 * std::max(std::abs(low), std::abs(high));
        values.push_back(fmt::format("{:.10g}", std::abs(value) < least ? 0.0 : value));
    }
    return values;
}

/// Splits a text at commas outside of brackets.
std::vector<std::string> split_list(std::string_view text) {
    std::vector<std::string> values(1);
    int depth = 0;
    for (const char c : text) {
        depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
        if (c == ',' && depth == 0) {
            values.emplace_back();
        } else {
            values.back() += c;
        }
    }
    for (std::string& value : values) value = std::string(trimmed(value));
    return values;
}

/// Splits "(a, b)" into its parts.
std::vector<std::string> parts_of(std::string_view joint) {
    return split_list(joint.substr(1, joint.size() - 2));
}

/// Describes why the values of a list are invalid for its name. Returns an empty string if they are
/// valid.
std::string fault_of(const Variation& variation) {
    if (!is_joint(variation)) return "";
    const std::size_t count = parts_of(variation.name).size();
    for (const std::string& value : variation.values) {
        const bool has_brackets = value.starts_with('(') && value.ends_with(')');
        const std::size_t parts = has_brackets ? parts_of(value).size() : 0;
        if (parts != count) return fmt::format("'{}' is not {} values in brackets", value, count);
    }
    return "";
}

/// Returns a value that a list contains twice, or an empty string if all values differ.
std::string listed_twice(std::vector<std::string> values) {
    std::sort(values.begin(), values.end());
    const auto twice = std::adjacent_find(values.begin(), values.end());
    return twice == values.end() ? "" : *twice;
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
    const std::size_t slash = text.find('/');
    const auto above = read_all<double>(trimmed(text.substr(0, slash)));
    if (slash == std::string_view::npos || !above) return above;
    const auto below = read_all<double>(trimmed(text.substr(slash + 1)));
    if (!below || *below == 0) return std::nullopt;
    return *above / *below;
}

bool is_unit_text(std::string_view text) {
    if (text.starts_with('/')) return is_unit_text(fmt::format("1{}", text));
    if (text.empty() || text.ends_with('*') || text.ends_with('/')) return false;
    for (const UnitFactor& factor : factors_of_unit(text)) {
        if (!unit_named(factor.name)) return false;
    }
    // After a caret there are digits, perhaps with a sign, up to the next factor.
    for (std::size_t at = text.find('^'); at != text.npos; at = text.find('^', at + 1)) {
        std::string_view power = text.substr(at + 1);
        power = power.substr(0, power.find_first_of("*/"));
        if (power.starts_with('-')) power.remove_prefix(1);
        const bool is_short = !power.empty() && power.size() <= 2;
        if (!is_short || power.find_first_not_of("0123456789") != power.npos) return false;
    }
    return true;
}

std::optional<NumberWithUnit> read_with_unit(std::string_view text) {
    if (const auto number = read_number(text)) return NumberWithUnit{*number, {}};
    const std::size_t blank = text.rfind(' ');
    if (blank == std::string_view::npos) return std::nullopt;
    const auto number = read_number(trimmed(text.substr(0, blank)));
    const std::string_view unit = text.substr(blank + 1);
    if (!number || !is_unit_text(unit)) return std::nullopt;
    return NumberWithUnit{*number, fmt::format("{}{}", unit.starts_with('/') ? "1" : "", unit)};
}

std::optional<std::uint32_t> read_seed(std::string_view text) {
    return read_all<std::uint32_t>(text);
}

Result<Variation> parse_variation(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return tl::unexpected(wrong(text, "there is no '='"));
    Variation variation;
    variation.name = std::string(trimmed(text.substr(0, equals)));
    std::string_view values = trimmed(text.substr(equals + 1));
    if (variation.name.empty()) return tl::unexpected(wrong(text, "there is no name"));
    const std::size_t dots = values.find("..");
    if (auto failure = colons_for_dots(text, variation.name, values)) {
        return tl::unexpected(std::move(*failure));
    }
    if (dots == std::string_view::npos) {
        if (values.find(':') != std::string_view::npos) {
            return tl::unexpected(wrong(text, "'..' must separate the ends of a range"));
        }
        if (values.starts_with('[') && values.ends_with(']')) {
            return tl::unexpected(wrong(text, "a list must be written without brackets"));
        }
        variation.values = split_list(values);
        const auto is_empty = [](const std::string& value) { return value.empty(); };
        if (std::any_of(variation.values.begin(), variation.values.end(), is_empty)) {
            return tl::unexpected(wrong(text, "a value is missing"));
        }
        if (const std::string fault = fault_of(variation); !fault.empty()) {
            return tl::unexpected(wrong(text, fault));
        }
        return variation;
    }
    if (is_joint(variation)) return tl::unexpected(wrong(text, "a range can vary only one name"));
    Distances distances = Distances::equal;
    if (const std::size_t last = values.rfind(':');
        last != std::string_view::npos && trimmed(values.substr(last + 1)) == "log") {
        distances = Distances::equal_ratios;
        values = trimmed(values.substr(0, last));
    }
    const std::size_t colon = values.rfind(':');
    if (colon == std::string_view::npos || colon < dots) {
        return tl::unexpected(wrong(text,
                                    "':' and the number of values are missing after the "
                                    "range"));
    }
    const auto ends = read_ends(values.substr(0, dots), values.substr(dots + 2, colon - dots - 2));
    const auto count = read_all<std::int64_t>(trimmed(values.substr(colon + 1)));
    if (!ends) return tl::unexpected(wrong(text, std::string(what_ends_are)));
    if (!count || *count < 1 || *count > static_cast<std::int64_t>(most_runs)) {
        return tl::unexpected(
            wrong(text, fmt::format("a range must have 1 to {} values", most_runs)));
    }
    if (distances == Distances::equal_ratios && !(ends->low * ends->high > 0)) {
        return tl::unexpected(
            wrong(text, "with 'log', the ends of a range must be both above 0 or both below 0"));
    }
    variation.values = spread(ends->low, ends->high, *count, distances);
    if (ends->unit.empty()) return variation;
    for (std::string& value : variation.values) value += " " + ends->unit;
    return variation;
}

Result<Variation> parse_seeds(std::string_view text) {
    const auto wrong_seeds = [&](const std::string& why) {
        return failure(fmt::format("'{}' is not a list of seeds: {}", text, why),
                       "write --seeds 1..50 or --seeds 3,7,12");
    };
    const std::size_t dots = text.find("..");
    Variation variation{"seed", {}};
    if (dots == std::string_view::npos) {
        variation.values = split_list(text);
        for (const std::string& value : variation.values) {
            if (!read_seed(value)) return wrong_seeds(what_seeds_are);
        }
        return variation;
    }
    const auto first = read_seed(trimmed(text.substr(0, dots)));
    const auto last = read_seed(trimmed(text.substr(dots + 2)));
    if (!first || !last) return wrong_seeds(what_seeds_are);
    if (*last < *first) return wrong_seeds("the first seed is above the last");
    if (*last - *first >= most_runs) {
        return wrong_seeds(fmt::format("the sweep would have more than {} runs", most_runs));
    }
    for (std::uint64_t k = *first; k <= *last; ++k) {
        variation.values.push_back(fmt::format("{}", k));
    }
    return variation;
}

Result<VariedRange> parse_varied_range(std::string_view text) {
    const auto wrong_range = [&](std::string_view why) {
        return failure(fmt::format("'{}' does not say what to vary: {}", text, why),
                       "write NAME=LOW..HIGH, as in feed=0.02..0.06");
    };
    const std::size_t equals = text.find('=');
    const std::string name(trimmed(text.substr(0, equals)));
    if (equals == std::string_view::npos) return wrong_range("there is no '='");
    if (name.empty()) return wrong_range("there is no name");
    const std::string_view range = trimmed(text.substr(equals + 1));
    const std::size_t dots = range.find("..");
    if (dots == std::string_view::npos) return wrong_range("there is no range");
    const auto ends = read_ends(range.substr(0, dots), range.substr(dots + 2));
    if (!ends) return wrong_range(what_ends_are);
    if (!(ends->low < ends->high)) return wrong_range("the first end must be the smaller one");
    return VariedRange{name, ends->low, ends->high, ends->unit};
}

std::string text_of(const Variation& variation) {
    return fmt::format("{}={}", variation.name, fmt::join(variation.values, ","));
}

Result<std::size_t> count_runs(std::span<const Variation> varied) {
    if (const std::string twice = listed_twice(names_of(varied)); !twice.empty()) {
        return failure(fmt::format("'{}' is varied twice", twice),
                       "list all its values in one --vary");
    }
    std::size_t runs = 1;
    for (std::size_t k = 0; k < varied.size(); ++k) {
        if (const std::string twice = listed_twice(varied[k].values); !twice.empty()) {
            return failure(
                fmt::format("'{}' occurs twice in the values of '{}'", twice, varied[k].name));
        }
        if (varied[k].values.size() > most_runs / runs) {
            return failure(fmt::format("the sweep would have more than {} runs", most_runs),
                           "use fewer values or larger steps between them");
        }
        runs *= varied[k].values.size();
    }
    return runs;
}

std::vector<std::string> names_of(std::span<const Variation> varied) {
    std::vector<std::string> names;
    for (const Variation& variation : varied) {
        std::vector<std::string> parts = {variation.name};
        if (is_joint(variation)) parts = parts_of(variation.name);
        names.insert(names.end(), parts.begin(), parts.end());
    }
    return names;
}

std::vector<std::string> values_of_run(std::span<const Variation> varied, std::size_t number) {
    std::vector<std::string> values;
    for (const Variation& variation : varied) {
        const std::string& value = variation.values[number % variation.values.size()];
        std::vector<std::string> parts = {value};
        if (is_joint(variation)) parts = parts_of(value);
        values.insert(values.end(), parts.begin(), parts.end());
        number /= variation.values.size();
    }
    return values;
}

std::string folder_name(std::span<const Variation> varied, std::span<const std::string> values) {
    std::string name;
    const std::vector<std::string> names = names_of(varied);
    for (std::size_t k = 0; k < names.size(); ++k) {
        name += fmt::format("{}{}={}", k > 0 ? "," : "", names[k], values[k]);
    }
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

Result<Overrides> overrides_of_run(const Overrides& base, std::span<const Variation> varied,
                                   std::span<const std::string> values) {
    Overrides overrides = base;
    const std::vector<std::string> names = names_of(varied);
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (names[k] != "seed") {
            overrides.sets.push_back(fmt::format("{}={}", names[k], values[k]));
            continue;
        }
        overrides.seed = read_seed(values[k]);
        if (!overrides.seed) {
            return failure(fmt::format("'{}' is not a seed", values[k]), what_seeds_are);
        }
    }
    return overrides;
}

}  // namespace cascade
