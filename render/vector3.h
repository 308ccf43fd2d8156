// Points and directions in space.
#pragma once

#include <cmath>

namespace cascade {

struct Vector3 {
    float x = 0, y = 0, z = 0;
    friend bool operator==(const Vector3&, const Vector3&) = default;
};

inline Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
inline Vector3 operator*(Vector3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }

inline float dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector3 cross(Vector3 a, Vector3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vector3 a) { return std::sqrt(dot(a, a)); }

/// Of length 1; the zero vector stays zero.
inline Vector3 unit(Vector3 a) {
    const float size = length(a);
    return size > 0 ? a * (1 / size) : a;
}

/// Two directions that make a right-handed frame with `normal` (of length 1): T. Duff et al.,
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
