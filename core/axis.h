// The axes of space, and the rotation that makes one of them point upwards.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cascade {

enum class Axis : std::uint8_t { x, y, z };

inline constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

/// The name "x", "y" or "z".
constexpr std::string_view name_of(Axis axis) { return axis_names[static_cast<std::size_t>(axis)]; }

/// The axis of that name; nothing if there is none.
constexpr std::optional<Axis> axis_of_name(std::string_view name) {
    for (std::size_t k = 0; k < axis_names.size(); ++k) {
        if (axis_names[k] == name) return static_cast<Axis>(k);
    }
    return std::nullopt;
}

/// Rotates `v` so that the axis `up` becomes y. The rotation only permutes coordinates and changes
/// signs, so no bit is lost. With z up, the direction −y becomes z: the convention of programs that
/// model with z up and export glTF, which has y up.
template <typename Number>
constexpr BasicVector3<Number> turned_upright(BasicVector3<Number> v, Axis up) {
    switch (up) {
        case Axis::x: return {v.z, v.x, v.y};
        case Axis::y: break;
        case Axis::z: return {v.x, v.z, -v.y};
    }
    return v;
}

/// The inverse of turned_upright.
template <typename Number>
constexpr BasicVector3<Number> turned_from_upright(BasicVector3<Number> v, Axis up) {
    switch (up) {
        case Axis::x: return {v.y, v.z, v.x};
        case Axis::y: break;
        case Axis::z: return {v.x, -v.z, v.y};
    }
    return v;
}

}  // namespace cascade
