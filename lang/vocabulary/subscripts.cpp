// Derivatives in subscripts, such as u_xxy. Derivatives commute, so only the number of derivatives
// along each axis counts. Pairs of derivatives along the same axis are taken first, as second
// derivatives, because these have the smallest stencils. After that, at most one derivative along
// each axis is left.
#include "lang/vocabulary/subscripts.h"

#include <algorithm>
#include <string>

namespace cascade {

namespace {

constexpr std::string_view axis_letters = "xyz";

Function derivative(const std::string& axes) { return *function_named("d" + axes); }

}  // namespace

std::optional<SubscriptedName> subscripted_name(std::string_view name) {
    const std::size_t bar = name.rfind('_');
    if (bar == name.npos || bar == 0 || bar + 1 == name.size()) return std::nullopt;
    const std::string_view axes = name.substr(bar + 1);
    if (axes.find_first_not_of(axis_letters) != axes.npos) return std::nullopt;
    return SubscriptedName{name.substr(0, bar), axes};
}

std::array<std::size_t, 3> orders_along(std::string_view axes) {
    std::array<std::size_t, 3> orders{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        orders[axis] = static_cast<std::size_t>(std::ranges::count(axes, axis_letters[axis]));
    }
    return orders;
}

std::vector<Function> derivatives_along(std::string_view axes) {
    const auto orders = orders_along(axes);
    std::vector<Function> functions;
    std::string left;  // The axes along which one derivative is left.
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const char letter = axis_letters[axis];
        functions.insert(functions.end(), orders[axis] / 2, derivative({letter, letter}));
        if (orders[axis] % 2 == 1) left += letter;
    }
    if (left.size() > 1) functions.push_back(derivative(left.substr(0, 2)));
    if (left.size() % 2 == 1) functions.push_back(derivative(left.substr(left.size() - 1)));
    return functions;
}

}  // namespace cascade
