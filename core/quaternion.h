// Rotations of space as quaternions of length 1.
#pragma once

#include "core/vector3.h"

#include <algorithm>
#include <cmath>

namespace cascade {

/// w + x i + y j + z k. q and −q are the same rotation.
struct Quaternion {
    double w = 1, x = 0, y = 0, z = 0;
    friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// The rotation that first rotates by b and then by a.
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// Normalises `q`. Returns the identity if `q` is 0 or not finite.
inline Quaternion of_length_1(const Quaternion& q) {
    const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(size > 0) || !std::isfinite(size)) return {};
    return {q.w / size, q.x / size, q.y / size, q.z / size};
}

/// The vector rotated by a quaternion of length 1.
inline Vector3d turned(const Quaternion& q, Vector3d v) {
    const Vector3d axis{q.x, q.y, q.z};
    const Vector3d twice = cross(axis, v) * 2;
    return v + twice * q.w + cross(axis, twice);
}

/// The rotation that takes the axes x, y and z to three directions, which are orthonormal and
/// right-handed: S. W. Shepperd, "Quaternion from Rotation Matrix", Journal of Guidance and Control
/// 1(3), 1978. The largest component of the result is positive, which distinguishes q from −q.
inline Quaternion quaternion_of(Vector3d x, Vector3d y, Vector3d z) {
    const double trace = x.x + y.y + z.z;
    const double most = std::max({trace, x.x, y.y, z.z});
    Quaternion q;
    if (most == trace) q = {1 + trace, y.z - z.y, z.x - x.z, x.y - y.x};
    else if (most == x.x) q = {y.z - z.y, 1 + x.x - y.y - z.z, x.y + y.x, z.x + x.z};
    else if (most == y.y) q = {z.x - x.z, x.y + y.x, 1 + y.y - x.x - z.z, y.z + z.y};
    else q = {x.y - y.x, z.x + x.z, y.z + z.y, 1 + z.z - x.x - y.y};
    return of_length_1(q);
}

}  // namespace cascade
