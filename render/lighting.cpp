// The three sets of lights, and integrals of soft lights in closed form.
#include "render/lighting.h"

#include "picture/srgb.h"
#include "render/camera.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// The fraction of light from the front that glass, skin and most materials reflect.
constexpr float of_glass = 0.04F;

/// The factors of the Legendre polynomials P0, P1 and P2 of the cosine between normal and light,
/// for a light of power `p`.
///
/// The integrals of ((1 + c)/2)^p P_l(c) over c from −1 to 1 follow from powers of t = (1 + c)/2.
/// For the cosine, the corresponding factors are π, 2π/3 and π/4. The results are divided by π.
std::array<float, 3> orders_of(double p) {
    const double flat = 2 / (p + 1);
    const double linear = 4 / (p + 2) - flat;
    const double square = 12 / (p + 3) - 12 / (p + 2) + flat;
    return {static_cast<float>(flat / 2), static_cast<float>(linear),
            static_cast<float>(square * 5 / 8)};
}

}  // namespace

Lights::Lights(Lighting lighting, const Camera& camera, const Vector3& up) {
    const Vector3 right = camera.right(), above = camera.up(), near = camera.backward();
    switch (lighting) {
        case Lighting::sun:
            sun = unit(near + above * 0.9F - right * 0.7F);
            sunlight = {0.72F, 0.72F, 0.72F};
            even = {0.42F, 0.42F, 0.42F};
            break;
        case Lighting::studio:
            // A key light at the upper left, a weaker fill light at the right, a rim light above
            // the model on its far side, and a second, small light beside the key light.
            sun = unit(near * 0.8F + above * 0.8F - right * 0.9F);
            sun_radius = 0.25F;
            sunlight = {0.66F, 0.63F, 0.59F};
            even = {0.12F, 0.12F, 0.13F};
            add(right + near * 0.6F + above * 0.1F, {0.55F, 0.60F, 0.70F}, 3);
            add(above - near * 0.7F + right * 0.4F, {2.3F, 2.3F, 2.4F}, 12);
            add(near * 0.3F + above * 0.5F - right, {1.2F, 1.15F, 1.1F}, 24);
            break;
        case Lighting::outdoors: {
            // A low sun, a blue sky that is brightest around it, and light ground.
            const Vector3 level = unit(near - up * dot(near, up));
            const Vector3 side = cross(up, level);
            sun = unit(level * 0.75F + up * 0.75F - side * 0.8F);
            sun_radius = 0.08F;
            sunlight = {0.90F, 0.80F, 0.64F};
            even = {0.26F, 0.29F, 0.33F};
            add(up, {0.08F, 0.20F, 0.42F}, 2);
            add(sun, {0.55F, 0.45F, 0.30F}, 10);
            add(-up, {0.02F, -0.06F, -0.15F}, 2);
            break;
        }
    }
}

void Lights::add(const Vector3& towards, const Colour& colour, double power) {
    soft_.push_back({unit(towards), colour, power});
    orders_.push_back(orders_of(power));
}

Colour Lights::soft(const Vector3& normal) const {
    Colour sum{};
    for (std::size_t k = 0; k < soft_.size(); ++k) {
        const SoftLight& light = soft_[k];
        const float c = dot(normal, light.direction);
        const auto& [flat, linear, square] = orders_[k];
        const float part = std::max(0.0F, flat + linear * c + square * (1.5F * c * c - 0.5F));
        for (std::size_t i = 0; i < 3; ++i) sum[i] += light.colour[i] * part;
    }
    return sum;
}

Colour Lights::mirrored(const Vector3& direction, const Gloss& gloss) const {
    // The angle of the half vector is half the angle of the reflected ray. So cos^n of the half
    // vector's angle is about ((1 + cos)/2)^(n/2) of the reflected ray's angle. Both lobes are
    // nearly Gaussians, whose squared widths add.
    const double own = static_cast<double>(gloss.power) / 2;
    Colour sum{};
    for (const SoftLight& light : soft_) {
        const double power = light.power * own / (light.power + own);
        const float base = std::max(0.0F, (1 + dot(direction, light.direction)) / 2);
        const float part =
            static_cast<float>((power + 1) / (light.power + 1)) * steady_power(base, power);
        for (std::size_t i = 0; i < 3; ++i) sum[i] += light.colour[i] * part;
    }
    return sum;
}

float reflectance(float facing, const Gloss& gloss) {
    const float width = 2 / (gloss.power + 2);  // The fourth power of the roughness.
    const float most = std::max(of_glass, 1 - std::sqrt(std::sqrt(width)));
    const float rest = 1 - std::clamp(facing, 0.0F, 1.0F);
    const float fifth = rest * rest * rest * rest * rest;
    return of_glass + (most - of_glass) * fifth;
}

}  // namespace cascade
