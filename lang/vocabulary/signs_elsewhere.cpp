// The table of LaTeX commands, and advice on signs and numbers as other programs write them.
#include "lang/vocabulary/signs_elsewhere.h"

#include "core/decimal.h"
#include "lang/vocabulary/greek_letters.h"
#include "lang/vocabulary/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <iterator>
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

/// Names of things that newcomers write after a number, as if they were units: "20 steps".
constexpr std::string_view counted_things[] = {"steps", "iterations", "cells", "pixels", "px"};

/// Advice on numbers with an x: `0x10` as in other languages, and `100x100` for the size of a
/// screen. Empty for other words.
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

/// Advice on a command of LaTeX. `command` is the name of the command without the backslash, and is
/// empty if the backslash has no command after it.
std::string advice_about_latex(std::string_view command) {
    for (const LatexCommand& each : latex_commands) {
        if (each.name == command) return std::string(each.advice);
    }
    return fmt::format("this is LaTeX; write {}", command);
}

}  // namespace

std::string advice_about_unit(std::string_view number, std::string_view unit) {
    if (std::ranges::find(counted_things, unit) != std::end(counted_things)) {
        return fmt::format("a number of {} has no unit: write '{}'", unit, number);
    }
    return unit_named(unit) ? "" : advice_about_unknown_unit(unit);
}

namespace {

/// The operator of derivatives with which a LaTeX text begins, together with its operand. The size
/// is 0 if the text begins with anything else.
LatexText latex_operator(std::string_view text) {
    constexpr std::string_view nabla = "nabla", delta = "Delta";
    const bool is_nabla = text.starts_with(nabla);
    if (!is_nabla && !text.starts_with(delta)) return {};
    std::size_t at = nabla.size();
    const auto skip_blanks = [&] { at = std::min(text.find_first_not_of(' ', at), text.size()); };
    const auto take = [&](std::string_view word) {
        const bool is_here = text.substr(at).starts_with(word);
        if (is_here) at += word.size();
        return is_here;
    };
    skip_blanks();
    std::string_view function = is_nabla ? "grad" : "lap";
    if (is_nabla && (take("^2") || take("^{2}"))) function = "lap";
    else if (is_nabla && take("\\cdot")) function = "div";
    skip_blanks();
    const std::string_view after = text.substr(at);
    std::size_t size = 0;
    if (after.starts_with('(')) {
        const std::size_t end = after.find_first_of(")\n");
        const bool is_plain =
            end != after.npos && after[end] == ')' && after.substr(1, end).find('(') == after.npos;
        size = is_plain ? end + 1 : 0;
    } else {
        while (size < after.size() &&
               (is_digit(after[size]) || after[size] == '_' ||
                std::isalpha(static_cast<unsigned char>(after[size])) != 0)) {
            ++size;
        }
        if (after.substr(size).starts_with('(')) size = 0;
    }
    if (size == 0) return {};
    const std::string_view operand =
        after.starts_with('(') ? after.substr(1, size - 2) : after.substr(0, size);
    return {at + size, fmt::format("this is LaTeX; write '{}({})'", function, operand)};
}

}  // namespace

LatexText latex_text(std::string_view text) {
    if (LatexText found = latex_operator(text); found.size > 0) return found;
    std::size_t size = 0;
    while (size < text.size() && std::isalpha(static_cast<unsigned char>(text[size])) != 0) ++size;
    return {size, advice_about_latex(text.substr(0, size))};
}

std::string advice_about_number(std::string_view number, std::string_view tail) {
    constexpr std::size_t longest = 64;
    if (std::string advice = advice_about_cross(fmt::format("{}{}", number, tail));
        !advice.empty()) {
        return advice;
    }
    if (unit_named(tail)) {
        return fmt::format("write '{} {}', with a blank before the unit", number, tail);
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
