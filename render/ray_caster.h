// Which triangle does a ray meet first? The one file behind which Embree is.
#pragma once

#include "render/camera.h"
#include "render/triangle_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace cascade {

/// Where a ray met the mesh: in triangle (a, b, c) the point (1 − u − v) a + u b + v c.
struct Hit {
    std::uint32_t triangle = 0;
    float u = 0, v = 0;
    float distance = 0;
};

/// Safe to use from several threads at once. The mesh must outlive it.
class RayCaster {
public:
    /// Rays are cast with the same instructions on every processor, so that a picture is the same
    /// everywhere. Throws std::bad_alloc.
    explicit RayCaster(const TriangleMesh& mesh);
    ~RayCaster();

    std::optional<Hit> nearest(const Ray& ray) const;
    /// Is anything in the way, nearer than `reach`?
    bool is_blocked(const Ray& ray, float reach) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

}  // namespace cascade
