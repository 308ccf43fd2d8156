// The amount of work for a rendered picture.
#pragma once

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
    for (std::size_t k = 0; k < quality_names.size(); ++k) {
        if (quality_names[k] == name) return static_cast<Quality>(k);
    }
    return std::nullopt;
}

/// The limits and counts of rays of each quality. A test is a ray towards a light.
struct Effort {
    /// One ray is enough for a pixel in uniform parts of the picture. Others have four, and then
    /// twice as many until they agree or are `most_rays`, a power of 2.
    bool one_is_enough = true;
    std::uint32_t most_rays = 16;
    /// The standard error of a pixel's tone (the root of its light) below which its rays agree.
    float error = 0.02F;
    /// Tests per pixel where a light is partly hidden. Its neighbours' tests count, too.
    std::uint32_t sun_tests = 8, sky_tests = 3;

    /// The width of the area that the first ray of a pixel samples, in pixels.
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
