#include "app/quantities.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

namespace cascade {

namespace {

/// Three digits, without an exponent: 1.23, 12.3, 123.
std::string three_digits(double value) {
    return fmt::format("{:.{}f}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0);
}

}  // namespace

std::string with_prefix(double value) {
    constexpr std::array<std::string_view, 8> prefixes = {"n", "µ", "m", "", "k", "M", "G", "T"};
    if (!(value > 0) || !std::isfinite(value)) return fmt::format("{} ", value);
    double unit = 1e-9;
    std::size_t prefix = 0;
    while (prefix + 1 < prefixes.size() && value >= 999.5 * unit) {
        unit *= 1e3;
        ++prefix;
    }
    return fmt::format("{} {}", three_digits(value / unit), prefixes[prefix]);
}

std::string byte_size(double bytes) {
    constexpr std::array<std::string_view, 5> units = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    std::size_t unit = 0;
    for (; unit + 1 < units.size() && bytes >= 1023.5; ++unit) bytes /= 1024;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

}  // namespace cascade
