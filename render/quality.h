// How much work is spent on a rendered picture.
#pragma once

#include "core/enum_named.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cascade {

enum class Quality : std::uint8_t { draft, normal, fine };

inline constexpr std::array<std::string_view, 3> quality_names{"draft", "normal", "fine"};

constexpr std::string_view name_of(Quality quality) {
    return quality_names[static_cast<std::size_t>(quality)];
}

constexpr std::optional<Quality> quality_named(std::string_view name) {
    return enum_named<Quality>(quality_names, name);
}

/// The limits and counts of rays of each quality. A test is a ray towards a light.
struct Effort {
    /// Whether one ray is enough for pixels in uniform parts of the picture. In other pixels, four
    /// rays are traced, and their number is doubled until they agree or reach `most_rays`, a power
    /// of 2.
    bool one_is_enough = true;
    std::uint32_t most_rays = 16;
    /// The rays of a pixel agree if the standard error of their mean tone (the square root of
    /// light) is smaller.
    float error = 0.02F;
    /// The number of tests of a light that is partly hidden from a pixel. Tests at neighbouring
    /// pixels count towards this number.
    std::uint32_t sun_tests = 8, sky_tests = 3;

    /// The width, in pixels, of the area that the first ray of a pixel samples.
    float widest_ray() const { return one_is_enough ? 1.0F : 0.5F; }
};

constexpr Effort effort_of(Quality quality) {
    switch (quality) {
        case Quality::draft: return {true, 4, 0.1F, 3, 1};
        case Quality::normal: return {};
        case Quality::fine: break;
    }
    return {false, 64, 0.006F, 24, 8};
}

}  // namespace cascade
