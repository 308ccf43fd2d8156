// Fills gaps in a texture from their surroundings.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// A texture with three numbers per texel, in rows from the top. `is_filled` says which texels have
/// values.
struct PartialTexture {
    std::int64_t width = 0, height = 0;
    std::vector<std::array<float, 3>> texels;
    std::vector<std::uint8_t> is_filled;  ///< 0 or 1.

    PartialTexture() = default;
    PartialTexture(std::int64_t w, std::int64_t h)
        : width(w),
          height(h),
          texels(static_cast<std::size_t>(w * h)),
          is_filled(static_cast<std::size_t>(w * h)) {}
};

/// Fills every texel without values so that it smoothly continues the texels around it.
/// Interpolation and reduced copies of the picture then have no artefacts. Renderers mix filled
/// texels with texels that are at most two texels away, so each texel that near becomes the mean of
/// adjacent texels. Texels farther away are computed by the "pull-push" method of S. Gortler et
/// al., "The Lumigraph" (SIGGRAPH 1996), section 3.4, which uses all surroundings. The picture
/// repeats in all directions. If no texel has values, all stay 0.
void fill_gaps(PartialTexture& texture);

}  // namespace cascade
