// Random tissues for tests, and sums over all pairs of their cells by simple loops.
#pragma once

#include "hand_made_tissue.h"
#include "tests/support/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace cascade::test {

using Values = HandMadeTissue::Values;

inline constexpr double default_reach = 1.2;

inline Vector3d operator*(double number, const Vector3d& v) { return v * number; }

inline std::vector<Vector3d> random_places(std::size_t count, std::uint64_t seed) {
    RandomStream random(seed);
    const auto number = [&] { return 0.5 + 0.35 * static_cast<double>(random.symmetric()); };
    std::vector<Vector3d> places;
    for (std::size_t k = 0; k < count; ++k) places.push_back({number(), number(), number()});
    return places;
}

/// Gives cells random frames, whose quaternions have any length.
inline void turn_at_random(HandMadeTissue& tissue, std::uint64_t seed) {
    RandomStream random(seed);
    for (std::size_t cell = 0; cell < tissue.size(); ++cell) {
        for (const char* part : {"frame.w", "frame.x", "frame.y", "frame.z"}) {
            tissue.values(part)[cell] = static_cast<double>(random.symmetric()) + 0.01;
        }
    }
}

/// An axis of a frame: the quaternion product q e q* / |q|².
inline Vector3d axis_of(HandMadeTissue& tissue, std::size_t cell, const Vector3d& axis) {
    const double w = tissue.values("frame.w")[cell];
    const Vector3d v = tissue.vector("frame", cell);
    // q e q* = (w² − v·v) e + 2 (v·e) v + 2 w v×e.
    const double square = w * w + dot(v, v);
    return (1 / square) *
           ((w * w - dot(v, v)) * axis + (2 * dot(v, axis)) * v + (2 * w) * cross(v, axis));
}

/// The term of a sum over neighbours, for cell i and its neighbour j.
using Term = std::function<double(std::size_t i, std::size_t j)>;

inline Values summed(HandMadeTissue& tissue, double within_radii, const Term& term) {
    Values sums(tissue.size(), 0);
    for (std::size_t i = 0; i < tissue.size(); ++i) {
        for (std::size_t j = 0; j < tissue.size(); ++j) {
            const double distance = length(tissue.vector("p", j) - tissue.vector("p", i));
            const double radii = tissue.values("r")[i] + tissue.values("r")[j];
            if (i != j && distance < within_radii * radii) sums[i] += term(i, j);
        }
    }
    return sums;
}

inline double distance_of(HandMadeTissue& tissue, std::size_t i, std::size_t j) {
    return length(tissue.vector("p", j) - tissue.vector("p", i));
}

inline double contact_of(HandMadeTissue& tissue, std::size_t i, std::size_t j) {
    const double radii = tissue.values("r")[i] + tissue.values("r")[j];
    const double share = (default_reach - distance_of(tissue, i, j) / radii) / (default_reach - 1);
    return std::clamp(share, 0.0, 1.0);
}

inline void expect_near(const Values& values, const Values& expected, double error = 1e-12) {
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
        EXPECT_NEAR(values[cell], expected[cell], error) << "cell " << cell;
    }
}

}  // namespace cascade::test
