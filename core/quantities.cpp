// Three digits and an SI prefix, from nano to tera.
#include "core/quantities.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace cascade {

namespace {

/// Three digits, without an exponent: 1.23, 12.3, 123.
std::string three_digits(double value) {
    return fmt::format("{:.{}f}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0);
}

/// The three digits, and the prefix.
std::pair<std::string, std::string_view> scaled(double value) {
    constexpr std::array<std::string_view, 8> prefixes = {"n", "µ", "m", "", "k", "M", "G", "T"};
    if (!(value > 0) || !std::isfinite(value)) return {fmt::format("{}", value), ""};
    double unit = 1e-9;
    std::size_t prefix = 0;
    while (prefix + 1 < prefixes.size() && value >= 999.5 * unit) {
        unit *= 1e3;
        ++prefix;
    }
    return {three_digits(value / unit), prefixes[prefix]};
}

}  // namespace

std::string with_prefix(double value) {
    const auto [digits, prefix] = scaled(value);
    return prefix.empty() ? digits : fmt::format("{} {}", digits, prefix);
}

std::string with_unit(double value, std::string_view unit) {
    const auto [digits, prefix] = scaled(value);
    return fmt::format("{} {}{}", digits, prefix, unit);
}

}  // namespace cascade
