// The highlights of a surface in the sun's light.
#pragma once

#include <algorithm>

namespace cascade {

/// A highlight by J. Blinn (1977): strength · cos^power of the angle between the normal and the
/// direction half way to the sun.
struct Gloss {
    float strength = 0.06F;
    float power = 40;
    float metalness = 0;  ///< 0 … 1: a metal's highlight has its colour, and it has no other shade.
};

/// The gloss for a roughness and metalness as in glTF, 0 … 1. The power gives a lobe as wide as
/// GGX's (B. Walter et al., 2007), widened by the sun's disc. The strength grows with the power as
/// the light of a lobe does.
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
