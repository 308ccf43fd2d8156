// Checks numbers with a unit: converts them to the units of the script.
#include "lang/check/expressions/expression_checker.h"
#include "lang/vocabulary/units.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade::checking {

namespace {

// The limits of converted numbers in single precision. The parser has the same limits
// (lang/syntax/expression_operands.cpp).
constexpr double too_large_converted = 0x1.ffffffp127;
constexpr double smallest_converted = 0x1p-126;

}  // namespace

void ExpressionChecker::take_unit(const ast::Call& call) {
    const NodeId operand = part_of(script_.arguments[call.first_argument]);
    const std::string_view text = text_of_unit_call(call.function.text);
    if (parts_[operand].has_error) {
        parts_.back().has_error = true;
        return;
    }
    // `2 /s` may mean a division by s if the system inherits a name s.
    const std::string_view first = factors_of_unit(text).front().name;
    const bool has_system = scope_.system != unknown_system && scope_.system < work_.names.next();
    if (text.starts_with("1/") && has_system &&
        find(work_.names[scope_.system], first) != nullptr) {
        return error(call.function.span,
                     fmt::format("'{}' is a unit, and also a name of {}", first,
                                 work_.program.systems[scope_.system].name),
                     fmt::format("write '/ {0}' to divide by the name, '{0}^-1' for the unit",
                                 first));
    }
    const double value = work_.units.convert(parts_[operand].value, unit_of(text));
    const double size = std::abs(value);
    if (!(size < too_large_converted) || (size != 0 && size < smallest_converted)) {
        return error(formula_.nodes.back().span,
                     fmt::format("this is {:.3g} {}, and such numbers are out of range", value,
                                 work_.units.name_of(unit_of(text).dimension)),
                     "the script computes in the units of its extent and its duration");
    }
    formula_.nodes.back().kind = value;
    parts_.back() = {false, true, value};
    has_loose_nodes_ = true;
}

}  // namespace cascade::checking
