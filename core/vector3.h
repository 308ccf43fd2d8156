// Points and directions in space.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>

namespace cascade {

/// `Number` is float, double, or a type with the same operators and with `sqrt` and `inverse`, such
/// as the terms of lang/program/terms.h.
template <typename Number>
struct BasicVector3 {
    Number x{}, y{}, z{};

    Number& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    const Number& operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

    friend bool operator==(const BasicVector3&, const BasicVector3&) = default;

    friend BasicVector3 operator+(BasicVector3 a, BasicVector3 b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend BasicVector3 operator-(BasicVector3 a, BasicVector3 b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend BasicVector3 operator-(BasicVector3 a) { return {-a.x, -a.y, -a.z}; }
    friend BasicVector3 operator*(BasicVector3 a, Number s) { return {a.x * s, a.y * s, a.z * s}; }

    friend Number dot(BasicVector3 a, BasicVector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend BasicVector3 cross(BasicVector3 a, BasicVector3 b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    friend Number length(BasicVector3 a) {
        using std::sqrt;
        return sqrt(dot(a, a));
    }

    /// `a` scaled to length 1. The zero vector stays zero.
    friend BasicVector3 unit(BasicVector3 a) {
        const Number size = length(a);
        if constexpr (std::floating_point<Number>) return size > 0 ? a * (1 / size) : a;
        else return a * inverse(size);
    }
};

template <typename Number>
bool is_finite(BasicVector3<Number> v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The point of segment ab nearest to p, as a fraction 0 … 1 of the way from a; 0 if a equals b.
template <typename Vector>
double nearest_fraction(const Vector& a, const Vector& b, const Vector& p) {
    const Vector along = b - a;
    const double square = dot(along, along);
    return square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
}

using Vector3 = BasicVector3<float>;    ///< For pictures.
using Vector3d = BasicVector3<double>;  ///< For measured geometry.

/// Two directions that form a right-handed frame with `normal` (of length 1): T. Duff et al.,
/// "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
struct Frame {
    Vector3 tangent, bitangent;
};
inline Frame frame_of(Vector3 normal) {
    const float sign = std::copysign(1.0F, normal.z);
    const float a = -1 / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    return {{1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
            {b, sign + normal.y * normal.y * a, -normal.y}};
}

}  // namespace cascade
