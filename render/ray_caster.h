// Intersections of rays with a scene. Other files use Embree only through this interface.
#pragma once

#include "render/camera.h"
#include "render/scene.h"

#include <memory>
#include <optional>

namespace cascade {

/// Finds hits of rays. Thread-safe. The contents of the scene must outlive the caster.
class RayCaster {
public:
    /// Uses the same instructions on every processor, so that pictures are equal. Throws
    /// std::bad_alloc.
    explicit RayCaster(const Scene& scene);
    /// False in a browser's tab, which has no Embree, so that no RayCaster can be constructed.
    static bool is_available();
    ~RayCaster();

    const Scene& scene() const { return scene_; }

    /// The nearest hit that is farther away than `beyond`.
    std::optional<Hit> nearest(const Ray& ray, float beyond = 0) const;
    /// Whether anything blocks the ray at a distance below `reach`.
    bool is_blocked(const Ray& ray, float reach) const;

private:
    struct Tree;
    bool misses_all(const Ray& ray, float reach) const;

    Scene scene_;
    std::unique_ptr<Tree> tree_;
    Box around_;  ///< Slightly larger than the scene.
};

}  // namespace cascade
