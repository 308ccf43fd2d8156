// Adds a rim around the filled texels, then pulls and pushes through a pyramid of halved textures
// (S. J. Gortler et al., "The Lumigraph", SIGGRAPH 1996).
#include "export/fill_gaps.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr int rim = 2;  ///< Width in texels.

/// Fills texels that have filled neighbours. Neighbours at a side have twice the weight of
/// neighbours at a corner.
void widen(PartialTexture& texture) {
    const std::vector<std::uint8_t> was_filled = texture.is_filled;
    const auto wrapped = [](std::int64_t place, std::int64_t size) {
        return place < 0 ? place + size : place < size ? place : place - size;
    };
    for (std::int64_t y = 0; y < texture.height; ++y) {
        for (std::int64_t x = 0; x < texture.width; ++x) {
            const auto at = static_cast<std::size_t>(y * texture.width + x);
            if (was_filled[at] != 0) continue;
            std::array<double, 3> sum{};  // Sums could overflow in binary32.
            double count = 0;
            for (std::int64_t j = -1; j <= 1; ++j) {
                const std::int64_t line = wrapped(y + j, texture.height) * texture.width;
                for (std::int64_t i = -1; i <= 1; ++i) {
                    const auto near =
                        static_cast<std::size_t>(line + wrapped(x + i, texture.width));
                    if (was_filled[near] == 0) continue;
                    const double weight = i == 0 || j == 0 ? 2 : 1;
                    for (std::size_t c = 0; c < 3; ++c)
                        sum[c] += weight * static_cast<double>(texture.texels[near][c]);
                    count += weight;
                }
            }
            if (count == 0) continue;
            for (std::size_t c = 0; c < 3; ++c)
                texture.texels[at][c] = static_cast<float>(sum[c] / count);
            texture.is_filled[at] = 1;
        }
    }
}

/// A texture half as wide and high. Each texel is the mean of its fine texels that have values.
PartialTexture halved(const PartialTexture& fine) {
    PartialTexture coarse((fine.width + 1) / 2, (fine.height + 1) / 2);
    for (std::int64_t y = 0; y < coarse.height; ++y) {
        for (std::int64_t x = 0; x < coarse.width; ++x) {
            std::array<double, 3> sum{};  // Sums could overflow in binary32.
            double count = 0;
            for (std::int64_t j = 2 * y; j < std::min(2 * y + 2, fine.height); ++j) {
                for (std::int64_t i = 2 * x; i < std::min(2 * x + 2, fine.width); ++i) {
                    const auto at = static_cast<std::size_t>(j * fine.width + i);
                    if (fine.is_filled[at] == 0) continue;
                    for (std::size_t c = 0; c < 3; ++c)
                        sum[c] += static_cast<double>(fine.texels[at][c]);
                    ++count;
                }
            }
            if (count == 0) continue;
            const auto at = static_cast<std::size_t>(y * coarse.width + x);
            for (std::size_t c = 0; c < 3; ++c)
                coarse.texels[at][c] = static_cast<float>(sum[c] / count);
            coarse.is_filled[at] = 1;
        }
    }
    return coarse;
}

/// The coarse texels on either side of a fine texel's centre, and the weight of the second coarse
/// texel.
struct CoarseNeighbours {
    std::int64_t first = 0, second = 0;
    float part = 0;
};
CoarseNeighbours coarse_neighbours(std::int64_t fine, std::int64_t fine_size,
                                   std::int64_t coarse_size) {
    const float place = (static_cast<float>(fine) + 0.5F) * static_cast<float>(coarse_size) /
                            static_cast<float>(fine_size) -
                        0.5F;
    const auto first = static_cast<std::int64_t>(std::floor(place));
    return {(first + coarse_size) % coarse_size, (first + 1) % coarse_size,
            place - static_cast<float>(first)};
}

/// Fills gaps from a coarse texture without gaps.
void take_from(const PartialTexture& coarse, PartialTexture& fine) {
    for (std::int64_t y = 0; y < fine.height; ++y) {
        const CoarseNeighbours down = coarse_neighbours(y, fine.height, coarse.height);
        for (std::int64_t x = 0; x < fine.width; ++x) {
            const auto at = static_cast<std::size_t>(y * fine.width + x);
            if (fine.is_filled[at] != 0) continue;
            const CoarseNeighbours across = coarse_neighbours(x, fine.width, coarse.width);
            const auto mixed = [&](std::int64_t row, std::size_t c) {
                const auto line = static_cast<std::size_t>(row * coarse.width);
                return coarse.texels[line + static_cast<std::size_t>(across.first)][c] *
                           (1 - across.part) +
                       coarse.texels[line + static_cast<std::size_t>(across.second)][c] *
                           across.part;
            };
            for (std::size_t c = 0; c < 3; ++c) {
                fine.texels[at][c] =
                    mixed(down.first, c) * (1 - down.part) + mixed(down.second, c) * down.part;
            }
            fine.is_filled[at] = 1;
        }
    }
}

}  // namespace

void fill_gaps(PartialTexture& texture) {
    const auto has_gap = [](const PartialTexture& level) {
        return std::find(level.is_filled.begin(), level.is_filled.end(), 0) !=
               level.is_filled.end();
    };
    std::vector<PartialTexture> levels;
    const auto level = [&](std::size_t k) -> PartialTexture& {
        return k == 0 ? texture : levels[k - 1];
    };
    for (int k = 0; k < rim && has_gap(texture); ++k) widen(texture);
    std::size_t top = 0;
    for (; has_gap(level(top)) && level(top).width * level(top).height > 1; ++top) {
        levels.push_back(halved(level(top)));
    }
    if (has_gap(level(top))) return;  // No texel has values.
    for (std::size_t k = top; k-- > 0;) take_from(level(k + 1), level(k));
}

}  // namespace cascade
