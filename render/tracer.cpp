// Shades surfaces from both sides, and a ground plane that only receives shadows.
#include "render/tracer.h"

#include "picture/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade {

namespace {

constexpr float usual_sun = 0.72F;     ///< The sunlight to which the strengths of gloss refer.
constexpr float ground_shade = 0.55F;  ///< The fraction of light that the ground's shadow removes.

/// The offset from a point on a facet to the smooth surface that the normals at the vertices
/// describe: J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, chapter 4.
Vector3 rounding(const Scene::Facet& facet, const std::array<float, 3>& weights, float side) {
    Vector3 place, offset;
    for (std::size_t k = 0; k < 3; ++k) place = place + facet.positions[k] * weights[k];
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3 normal = facet.normals[k] * side;
        const float below = std::min(0.0F, dot(place - facet.positions[k], normal));
        offset = offset - normal * (weights[k] * below);
    }
    return offset;
}

}  // namespace

Tracer::Tracer(const RayCaster& caster, const SurfaceLook& look, const DrawOptions& options)
    : caster_(caster),
      look_(look),
      options_(options),
      camera_(caster.scene(), options.view, options.width, options.height),
      background_(light_of(options.background.value_or(pure_white))),
      box_(bounds(caster.scene())),
      size_(length(box_.high - box_.low)),
      lights_(options.lighting, camera_, options.view.up),
      sun_frame_(frame_of(lights_.sun)) {
    ground_ = dot(box_.low, options.view.up);
}

Seen Tracer::trace(float x, float y, float width) const {
    const Ray ray = camera_.ray(x, y);
    float beyond = 0;
    while (const auto hit = caster_.nearest(ray, beyond)) {
        const float opacity = opacity_of(*hit);
        beyond = past(*hit);
        if (opacity == 0) continue;
        Seen seen = surface(ray, *hit, width);
        seen.is_translucent = opacity < 1;
        return seen;
    }
    return behind(ray);
}

float Tracer::opacity_of(const Hit& hit) const {
    return options_.opacity && hit.copy == Hit::body ? options_.opacity(hit) : 1;
}

Seen Tracer::behind(const Ray& ray) const {
    if (options_.ground) return ground(ray);
    Seen nothing;
    nothing.always = background_;
    return nothing;
}

Look Tracer::look_at(const Ray& ray, const Hit& hit, float width) const {
    if (hit.copy == Hit::body) {
        return look_({hit, ray.direction, width * camera_.pixel() * hit.distance});
    }
    Look look;
    look.light = light_of(caster_.scene().copies().placements[hit.copy].colour);
    return look;
}

Seen Tracer::surface(const Ray& ray, const Hit& hit, float width) const {
    const Scene::Facet corners = caster_.scene().facet(hit);
    const std::array<float, 3> weights = hit.weights();
    const auto& normals = corners.normals;
    Vector3 normal =
        unit(normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2]);
    Vector3 facet = corners.normal();
    Look look = look_at(ray, hit, width);
    for (float& channel : look.light) channel *= corners.shade;
    // Both sides are drawn, so the normal is turned towards the viewer.
    if (dot(facet, ray.direction) > 0) facet = -facet;
    const float side = dot(normal, facet) < 0 ? -1.0F : 1.0F;
    if (look.tilt != Vector3{}) normal = unit(normal + look.tilt);
    if (side < 0) normal = -normal;
    Vector3 place = ray.origin + ray.direction * hit.distance + facet * (size_ * 1e-4F);
    if (options_.round_shadows) place = place + rounding(corners, weights, side);
    const Vector3& sun = lights_.sun;
    const Vector3 half = unit(sun - ray.direction);
    const Gloss& gloss = look.gloss;
    const float gleam = gloss.strength * steady_power(std::max(0.0F, dot(normal, half)),
                                                      static_cast<double>(gloss.power));
    const float facing = dot(normal, ray.direction);
    const Colour soft = lights_.soft(normal);
    const Vector3 onwards = ray.direction - normal * (2 * facing);
    const Colour mirrored = lights_.mirrored(onwards, gloss);
    // If the normal is tilted, the mirrored direction may point below the surface. The surface then
    // hides the light from there.
    const float above = std::clamp(1 + dot(onwards, facet), 0.0F, 1.0F);
    const float reflected = reflectance(-facing, gloss);
    const float metal = gloss.metalness, dull = 1 - metal;
    const float lit = std::max(0.0F, dot(normal, sun));
    Seen seen;
    for (std::size_t k = 0; k < 3; ++k) {
        const float tint = 1 + metal * (look.light[k] - 1);
        seen.of_sun[k] = look.light[k] * (lights_.sunlight[k] * lit) * dull +
                         gleam * tint * (lights_.sunlight[k] / usual_sun);
        seen.always[k] = look.glow[k];
        seen.of_sky[k] = look.light[k] * (lights_.even[k] + soft[k] * dull) +
                         mirrored[k] * above * above * (reflected * dull + look.light[k] * metal);
    }
    seen.kind = Seen::Kind::surface;
    seen.is_copy = hit.copy != Hit::body;
    seen.place = place;
    seen.normal = normal;
    return seen;
}

