// The tables of LaTeX commands and of units.
#include "lang/vocabulary/signs_elsewhere.h"

#include "core/decimal.h"
#include "lang/vocabulary/greek_letters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace cascade {

namespace {

struct LatexCommand {
    std::string_view name, advice;
};
constexpr LatexCommand latex_commands[] = {
    {"", "a statement continues on the next line inside ( ) and after an operator"},
    {"partial",
     "this is LaTeX; write u' = … for \\partial u/\\partial t, dx(u) for \\partial u/\\partial x"},
    {"nabla", "this is LaTeX; write lap(u), grad(u) or div(…)"},
    {"Delta", "this is LaTeX; write lap(u), grad(u) or div(…)"},
    {"frac", "this is LaTeX; write a / b"},
    {"cdot", "this is LaTeX; write a * b"},
    {"times", "this is LaTeX; write a * b"},
    {"sqrt", "this is LaTeX; write sqrt(u)"},
    {"exp", "this is LaTeX; write exp(u)"},
    {"log", "this is LaTeX; write log(u)"},
    {"sin", "this is LaTeX; write sin(u)"},
    {"cos", "this is LaTeX; write cos(u)"},
    {"tanh", "this is LaTeX; write tanh(u)"},
};

struct Unit {
    std::string_view name;
    double size;  ///< The size of the unit in metres or seconds.
    std::string_view base;
};
constexpr Unit units[] = {
    {"m", 1, "metres"},     {"cm", 1e-2, "metres"},    {"mm", 1e-3, "metres"},
    {"um", 1e-6, "metres"}, {"µm", 1e-6, "metres"},    {"nm", 1e-9, "metres"},
    {"km", 1e3, "metres"},  {"s", 1, "seconds"},       {"ms", 1e-3, "seconds"},
    {"min", 60, "seconds"}, {"h", 3600, "seconds"},    {"steps", 1, ""},
    {"iterations", 1, ""},  {"cells", 1, ""},          {"pixels", 1, ""},
    {"px", 1, ""},          {"seconds", 1, "seconds"},
};

/// Advice on `0x10` (as in other languages) and on `100x100` (the size of a screen). Empty for
/// other words.
std::string advice_about_cross(std::string_view word) {
    constexpr std::size_t longest = 18;
    const std::size_t cross = word.find_first_of("xX");
    if (cross == std::string_view::npos || cross + 1 == word.size() || word.size() > longest) {
        return "";
    }
    const std::string_view before = word.substr(0, cross), after = word.substr(cross + 1);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(after.data(), after.data() + after.size(), value, 16);
    if (before == "0" && error == std::errc() && end == after.data() + after.size()) {
        return fmt::format("write {}", value);
    }
    const auto is_whole = [](std::string_view text) {
        return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
    };
    std::string list(before);
    for (std::string_view rest = after; is_whole(before);) {
        const std::size_t next = std::min(rest.find_first_of("xX"), rest.size());
        if (!is_whole(rest.substr(0, next))) break;
        list += fmt::format(", {}", rest.substr(0, next));
        if (next == rest.size()) return fmt::format("write '{}'", list);
        rest.remove_prefix(next + 1);
    }
    return "";
}

}  // namespace

std::string advice_about_latex(std::string_view command) {
    for (const LatexCommand& each : latex_commands) {
        if (each.name == command) return std::string(each.advice);
    }
    return fmt::format("this is LaTeX; write {}", command);
}

std::string advice_about_unit(std::string_view number, std::string_view unit) {
    for (const Unit& each : units) {
        if (each.name != unit) continue;
        double value = 0;
        from_decimal(number.data(), number.data() + number.size(), value);
        if (each.base.empty()) return fmt::format("numbers have no units: write '{}'", number);
        return fmt::format("numbers have no units: write '{}' for {} {} in {}",
                           fmt::format("{:g}", value * each.size), number, unit, each.base);
    }
    return "";
}

std::string advice_about_number(std::string_view number, std::string_view tail) {
    constexpr std::size_t longest = 64;
    if (std::string advice = advice_about_cross(fmt::format("{}{}", number, tail));
        !advice.empty()) {
        return advice;
    }
    if (std::string advice = advice_about_unit(number, tail); !advice.empty()) return advice;
    if (tail == "e" || tail == "E") return "an exponent has digits, as in 1e-3";
    const bool is_name = !is_digit(tail[0]) && tail[0] != '_' && tail[0] != '.';
    if (!is_name || number.size() + tail.size() > longest) return "";
    return fmt::format("write '{} * {}'", number, tail);
}

std::string advice_about_hex_colour(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    if (!line.starts_with('#')) return "";
    line.remove_prefix(1);
    const std::size_t count =
        std::min(line.find_first_not_of("0123456789abcdefABCDEF"), line.size());
    const bool is_short = count == 3;
    if (!is_short && count != 6) return "";
    const auto channel = [&](std::size_t k) {
        const std::string_view own = is_short ? line.substr(k, 1) : line.substr(2 * k, 2);
        unsigned value = 0;
        std::from_chars(own.data(), own.data() + own.size(), value, 16);
        return value / (is_short ? 15.0 : 255.0);
    };
    return fmt::format("a colour has no '#'; write 'rgb({:.3g}, {:.3g}, {:.3g})'", channel(0),
                       channel(1), channel(2));
}

}  // namespace cascade
