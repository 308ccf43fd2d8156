// The axes of space, and the rotation that turns a model upright and makes it face along z.
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

/// The axis called `name`; nullopt for other names.
constexpr std::optional<Axis> axis_of_name(std::string_view name) {
    for (std::size_t k = 0; k < axis_names.size(); ++k) {
        if (axis_names[k] == name) return static_cast<Axis>(k);
    }
    return std::nullopt;
}

/// One of the six directions along the axes.
struct Heading {
    Axis axis = Axis::z;
    bool is_backwards = false;  ///< Towards smaller coordinates.
    bool operator==(const Heading&) const = default;
};

inline constexpr std::array<std::string_view, 6> heading_names{"x", "y", "z", "-x", "-y", "-z"};

/// The name: "x", "y", "z", "-x", "-y" or "-z".
constexpr std::string_view name_of(Heading heading) {
    return heading_names[static_cast<std::size_t>(heading.axis) + (heading.is_backwards ? 3 : 0)];
}

/// The direction called `name`; nullopt for other names.
constexpr std::optional<Heading> heading_of_name(std::string_view name) {
    for (std::size_t k = 0; k < heading_names.size(); ++k) {
        if (heading_names[k] == name) return Heading{static_cast<Axis>(k % 3), k >= 3};
    }
    return std::nullopt;
}

/// A model's orientation: its up direction, and the direction it faces, at a right angle to it.
struct Stance {
    Axis up = Axis::y;
    Heading facing;
    bool operator==(const Stance&) const = default;
};

/// The usual orientation of a model with this up direction. With y up, the model faces z. With z
/// up, it faces −y, as in programs that model with z up and export glTF, which has y up. With x up,
/// it faces y.
constexpr Stance usual_stance(Axis up) {
    return {up, up == Axis::y ? Heading{Axis::z} : Heading{Axis::y, up == Axis::z}};
}

namespace axis_detail {

/// The direction that turned_upright() takes to x: the cross product of the up and the facing
/// direction.
constexpr Heading side_of(const Stance& stance) {
    const auto up = static_cast<unsigned>(stance.up);
    const auto facing = static_cast<unsigned>(stance.facing.axis);
    const bool is_next = (up + 1) % 3 == facing;
    return {static_cast<Axis>(3 - up - facing), stance.facing.is_backwards == is_next};
}

template <typename Number>
constexpr Number along(const BasicVector3<Number>& v, Heading heading) {
    const Number part = heading.axis == Axis::x ? v.x : heading.axis == Axis::y ? v.y : v.z;
    return heading.is_backwards ? -part : part;
}

}  // namespace axis_detail

/// Rotates `v` so that the up direction becomes y and the facing direction z. The rotation only
/// permutes coordinates and changes signs, so no bit is lost.
template <typename Number>
constexpr BasicVector3<Number> turned_upright(const BasicVector3<Number>& v, const Stance& stance) {
    return {axis_detail::along(v, axis_detail::side_of(stance)), axis_detail::along(v, {stance.up}),
            axis_detail::along(v, stance.facing)};
}

/// The inverse of turned_upright.
template <typename Number>
constexpr BasicVector3<Number> turned_from_upright(const BasicVector3<Number>& v,
                                                   const Stance& stance) {
    const Heading side = axis_detail::side_of(stance);
    const auto part = [&](Axis axis) {
        if (axis == stance.up) return v.y;
        if (axis == side.axis) return side.is_backwards ? -v.x : v.x;
        return stance.facing.is_backwards ? -v.z : v.z;
    };
    return {part(Axis::x), part(Axis::y), part(Axis::z)};
}

}  // namespace cascade
