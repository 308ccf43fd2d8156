// Properties of all texture coordinates that Cascade makes.
#pragma once

#include "atlas/texture_facts.h"
#include "atlas/texture_layout.h"
#include "atlas/unwrap.h"
#include "tests/support/never.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace cascade::test {

inline Result<MeshTexture> unwrapped(const SurfaceMesh& mesh, std::int64_t texels = 1024,
                                     int threads = 2) {
    Team team(threads);
    return unwrap(mesh, texels, team, never);
}

/// The chart of each triangle. Triangles are connected by common edges with the same position in
/// the texture.
inline std::vector<std::uint32_t> charts_of(const SurfaceMesh& mesh) {
    SurfaceMesh cut;
    cut.triangles = mesh.triangles;
    cut.across = mesh.across;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists()) continue;
            const auto &here = mesh.texture[t], &there = mesh.texture[other.triangle];
            if (here[k] != there[corner_after(other.edge)] ||
                here[corner_after(k)] != there[other.edge]) {
                cut.across[t][k] = {};
            }
        }
    }
    return connected_components(cut);
}

/// The distance of the two nearest charts in texels, but at most `most`. It is the smallest number
/// of steps, also diagonal ones, from a texel of one chart to a texel of the other.
inline int least_gap(const SurfaceMesh& mesh, std::int64_t side, int most) {
    const std::vector<std::uint32_t> charts = charts_of(mesh);
    const TextureLayout layout(mesh, side, side);
    std::vector<std::uint32_t> owners(static_cast<std::size_t>(side * side));
    layout.find_owners(0, side, owners);
    const auto chart_at = [&](std::int64_t x, std::int64_t y) {
        const auto k = ((y + side) % side) * side + (x + side) % side;
        const std::uint32_t owner = owners[static_cast<std::size_t>(k)];
        return owner == TextureLayout::nothing ? TextureLayout::nothing : charts[owner];
    };
    int least = most;
    for (std::int64_t y = 0; y < side; ++y) {
        for (std::int64_t x = 0; x < side; ++x) {
            const std::uint32_t here = chart_at(x, y);
            if (here == TextureLayout::nothing) continue;
            for (int j = -least; j <= least; ++j) {
                for (int i = -least; i <= least; ++i) {
                    const std::uint32_t there = chart_at(x + i, y + j);
                    if (there == TextureLayout::nothing || there == here) continue;
                    least = std::min(least, std::max(std::abs(i), std::abs(j)));
                }
            }
        }
    }
    return least;
}

/// No two triangles overlap, none is mirrored, and all are in 0 … 1².
inline void expect_sound(const SurfaceMesh& mesh) {
    constexpr std::int64_t side = 1500;
    const TextureLayout layout(mesh, side, side);
    std::vector<std::uint32_t> owners(static_cast<std::size_t>(side * side));
    EXPECT_EQ(layout.find_owners(0, side, owners).again, 0);
    EXPECT_FALSE(layout.repeats());
    EXPECT_EQ(layout.skipped().without_place, 0u);
    EXPECT_EQ(layout.mirrored_part(), 0);
    for (const auto& corners : mesh.texture) {
        for (const TexturePlace& place : corners) {
            for (const float c : place) EXPECT_TRUE(c >= 0 && c <= 1) << c;
        }
    }
}

}  // namespace cascade::test
