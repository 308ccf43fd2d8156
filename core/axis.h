// The axes of space, and the turn that brings one of them upright.
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

/// "x", "y" or "z".
constexpr std::string_view name_of(Axis axis) { return axis_names[static_cast<std::size_t>(axis)]; }

/// The axis of that name; nothing for other words.
constexpr std::optional<Axis> axis_of_name(std::string_view name) {
    for (std::size_t k = 0; k < axis_names.size(); ++k) {
        if (axis_names[k] == name) return static_cast<Axis>(k);
    }
    return std::nullopt;
}

/// `v` turned with the space around it, so that the axis `up` becomes y. Coordinates change places
/// and signs and nothing else: no bit is lost. What looks along −y while z is upwards looks along z
/// then, as programs that model with z upwards and glTF, which has y upwards, agree.
template <typename Number>
constexpr BasicVector3<Number> turned_upright(BasicVector3<Number> v, Axis up) {
    switch (up) {
        case Axis::x: return {v.z, v.x, v.y};
        case Axis::y: break;
        case Axis::z: return {v.x, v.z, -v.y};
    }
    return v;
}

/// The way back: turned_from_upright(turned_upright(v, up), up) is v.
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
