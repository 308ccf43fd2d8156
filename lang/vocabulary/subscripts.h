// Derivatives that are written as subscripts of a name, as papers write them: u_xx is the second
// derivative of u along x. spec/grammar.md defines the notation.
#pragma once

#include "lang/vocabulary/functions.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// A name such as u_xxy in two parts.
struct SubscriptedName {
    std::string_view of;    ///< The name before the `_`: u.
    std::string_view axes;  ///< The letters after the `_`: xxy. Only x, y and z.
};

/// The highest order of a derivative that is written as a subscript.
inline constexpr std::size_t most_subscripts = 8;

/// The two parts of a name that ends in `_` and letters x, y, z. Empty for other names. Whether the
/// name means a derivative also depends on the names that the script declares.
std::optional<SubscriptedName> subscripted_name(std::string_view name);

/// How often x, y and z occur in `axes`, in this order.
std::array<std::size_t, 3> orders_along(std::string_view axes);

/// The functions that together give the derivative along these axes, if each function is applied to
/// the result of the previous one: dxx, dyy for xxyy; dxx, dx for xxx; dxx, dxy for xxxy. The order
/// of the letters in `axes` has no effect.
std::vector<Function> derivatives_along(std::string_view axes);

}  // namespace cascade
