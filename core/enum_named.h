// Values of enums by the names in a table.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace cascade {

/// The value of an enum that `names` lists in its order.
template <typename Enum>
constexpr std::optional<Enum> enum_named(std::span<const std::string_view> names,
                                         std::string_view name) {
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (names[k] == name) return static_cast<Enum>(k);
    }
    return std::nullopt;
}

}  // namespace cascade
