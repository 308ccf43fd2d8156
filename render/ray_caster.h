// Intersections of rays with a mesh. The only interface to Embree.
#pragma once

#include "render/camera.h"
#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace cascade {

/// A hit of a ray in triangle (a, b, c), at the point (1 − u − v) a + u b + v c.
struct Hit {
    std::uint32_t triangle = 0;
    float u = 0, v = 0;
    float distance = 0;
};

/// Thread-safe. The mesh must outlive it.
class RayCaster {
public:
    /// Uses the same instructions on every processor, for equal pictures. Throws std::bad_alloc.
    explicit RayCaster(const TriangleMesh& mesh);
    /// False in a browser's tab, which has no Embree; then there are no others.
    static bool is_available();
    ~RayCaster();

    std::optional<Hit> nearest(const Ray& ray) const;
    /// Whether anything blocks the ray at a distance below `reach`.
    bool is_blocked(const Ray& ray, float reach) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

}  // namespace cascade
