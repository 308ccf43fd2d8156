// The highlights of a surface in the sun's light.
#pragma once

#include <algorithm>

namespace cascade {

/// A highlight by J. Blinn (1977): strength · cos^power of the angle between the normal and the
/// direction half way to the sun.
struct Gloss {
    float strength = 0.06F;
    float power = 40;
    /// 0 … 1. A metal reflects light only in highlights of its own colour.
    float metalness = 0;
};

/// The gloss for a roughness and a metalness, 0 … 1, as defined by glTF. The power gives a lobe as
/// wide as GGX's (B. Walter et al., 2007), widened by the sun's disc. A narrower lobe is stronger,
/// so that its total light stays nearly the same.
inline Gloss gloss_of(float roughness, float metalness) {
    constexpr float of_sun = 0.004F;
    const float width = roughness * roughness;
    Gloss gloss;
    gloss.power = std::max(2 / (width * width + of_sun) - 2, 1.0F);
    constexpr Gloss usual;
    const float dull = usual.strength * (gloss.power + 8) / (usual.power + 8);
    // Glass and skin reflect 4 % of the light that comes from the front.
    gloss.strength = dull * (1 + metalness * (1 / 0.04F - 1));
    gloss.metalness = metalness;
    return gloss;
}

}  // namespace cascade
