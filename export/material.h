// The properties of a surface, besides colour and height, in glTF's metallic-roughness model.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cascade {

/// Quantities from 0 to 1. They are stored in three textures: the first has occlusion, roughness
/// and metalness, the second has red, green and blue of the emitted light, and the third has the
/// opacity. The enumerators are in this order.
enum class MaterialPart : std::uint8_t {
    occlusion,  ///< The visible part of the sky: 0 in the deepest crevice.
    roughness,
    metalness,
    red,  ///< Emitted light, in sRGB.
    green,
    blue,
    opacity,
};
inline constexpr std::size_t material_parts = 7;

/// One value for each part.
template <typename Each>
struct OfParts : std::array<Each, material_parts> {
    using Base = std::array<Each, material_parts>;
    Each& operator[](MaterialPart part) { return Base::operator[](static_cast<std::size_t>(part)); }
    const Each& operator[](MaterialPart part) const {
        return Base::operator[](static_cast<std::size_t>(part));
    }
    using Base::operator[];
};

/// For each part that is given, one number from 0 to 1 per cell. Parts that are not given are
/// empty. `red`, `green` and `blue` are all given or all empty.
using MaterialCells = OfParts<std::span<const float>>;

/// Whether opacities only mark holes, that is, whether every opacity is 0 or 1.
inline bool is_cut(std::span<const float> opacities) {
    return !opacities.empty() && std::all_of(opacities.begin(), opacities.end(), [](float opacity) {
        return opacity == 0 || opacity == 1;
    });
}

/// The maps that exist, besides colours.
struct MapSet {
    bool heights = false, normals = false;
    bool occlusion = false, roughness = false, metalness = false;
    bool emission = false, opacity = false;

    /// Whether there is a texture of occlusion, roughness and metalness, that is, whether at least
    /// one of the three is given.
    bool has_surface() const { return occlusion || roughness || metalness; }
};

inline MapSet maps_of(const MaterialCells& material, bool has_heights) {
    const auto has = [&](MaterialPart part) { return !material[part].empty(); };
    return {has_heights,
            has_heights,
            has(MaterialPart::occlusion),
            has(MaterialPart::roughness),
            has(MaterialPart::metalness),
            has(MaterialPart::red),
            has(MaterialPart::opacity)};
}

}  // namespace cascade
