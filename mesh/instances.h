// Copies of small meshes in space: the scales, thorns or hairs of a body.
#pragma once

#include "core/palette.h"
#include "core/quaternion.h"
#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The position and appearance of a copy. Point p of the mesh moves to place + turn(scale · p).
struct Placement {
    std::uint32_t mesh = 0;  ///< The index of the mesh.
    Vector3d place;
    Quaternion turn;          ///< Of length 1.
    Vector3d scale{1, 1, 1};  ///< Factors along the mesh's own axes, each larger than 0.
    Colour colour{1, 1, 1};   ///< sRGB, 0 … 1.
};

/// Copies of small meshes. The body below the copies is not included: it is drawn and written
/// separately.
struct Instances {
    std::vector<TriangleMesh> meshes;  ///< The variants. Each has triangles.
    std::vector<Placement> placements;

    /// The triangles of all copies together.
    std::uint64_t triangle_count() const;
};

/// Moves and scales all copies by the map p ↦ (p − middle) × scale, such as the map of a DrawnMesh.
void move_instances(Instances& instances, Vector3d middle, double scale);

/// Applies a placement to the points and normals of its mesh, in binary32.
class PlacementMap {
public:
    explicit PlacementMap(const Placement& placement);

    Vector3 point(Vector3 p) const { return x_ * p.x + y_ * p.y + z_ * p.z + place_; }
    /// The image of a normal, scaled to length 1. Normals are multiplied by the reciprocals of the
    /// scale factors.
    Vector3 normal(Vector3 n) const {
        return unit(x_ * (n.x * factors_.x) + y_ * (n.y * factors_.y) + z_ * (n.z * factors_.z));
    }

    /// The images of the axes' unit vectors and of the origin.
    Vector3 x() const { return x_; }
    Vector3 y() const { return y_; }
    Vector3 z() const { return z_; }
    Vector3 place() const { return place_; }

private:
    Vector3 x_, y_, z_, place_;
    /// The inverse squares of the scale. `x_`, `y_` and `z_` already contain the scale once.
    Vector3 factors_;
};

}  // namespace cascade
