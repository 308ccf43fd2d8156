// Filling what a picture lacks from what lies around it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// Three numbers a texel, rows from the top, and which of the texels have some.
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

/// Gives every texel that has none numbers that go on smoothly from those around, so that neither
/// interpolation nor a smaller copy of the picture brings in anything else: S. Gortler et al., "The
/// Lumigraph" (SIGGRAPH 1996), section 3.4, pull and push. The picture repeats in all directions.
/// Where no texel has numbers they stay 0.
void fill_gaps(PartialTexture& texture);

}  // namespace cascade
