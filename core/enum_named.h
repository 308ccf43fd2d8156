// Finds the value of an enum by its name in a table.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace cascade {

/// The value called `name`. `names` lists the names of all values in the order of the enum.
template <typename Enum>
constexpr std::optional<Enum> enum_named(std::span<const std::string_view> names,
                                         std::string_view name) {
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (names[k] == name) return static_cast<Enum>(k);
    }
    return std::nullopt;
}

}  // namespace cascade
