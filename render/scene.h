// The contents of a picture: a body, copies of small meshes, or both.
#pragma once

#include "mesh/instances.h"

#include <array>
#include <cstdint>

namespace cascade {

/// A hit of a ray in triangle (a, b, c), at the point (1 − u − v) a + u b + v c.
struct Hit {
    static constexpr std::uint32_t body = 0xffffffff;

    std::uint32_t triangle = 0;  ///< The triangle's index in the body or in the copy's mesh.
    float u = 0, v = 0;
    float distance = 0;
    std::uint32_t copy =
        body;  ///< The index of the copy's placement, or `body` if the ray hit the body.

    std::array<float, 3> weights() const { return {1 - u - v, u, v}; }
};

/// A body, copies of meshes, or both, with at least one triangle. All meshes must outlive the
/// scene.
class Scene {
public:
    /// A scene with a body alone.
    Scene(const TriangleMesh& body) : Scene(&body, nullptr) {}  // NOLINT: the simple case.
    /// Either the body or the copies may be null.
    Scene(const TriangleMesh* body, const Instances* copies);

    const TriangleMesh* body() const { return body_; }
    const Instances& copies() const { return *copies_; }

    /// A triangle with its vertices in space.
    struct Facet {
        std::array<Vector3, 3> positions, normals;
        float shade = 1;  ///< The shade at the hit.

        Vector3 normal() const {
            return unit(cross(positions[1] - positions[0], positions[2] - positions[0]));
        }
    };
    /// The triangle that was hit.
    Facet facet(const Hit& hit) const;

    /// Calls `use` with every position of a vertex in the scene.
    template <typename Use>
    void visit(const Use& use) const {
        if (body_) {
            for (const Vector3& p : body_->positions) use(p);
        }
        for (const Placement& placement : copies_->placements) {
            const PlacementMap map(placement);
            for (const Vector3& p : copies_->meshes[placement.mesh].positions) use(map.point(p));
        }
    }

private:
    const TriangleMesh* body_;
    const Instances* copies_;
};

/// The bounding box of the whole scene.
Box bounds(const Scene& scene);

}  // namespace cascade
