// Finds the hit of a ray from the camera, and the light that reaches this hit.
//
// The sun is a disc instead of a point, for soft shadows. The sky is all other light. Hollows are
// darker because less of the sky is visible from them.
#pragma once

#include "render/camera.h"
#include "render/draw.h"
#include "render/lighting.h"
#include "render/ray_caster.h"

namespace cascade {

/// A point of the unit disc.
struct DiscPoint {
    float x = 0, y = 0;
    /// A number from 0 to below 1. A test passes through a surface if this number is below the
    /// fraction of light that the surface lets through.
    float part = 0;
};

/// The surface that a ray hits first, and its light. This light is `always`, plus `sun` and `sky`
/// as far as they are visible from the hit.
struct Seen {
    enum class Kind : std::uint8_t { background, ground, surface };
    /// The sun and the sky contribute to all kinds but `background`.
    Kind kind = Kind::background;
    bool is_copy = false;         ///< Whether the hit is on a copy.
    bool is_translucent = false;  ///< Whether the ray continues through the surface.
    Colour always{0, 0, 0};
    Colour of_sun{0, 0, 0}, of_sky{0, 0, 0};
    Vector3 place, normal;
};

/// Traces rays of a picture. The arguments must outlive the tracer. Several threads may use it at
/// once.
class Tracer {
public:
    Tracer(const RayCaster& caster, const SurfaceLook& look, const DrawOptions& options);

    /// Traces a ray through a point of the picture, in pixels from its upper left corner, to the
    /// first surface that is not fully transparent. The ray samples a square of `width` pixels.
    Seen trace(float x, float y, float width) const;

    /// Visits all hits of the ray of trace(), from front to back. Calls use(seen, weight) with
    /// weights that sum to 1.
    template <typename Use>
    void trace_through(float x, float y, float width, const Use& use) const {
        const Ray ray = camera_.ray(x, y);
        float rest = 1, beyond = 0;
        while (const auto hit = caster_.nearest(ray, beyond)) {
            float opacity = opacity_of(*hit);
            beyond = past(*hit);
            if (opacity == 0) continue;
            if (rest * (1 - opacity) < least_rest) opacity = 1;
            use(surface(ray, *hit, width), rest * opacity);
            if (opacity == 1) return;
            rest *= 1 - opacity;
        }
        use(behind(ray), rest);
    }

    /// Whether a point of the sun's disc is visible.
    bool sees_sun(const Seen& from, DiscPoint disc) const;

    /// Whether the sky is visible from a hit in a direction. The direction is given by its
    /// projection to a point of the unit disc, so that uniform points of the disc give
    /// cosine-weighted directions.
    bool sees_sky(const Seen& from, DiscPoint disc) const;

    /// The width of a pixel at a point in space.
    float pixel_at(const Vector3& place) const {
        return camera_.pixel() * length(place - camera_.eye());
    }

private:
    /// A ray is continued behind a surface only if the rest of the ray would contribute at least
    /// this fraction to the ray's light.
    static constexpr float least_rest = 1.0F / 512;

    Seen surface(const Ray& ray, const Hit& hit, float width) const;
    Seen behind(const Ray& ray) const;
    Seen ground(const Ray& ray) const;
    float opacity_of(const Hit& hit) const;
    /// A distance slightly beyond a hit, so that the next search does not find it again.
    static float past(const Hit& hit) { return hit.distance * (1 + 1e-6F) + 1e-7F; }
    bool is_blocked(const Ray& ray, float reach, float part) const;
    Look look_at(const Ray& ray, const Hit& hit, float width) const;

    const RayCaster& caster_;
    const SurfaceLook& look_;
    const DrawOptions& options_;
    Camera camera_;
    Colour background_;  ///< The background's light.
    Box box_;
    float size_;
    float ground_ = 0;
    Lights lights_;
    Frame sun_frame_;
};

}  // namespace cascade
