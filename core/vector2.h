// Points and directions in a plane, also used as complex numbers.
#pragma once

#include <cmath>

namespace cascade {

struct Vector2d {
    double x = 0, y = 0;
    friend Vector2d operator+(Vector2d a, Vector2d b) { return {a.x + b.x, a.y + b.y}; }
    friend Vector2d operator-(Vector2d a, Vector2d b) { return {a.x - b.x, a.y - b.y}; }
    friend Vector2d operator*(Vector2d a, double s) { return {a.x * s, a.y * s}; }
    friend double dot(Vector2d a, Vector2d b) { return a.x * b.x + a.y * b.y; }
    /// Positive if b is to the left of a.
    friend double cross(Vector2d a, Vector2d b) { return a.x * b.y - a.y * b.x; }
    friend double length(Vector2d a) { return std::sqrt(dot(a, a)); }
};

/// The product of two complex numbers.
inline Vector2d product(Vector2d a, Vector2d b) {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

/// `v` scaled to length 1. The zero vector stays zero.
inline Vector2d unit_of(Vector2d v) {
    const double size = std::hypot(v.x, v.y);
    return size > 0 ? Vector2d{v.x / size, v.y / size} : Vector2d{};
}

}  // namespace cascade
