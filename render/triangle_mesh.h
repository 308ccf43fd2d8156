// The mesh that is drawn: triangles with smooth normals.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

struct TriangleMesh {
    std::vector<Vector3> positions;
    std::vector<Vector3> normals;  ///< One per position, of length 1.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Sets each position's normal to the direction of the area-weighted sum of its triangles' normals.
void smooth_normals(TriangleMesh& mesh);

/// The bounding box of a mesh.
struct Box {
    Vector3 low, high;
    Vector3 centre() const { return (low + high) * 0.5F; }
};
Box bounds(const TriangleMesh& mesh);

}  // namespace cascade
