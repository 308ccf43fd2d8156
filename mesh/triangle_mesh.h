// Triangles with smooth normals in binary32, for drawing and copying.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// Rounds a point or a direction to binary32.
inline Vector3 single(const Vector3d& a) {
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

struct TriangleMesh {
    std::vector<Vector3> positions;
    std::vector<Vector3> normals;  ///< One per position, of length 1.
    /// Counterclockwise when seen from outside.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// The fraction of the colour's light, 0 … 1, that each position of the surface reflects. If
    /// empty, all light is reflected everywhere.
    std::vector<float> shades;
};

/// Sets each position's normal to the direction of the area-weighted sum of its triangles' normals.
void smooth_normals(TriangleMesh& mesh);

/// Appends a mesh to another. Positions without a shade have the shade 1.
void append(const TriangleMesh& added, TriangleMesh& mesh);

/// The bounding box of a mesh.
struct Box {
    Vector3 low, high;
    Vector3 centre() const { return (low + high) * 0.5F; }
    void add(Vector3 p);
};
Box bounds(const TriangleMesh& mesh);

}  // namespace cascade
