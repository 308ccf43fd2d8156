// The two number formats of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

namespace cascade {

/// The format of all numbers of a run: IEEE 754 binary32 or binary64.
enum class Precision : std::uint8_t { single, binary64 };

/// The word for a precision in scripts and options.
constexpr std::string_view name_of(Precision precision) {
    return precision == Precision::single ? "single" : "double";
}

constexpr std::optional<Precision> precision_of_name(std::string_view name) {
    if (name == "single") return Precision::single;
    if (name == "double") return Precision::binary64;
    return std::nullopt;
}

constexpr std::size_t bytes_of(Precision precision) {
    return precision == Precision::single ? 4 : 8;
}

/// The precision of `float` and of `double`.
template <typename Number>
inline constexpr Precision precision_of =
    std::is_same_v<Number, double> ? Precision::binary64 : Precision::single;

/// Calls `visit` with a zero of the precision's type, so that the type is selected once, before the
/// loops.
template <typename Visit>
constexpr decltype(auto) with_number(Precision precision, Visit&& visit) {
    return precision == Precision::single ? visit(float{}) : visit(double{});
}

}  // namespace cascade
