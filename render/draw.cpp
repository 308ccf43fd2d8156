// Lighting: a sun behind the viewer's left shoulder, a disc instead of a point for soft shadows,
// and a uniform sky, which darkens hollows. Each of a pixel's rays tests the sun and the sky once.
// Where results differ within the pixel it tests more often, because few samples there give noise.
// Sample positions are points of a low-discrepancy sequence (M. Roberts, "The Unreasonable
// Effectiveness of Quasirandom Sequences", 2018), shifted in each pixel by a hash of the pixel.
#include "render/draw.h"

#include "core/hash.h"
#include "picture/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace cascade {

namespace {

constexpr float sun_light = 0.72F;
constexpr float sky_light = 0.42F;
constexpr float sun_radius = 0.12F;    ///< Tangent of the sun's half width.
constexpr float ground_shade = 0.55F;  ///< Fraction of the light that the ground's shadow removes.
constexpr float shine = 0.06F;
constexpr Colour background{1, 1, 1};
constexpr std::uint32_t rounds = 4;  ///< Tests per ray of a partly hidden light.

float to_fraction(std::uint32_t word) {
    return static_cast<float>(word >> 8) * 0x1p-24F;  // In [0, 1).
}

struct Point {
    float x = 0, y = 0;
};

/// Point `k` of a low-discrepancy sequence in the square, shifted by two hashed words: multiples of
/// 1/p and 1/p² with p³ = p + 1, as fractions of 2^32.
Point even_point(std::uint32_t k, std::uint32_t a, std::uint32_t b) {
    return {to_fraction(a + k * 3242174889u), to_fraction(b + k * 2447445414u)};
}

/// Maps the unit square to the unit disc, preserving ratios of areas.
Point on_disc(Point square) {
    const float radius = std::sqrt(square.x);
    const double angle = 2 * std::numbers::pi * static_cast<double>(square.y);
    return {radius * static_cast<float>(std::cos(angle)),
            radius * static_cast<float>(std::sin(angle))};
}

/// The hit of a ray: its light is `always` plus the visible contributions of the sun and the sky.
struct Seen {
    Colour always{0, 0, 0};
    Colour of_sun{0, 0, 0}, of_sky{0, 0, 0};
    Vector3 place, normal;
    bool is_lit = false;  ///< Whether the sun and the sky contribute.
};

class Tracer {
public:
    Tracer(const TriangleMesh& mesh, const SurfaceLook& look, const DrawOptions& options,
           const RayCaster& caster)
        : mesh_(mesh),
          look_(look),
          options_(options),
          caster_(caster),
          camera_(mesh, options.view, options.width, options.height),
          box_(bounds(mesh)),
          size_(length(box_.high - box_.low)) {
        sun_ = unit(camera_.backward() + camera_.up() * 0.9F - camera_.right() * 0.7F);
        sun_frame_ = frame_of(sun_);
        ground_ = dot(box_.low, options.view.up);
    }

    /// The colour of a pixel; `seen` is working memory.
    Colour pixel(std::int64_t x, std::int64_t y, std::vector<Seen>& seen) const {
        const auto left = static_cast<float>(x);
        const auto top = static_cast<float>(y);
        const auto hash =
            pcg4d({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0});
        const auto more = pcg4d(hash);
        const int side = options_.samples;
        seen.clear();
        for (int k = 0; k < side * side; ++k) {
            const Point place = even_point(static_cast<std::uint32_t>(k), hash[0], hash[1]);
            seen.push_back(trace(camera_.ray(left + place.x, top + place.y)));
        }
        Colour sum{0, 0, 0};
        for (const Seen& each : seen) add(each.always, 1, sum);
        add_light(seen, &Seen::of_sun, sum, [&](const Seen& from, std::uint32_t number) {
            return sees_sun(from, on_disc(even_point(number, hash[2], hash[3])));
        });
        add_light(seen, &Seen::of_sky, sum, [&](const Seen& from, std::uint32_t number) {
            return sees_sky(from, on_disc(even_point(number, more[0], more[1])));
        });
        for (float& channel : sum) channel = stored_of(channel / static_cast<float>(side * side));
        return sum;
    }

private:
    static void add(const Colour& light, float part, Colour& sum) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += light[c] * part;
    }

    /// Adds the light of one source; `asks(from, number)` tests its visibility for sample `number`.
    template <typename Asks>
    static void add_light(const std::vector<Seen>& seen, Colour Seen::*light, Colour& sum,
                          const Asks& asks) {
        const auto count = static_cast<std::uint32_t>(seen.size());
        Colour found{0, 0, 0};
        std::uint32_t lit = 0, reached = 0, asked = 0;
        const auto ask_all = [&] {
            for (std::uint32_t k = 0; k < count; ++k) {
                if (!seen[k].is_lit) continue;
                ++lit;
                if (!asks(seen[k], asked + k)) continue;
                ++reached;
                add(seen[k].*light, 1, found);
            }
            asked += count;
        };
        ask_all();
        const bool differs = reached > 0 && reached < lit;
        for (std::uint32_t k = 1; differs && k < rounds; ++k) ask_all();
        add(found, differs ? 1.0F / rounds : 1.0F, sum);
    }

    Seen trace(const Ray& ray) const {
        if (const auto hit = caster_.nearest(ray)) return surface(ray, *hit);
        if (options_.ground) return ground(ray);
        Seen nothing;
        nothing.always = background;
        return nothing;
    }

