// A plane's normal rotates with the plane, and is scaled by the inverse of the plane's scale.
#include "mesh/instances.h"

#include "core/check.h"

namespace cascade {

std::uint64_t Instances::triangle_count() const {
    std::uint64_t count = 0;
    for (const Placement& placement : placements) count += meshes[placement.mesh].triangles.size();
    return count;
}

void move_instances(Instances& instances, Vector3d middle, double scale) {
    for (Placement& placement : instances.placements) {
        placement.place = (placement.place - middle) * scale;
        placement.scale = placement.scale * scale;
    }
}

PlacementMap::PlacementMap(const Placement& placement) {
    const Vector3d& scale = placement.scale;
    CHECK(scale.x > 0 && scale.y > 0 && scale.z > 0, "a copy has a size");
    x_ = single(turned(placement.turn, {scale.x, 0, 0}));
    y_ = single(turned(placement.turn, {0, scale.y, 0}));
    z_ = single(turned(placement.turn, {0, 0, scale.z}));
    place_ = single(placement.place);
    // The common factor keeps normals near length 1.
    const double size = length(scale) * length(scale);
    factors_ = single(
        {size / (scale.x * scale.x), size / (scale.y * scale.y), size / (scale.z * scale.z)});
}

}  // namespace cascade
