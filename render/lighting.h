// The light on a scene: a sun that casts shadows, and an environment in all directions.
#pragma once

#include "core/enum_named.h"
#include "core/vector3.h"
#include "picture/image.h"
#include "render/gloss.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

class Camera;

enum class Lighting : std::uint8_t { sun, studio, outdoors };

inline constexpr std::array<std::string_view, 3> lighting_names{"sun", "studio", "outdoors"};

constexpr std::string_view name_of(Lighting lighting) {
    return lighting_names[static_cast<std::size_t>(lighting)];
}

constexpr std::optional<Lighting> lighting_named(std::string_view name) {
    return enum_named<Lighting>(lighting_names, name);
}

/// A soft light far away. Its radiance in the direction ω is colour · ((1 + ω·d)/2)^power. The
/// larger the power, the smaller the light appears. A light with the power 1 reaches all surfaces
/// that do not face away.
struct SoftLight {
    Vector3 direction;  ///< The direction d, of length 1.
    /// Some channels may be negative, which darkens the side that faces the light.
    Colour colour{};
    double power = 1;  ///< At least 0.
};

/// All lights of a scene. The unit of radiance is such that a white surface facing a uniform
/// environment of radiance 1 reflects the light 1.
class Lights {
public:
    /// Places the lights relative to the camera. The sky and the ground are placed relative to
    /// `up`.
    Lights(Lighting lighting, const Camera& camera, const Vector3& up);

    Vector3 sun;               ///< The direction to the centre of the sun, of length 1.
    Colour sunlight{};         ///< The light that a white surface facing the sun reflects.
    float sun_radius = 0.12F;  ///< The tangent of half the sun's width.
    Colour even{};             ///< The uniform radiance from all directions.

    /// The light that a white surface with this normal reflects from the soft lights, if nothing
    /// hides them. This light is the convolution of the lights with the cosine up to the second
    /// order of spherical harmonics (R. Ramamoorthi and P. Hanrahan, "An Efficient Representation
    /// for Irradiance Environment Maps", 2001).
    Colour soft(const Vector3& normal) const;

    /// The light of the soft lights that is mirrored into the viewer's eye from this direction,
    /// blurred by the lobe of the gloss.
    Colour mirrored(const Vector3& direction, const Gloss& gloss) const;

private:
    void add(const Vector3& towards, const Colour& colour, double power);

    std::vector<SoftLight> soft_;
    /// For each soft light, the factors of the three orders of its convolution with the cosine.
    std::vector<std::array<float, 3>> orders_;
};

/// The fraction that a surface reflects of the light from the viewer's mirrored direction: C.
/// Schlick's approximation (1994), reduced at grazing angles for rough surfaces (S. Lagarde, 2011).
/// `facing` is the cosine between the normal and the direction to the viewer.
float reflectance(float facing, const Gloss& gloss);

}  // namespace cascade