    Seen surface(const Ray& ray, const Hit& hit) const {
        const auto& [a, b, c] = mesh_.triangles[hit.triangle];
        const float w = 1 - hit.u - hit.v;
        Vector3 normal =
            unit(mesh_.normals[a] * w + mesh_.normals[b] * hit.u + mesh_.normals[c] * hit.v);
        Vector3 facet = unit(cross(mesh_.positions[b] - mesh_.positions[a],
                                   mesh_.positions[c] - mesh_.positions[a]));
        const float width = camera_.pixel() * hit.distance / static_cast<float>(options_.samples);
        const Look look = look_({hit, ray.direction, width});
        // Both sides are drawn: the visible one faces the viewer.
        if (dot(facet, ray.direction) > 0) facet = -facet;
        const float side = dot(normal, facet) < 0 ? -1.0F : 1.0F;
        if (look.tilt != Vector3{}) normal = unit(normal + look.tilt);
        if (side < 0) normal = -normal;
        Vector3 place = ray.origin + ray.direction * hit.distance + facet * (size_ * 1e-4F);
        if (options_.round_shadows) place = place + rounding(hit, side);
        const Vector3 half = unit(sun_ - ray.direction);
        const float gleam = shine * steady_power(std::max(0.0F, dot(normal, half)), 40);
        const float bright = sun_light * std::max(0.0F, dot(normal, sun_));
        Seen seen;
        for (std::size_t k = 0; k < 3; ++k) {
            seen.of_sun[k] = look.light[k] * bright + gleam;
            seen.of_sky[k] = look.light[k] * sky_light;
        }
        seen.place = place;
        seen.normal = normal;
        seen.is_lit = true;
        return seen;
    }

    /// The offset from a point on a facet to the smooth surface implied by the vertex normals: J.
    /// Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, chapter 4.
    Vector3 rounding(const Hit& hit, float side) const {
        const auto& corners = mesh_.triangles[hit.triangle];
        const std::array<float, 3> weights = {1 - hit.u - hit.v, hit.u, hit.v};
        Vector3 place, offset;
        for (std::size_t k = 0; k < 3; ++k) {
            place = place + mesh_.positions[corners[k]] * weights[k];
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3 normal = mesh_.normals[corners[k]] * side;
            const float below = std::min(0.0F, dot(place - mesh_.positions[corners[k]], normal));
            offset = offset - normal * (weights[k] * below);
        }
        return offset;
    }

    /// The background, darkened by the surface's shadow.
    Seen ground(const Ray& ray) const {
        Seen seen;
        seen.always = background;
        const Vector3 up = options_.view.up;
        const float fall = dot(ray.direction, up);
        if (fall > -1e-3F) return seen;
        const float distance = (ground_ - dot(ray.origin, up)) / fall;
        if (distance <= 0) return seen;
        const Vector3 place = ray.origin + ray.direction * distance;
        // Far from the surface there is no shadow to test.
        if (length(place - box_.centre()) > 1.5F * size_) return seen;
        const float sun = sun_light * std::max(0.0F, dot(up, sun_));
        const float full = sun + sky_light;
        for (std::size_t k = 0; k < 3; ++k) {
            seen.always[k] = background[k] * (1 - ground_shade);
            seen.of_sun[k] = background[k] * ground_shade * (sun / full);
            seen.of_sky[k] = background[k] * ground_shade * (sky_light / full);
        }
        seen.place = place + up * (size_ * 1e-4F);
        seen.normal = up;
        seen.is_lit = true;
        return seen;
    }

    /// Whether a point of the sun's disc is visible.
    bool sees_sun(const Seen& from, Point disc) const {
        const Vector3 to_sun = unit(sun_ + sun_frame_.tangent * (sun_radius * disc.x) +
                                    sun_frame_.bitangent * (sun_radius * disc.y));
        return dot(from.normal, to_sun) > 0 && !caster_.is_blocked({from.place, to_sun}, INFINITY);
    }

    /// Whether the sky is visible in the direction that projects to this point of the unit disc:
    /// uniform points give cosine-weighted directions.
    bool sees_sky(const Seen& from, Point disc) const {
        const Frame round_normal = frame_of(from.normal);
        const float height = std::sqrt(std::max(0.0F, 1 - disc.x * disc.x - disc.y * disc.y));
        const Vector3 to_sky =
            round_normal.tangent * disc.x + round_normal.bitangent * disc.y + from.normal * height;
        return !caster_.is_blocked({from.place, to_sky}, size_);
    }

    const TriangleMesh& mesh_;
    const SurfaceLook& look_;
    const DrawOptions& options_;
    const RayCaster& caster_;
    Camera camera_;
    Box box_;
    float size_;
    float ground_ = 0;
    Vector3 sun_;
    Frame sun_frame_;
};

}  // namespace

Image draw(const TriangleMesh& mesh, const RayCaster& caster, const SurfaceLook& look,
           const DrawOptions& options, Team& team) {
    const Tracer tracer(mesh, look, options, caster);
    Image image(options.width, options.height);
    team.run([&](int index) {
        std::vector<Seen> seen;
        for (std::int64_t y = index; y < options.height; y += team.size()) {
            for (std::int64_t x = 0; x < options.width; ++x) {
                image.at(x, y) = tracer.pixel(x, y, seen);
            }
        }
    });
    return image;
}

Image draw(const TriangleMesh& mesh, const SurfaceColour& colour, const DrawOptions& options,
           Team& team) {
    const RayCaster caster(mesh);
    const auto look = [&](const Sight& sight) {
        Look result{colour(sight.hit), {}};
        for (float& channel : result.light) channel = light_of(channel);
        return result;
    };
    return draw(mesh, caster, look, options, team);
}

}  // namespace cascade
