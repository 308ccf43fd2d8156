// Tables of commands and units.
#include "lang/vocabulary/signs_elsewhere.h"

#include "core/decimal.h"

#include <fmt/format.h>

namespace cascade {

namespace {

struct LatexCommand {
    std::string_view name, advice;
};
constexpr LatexCommand latex_commands[] = {
    {"", "a line goes on inside ( ) and after an operator"},
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
    double size;  ///< In metres or seconds.
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

}  // namespace cascade
