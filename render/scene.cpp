// Triangles of copies are transformed when they are hit.
#include "render/scene.h"

#include "core/check.h"

#include <limits>

namespace cascade {

namespace {

const Instances no_copies;

}  // namespace

Scene::Scene(const TriangleMesh* body, const Instances* copies)
    : body_(body), copies_(copies ? copies : &no_copies) {
    const bool has_body = body && !body->triangles.empty();
    CHECK(has_body || copies_->triangle_count() > 0, "something is there to be drawn");
}

Scene::Facet Scene::facet(const Hit& hit) const {
    const bool is_body = hit.copy == Hit::body;
    const Placement* placement = is_body ? nullptr : &copies_->placements[hit.copy];
    const TriangleMesh& mesh = is_body ? *body_ : copies_->meshes[placement->mesh];
    const auto& corners = mesh.triangles[hit.triangle];
    Facet facet;
    for (std::size_t k = 0; k < 3; ++k) {
        facet.positions[k] = mesh.positions[corners[k]];
        facet.normals[k] = mesh.normals[corners[k]];
    }
    if (!mesh.shades.empty()) {
        facet.shade = 0;
        const std::array<float, 3> weights = hit.weights();
        for (std::size_t k = 0; k < 3; ++k) facet.shade += mesh.shades[corners[k]] * weights[k];
    }
    if (is_body) return facet;
    const PlacementMap map(*placement);
    for (std::size_t k = 0; k < 3; ++k) {
        facet.positions[k] = map.point(facet.positions[k]);
        facet.normals[k] = map.normal(facet.normals[k]);
    }
    return facet;
}

Box bounds(const Scene& scene) {
    constexpr float most = std::numeric_limits<float>::max();
    Box box{{most, most, most}, {-most, -most, -most}};
    scene.visit([&](const Vector3& p) { box.add(p); });
    return box;
}

}  // namespace cascade
