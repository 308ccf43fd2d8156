// Light: one sun behind the viewer's left shoulder, a disc and not a point so that its shadows are
// soft, and a sky that is equally bright, so that hollows are darker. Each of a pixel's rays asks
// once for the sun and once for the sky. Where is a point of a sequence that covers the
// square evenly (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018),
// moved in each pixel by a hash of the pixel.
#include "render/draw.h"

#include "core/hash.h"
#include "picture/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cascade {

namespace {

constexpr float sun_light = 0.72F;
constexpr float sky_light = 0.42F;
constexpr float sun_radius = 0.12F;     ///< Tangent of the sun's half width.
constexpr float ground_shade = 0.55F;   ///< How much of the light the ground's shadow takes away.
constexpr float shine = 0.06F;
constexpr Colour background{1, 1, 1};

float to_fraction(std::uint32_t word) {
    return static_cast<float>(word >> 8) * 0x1p-24F;  // 0 … 1, 1 excluded.
}

/// A point of the unit square.
struct Point {
    float x = 0, y = 0;
};

/// Number `k` of a sequence that is even in the square, moved by two hashed words: multiples of
/// 1/p and 1/p² with p³ = p + 1, as fractions of 2^32.
Point even_point(std::uint32_t k, std::uint32_t a, std::uint32_t b) {
    return {to_fraction(a + k * 3242174889u), to_fraction(b + k * 2447445414u)};
}

/// The unit disc, of the unit square, areas kept in proportion.
Point on_disc(Point square) {
    const float radius = std::sqrt(square.x);
    const double angle = 2 * std::numbers::pi * static_cast<double>(square.y);
    return {radius * static_cast<float>(std::cos(angle)),
            radius * static_cast<float>(std::sin(angle))};
}

struct Light {
    float sun = 0;  ///< 0 or 1.
    float sky = 0;
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
        ground_ = dot(box_.low, options.view.up);
    }

    Colour pixel(std::int64_t x, std::int64_t y) const {
        const auto left = static_cast<float>(x);
        const auto top = static_cast<float>(y);
        const auto hash =
            pcg4d({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0});
        const auto more = pcg4d(hash);
        const int side = options_.samples;
        Colour sum{0, 0, 0};
        for (int k = 0; k < side * side; ++k) {
            const auto number = static_cast<std::uint32_t>(k);
            const Point place = even_point(number, hash[0], hash[1]);
            const Dice dice{on_disc(even_point(number, hash[2], hash[3])),
                            on_disc(even_point(number, more[0], more[1]))};
            const Colour light = trace(camera_.ray(left + place.x, top + place.y), dice);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += light[c];
        }
        for (float& channel : sum) channel = stored_of(channel / static_cast<float>(side * side));
        return sum;
    }

private:
    /// Where in the sun's disc and in the sky's (seen from above) a ray asks for light.
    struct Dice {
        Point sun, sky;
    };

    Colour trace(const Ray& ray, const Dice& dice) const {
        if (const auto hit = caster_.nearest(ray)) return surface(ray, *hit, dice);
        return options_.ground ? ground(ray, dice) : background;
    }

    Colour surface(const Ray& ray, const Hit& hit, const Dice& dice) const {
        const auto& [a, b, c] = mesh_.triangles[hit.triangle];
        const float w = 1 - hit.u - hit.v;
        Vector3 normal = unit(mesh_.normals[a] * w + mesh_.normals[b] * hit.u +
                              mesh_.normals[c] * hit.v);
        Vector3 facet = unit(cross(mesh_.positions[b] - mesh_.positions[a],
                                   mesh_.positions[c] - mesh_.positions[a]));
        const float width = camera_.pixel() * hit.distance / static_cast<float>(options_.samples);
        const Look look = look_({hit, ray.direction, width});
        // Both sides are drawn: the one that is seen faces the viewer.
        if (dot(facet, ray.direction) > 0) facet = -facet;
        const float side = dot(normal, facet) < 0 ? -1.0F : 1.0F;
        if (look.tilt != Vector3{}) normal = unit(normal + look.tilt);
        if (side < 0) normal = -normal;
        Vector3 place = ray.origin + ray.direction * hit.distance + facet * (size_ * 1e-4F);
        if (options_.round_shadows) place = place + rounding(hit, side);
        const Light light = light_at(place, normal, dice);
        const Vector3 half = unit(sun_ - ray.direction);
        const float gleam =
            light.sun * shine * steady_power(std::max(0.0F, dot(normal, half)), 40);
        const float bright = sun_light * light.sun * std::max(0.0F, dot(normal, sun_)) +
                             sky_light * light.sky;
        Colour result = look.light;
        for (float& channel : result) channel = channel * bright + gleam;
        return result;
    }

    /// From a place on a facet to the round surface that its corners' normals stand on: J. Hanika, "Hacking
    /// the Shadow Terminator", Ray Tracing Gems II, 2021, chapter 4.
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

    /// The background, darker where the surface keeps light from it.
    Colour ground(const Ray& ray, const Dice& dice) const {
        const Vector3 up = options_.view.up;
        const float fall = dot(ray.direction, up);
        if (fall > -1e-3F) return background;
        const float distance = (ground_ - dot(ray.origin, up)) / fall;
        if (distance <= 0) return background;
        const Vector3 place = ray.origin + ray.direction * distance;
        // Far from the surface nothing is darker, and nothing has to be asked.
        if (length(place - box_.centre()) > 1.5F * size_) return background;
        const Light light = light_at(place + up * (size_ * 1e-4F), up, dice);
        const float full = sun_light * std::max(0.0F, dot(up, sun_)) + sky_light;
        const float left = (sun_light * light.sun * std::max(0.0F, dot(up, sun_)) +
                            sky_light * light.sky) / full;
        Colour result = background;
        for (float& channel : result) channel *= 1 - ground_shade * (1 - left);
        return result;
    }

    Light light_at(Vector3 place, Vector3 normal, const Dice& dice) const {
        const Frame round_sun = frame_of(sun_);
        const Vector3 to_sun = unit(sun_ + round_sun.tangent * (sun_radius * dice.sun.x) +
                                    round_sun.bitangent * (sun_radius * dice.sun.y));
        // Directions whose shadow on the floor of a dome is even are spread by the cosine.
        const Frame round_normal = frame_of(normal);
        const Point sky = dice.sky;
        const float height = std::sqrt(std::max(0.0F, 1 - sky.x * sky.x - sky.y * sky.y));
        const Vector3 to_sky = round_normal.tangent * sky.x + round_normal.bitangent * sky.y +
                               normal * height;
        Light light;
        const bool faces_sun = dot(normal, to_sun) > 0;
        if (faces_sun && !caster_.is_blocked({place, to_sun}, INFINITY)) light.sun = 1;
        if (!caster_.is_blocked({place, to_sky}, size_)) light.sky = 1;
        return light;
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
};

}  // namespace

Image draw(const TriangleMesh& mesh, const RayCaster& caster, const SurfaceLook& look,
           const DrawOptions& options, Team& team) {
    const Tracer tracer(mesh, look, options, caster);
    Image image(options.width, options.height);
    team.run([&](int index) {
        for (std::int64_t y = index; y < options.height; y += team.size()) {
            for (std::int64_t x = 0; x < options.width; ++x) image.at(x, y) = tracer.pixel(x, y);
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