/// The background, darkened by the shadow of the scene. The shadow is grey even in coloured light.
Seen Tracer::ground(const Ray& ray) const {
    Seen seen;
    seen.always = background_;
    const Vector3 up = options_.view.up;
    const float fall = dot(ray.direction, up);
    if (fall > -1e-3F) return seen;
    const float distance = (ground_ - dot(ray.origin, up)) / fall;
    if (distance <= 0) return seen;
    const Vector3 place = ray.origin + ray.direction * distance;
    // Far from the scene there is no shadow to test.
    if (length(place - box_.centre()) > 1.5F * size_) return seen;
    constexpr std::size_t green = 1;
    const float sun = lights_.sunlight[green] * std::max(0.0F, dot(up, lights_.sun));
    const float sky = lights_.even[green] + lights_.soft(up)[green];
    const float full = sun + sky;
    for (std::size_t k = 0; k < 3; ++k) {
        seen.always[k] = background_[k] * (1 - ground_shade);
        seen.of_sun[k] = background_[k] * ground_shade * (sun / full);
        seen.of_sky[k] = background_[k] * ground_shade * (sky / full);
    }
    seen.kind = Seen::Kind::ground;
    seen.place = place + up * (size_ * 1e-4F);
    seen.normal = up;
    return seen;
}

bool Tracer::sees_sun(const Seen& from, DiscPoint disc) const {
    const Vector3 to_sun = unit(lights_.sun + sun_frame_.tangent * (lights_.sun_radius * disc.x) +
                                sun_frame_.bitangent * (lights_.sun_radius * disc.y));
    return dot(from.normal, to_sun) > 0 && !is_blocked({from.place, to_sun}, INFINITY, disc.part);
}

bool Tracer::sees_sky(const Seen& from, DiscPoint disc) const {
    const Frame frame = frame_of(from.normal);
    const float height = std::sqrt(std::max(0.0F, 1 - disc.x * disc.x - disc.y * disc.y));
    const Vector3 to_sky = frame.tangent * disc.x + frame.bitangent * disc.y + from.normal * height;
    return !is_blocked({from.place, to_sky}, size_, disc.part);
}

/// A translucent surface blocks a fraction of the tests that equals the fraction of light that it
/// absorbs.
bool Tracer::is_blocked(const Ray& ray, float reach, float part) const {
    if (!options_.opacity) return caster_.is_blocked(ray, reach);
    float passing = 1, beyond = 0;
    while (const auto hit = caster_.nearest(ray, beyond)) {
        if (hit->distance >= reach) return false;
        passing *= 1 - opacity_of(*hit);
        if (passing <= part) return true;
        beyond = past(*hit);
    }
    return false;
}

}  // namespace cascade
