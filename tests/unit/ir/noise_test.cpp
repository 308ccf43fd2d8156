// Smooth noise and lattices of seeds, compared with the formulas of the specification in double
// precision. Also tests their statistics and symmetries.
#include "core/hash.h"
#include "tests/unit/ir/space_fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cascade {
namespace {

using test::cells_of;
using test::field_of;
using test::moments_of;
using test::some_key;

Field noise(const Grid& grid, float scale, int octaves, std::uint64_t key = some_key,
            std::uint32_t draw = 0) {
    return field_of(grid, [&](KernelBuilder& builder, const Space& space) {
        return smooth_noise(builder, space, builder.number(scale), octaves,
                            {builder.word(draw), key});
    });
}

/// spec/random.md, "The hash of a lattice point".
std::uint32_t point_hash(std::int64_t i, std::int64_t j, std::uint32_t draw, std::uint64_t key,
                         std::uint32_t stream) {
    const auto keys =
        pcg4d({static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32), stream, 0});
    std::uint32_t h = static_cast<std::uint32_t>(i) * 0x9e3779b1u +
                      static_cast<std::uint32_t>(j) * 0x85ebca6bu + draw * 0x27d4eb2fu + keys[0];
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= keys[1];
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ (h >> 16);
}

double fraction(std::uint32_t word) { return static_cast<std::int32_t>(word) * 0x1p-31; }

std::int64_t wrapped(std::int64_t index, std::int64_t count) {
    return count == 0 ? index : ((index % count) + count) % count;
}

/// One octave at (x, y). With a count of 0, the lattice does not wrap along that axis.
double octave(double x, double y, double side_x, double side_y, std::int64_t count_x,
              std::int64_t count_y, std::uint32_t draw, std::uint32_t stream) {
    const double u = x / side_x, v = y / side_y;
    const auto i = static_cast<std::int64_t>(std::floor(u));
    const auto j = static_cast<std::int64_t>(std::floor(v));
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const std::int64_t di = corner % 2, dj = corner / 2;
        const std::uint32_t hash =
            point_hash(wrapped(i + di, count_x), wrapped(j + dj, count_y), draw, some_key, stream);
        const double away_x = u - static_cast<double>(i + di),
                     away_y = v - static_cast<double>(j + dj);
        const auto weight = [](double a) {
            const double t = std::fabs(a);
            return 1 - t * t * t * (t * (t * 6 - 15) + 10);
        };
        sum += weight(away_x) * weight(away_y) *
               (fraction(hash) * away_x + fraction(hash << 16) * away_y);
    }
    return sum;
}

TEST(Noise, IsTheFormulaOfTheSpecification) {
    const Grid grid{96, 60, Boundary::periodic};
    // 9 and 6 sides of the lattice fit into the grid.
    const Field field = noise(grid, 0.11f, 2, some_key, 7);
    const Grid closed{96, 60, Boundary::no_flux};
    const Field open = noise(closed, 0.11f, 1);
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const double x = (static_cast<double>(i) + 0.5) / 96,
                         y = (static_cast<double>(j) + 0.5) / 96;
            const double first = octave(x, y, 1.0 / 9, 0.625 / 6, 9, 6, 7, 0);
            const double second = octave(x, y, 1.0 / 18, 0.625 / 11, 18, 11, 7, 1);
            ASSERT_NEAR(field.at(i, j), (first + 0.5 * second) / 1.5, 2e-5) << i << ", " << j;
            const double side = 0.11f;
            ASSERT_NEAR(open.at(i, j), octave(x, y, side, side, 0, 0, 0, 0), 2e-5)
                << i << ", " << j;
        }
    }
}

TEST(Noise, HasNoMeanAndStaysInItsRange) {
    double sum = 0, squares = 0;
    for (std::uint64_t key = 1; key <= 20; ++key) {
        const auto moments = moments_of(cells_of(
            noise({128, 128, Boundary::periodic}, 0.0625f, 1, key * 0x9e3779b97f4a7c15ULL)));
        EXPECT_GT(moments.least, -1);
        EXPECT_LT(moments.most, 1);
        sum += moments.mean;
        squares += moments.variance;
    }
    // The gradients have the variance 1/3 along each axis: ∫∫ Σ w² (a² + b²) / 3 over a square.
    double exact = 0;
    const int parts = 400;
    for (int k = 0; k < parts * parts; ++k) {
        const double a = (k % parts + 0.5) / parts, b = (k / parts + 0.5) / parts;
        const auto weight = [](double t) { return 1 - t * t * t * (t * (t * 6 - 15) + 10); };
        exact += 4 * std::pow(weight(a) * weight(b), 2) * (a * a + b * b) / 3 / parts / parts;
    }
    EXPECT_NEAR(sum / 20, 0, 0.005);
    EXPECT_NEAR(squares / 20, exact, 0.05 * exact);
    EXPECT_NEAR(std::sqrt(exact), 0.176, 0.001) << "as spec/random.md says";
}

TEST(Noise, IsSmoothAcrossPeriodicSides) {
    const Grid grid{200, 100, Boundary::periodic};
    for (const float scale : {0.07f, 0.3f, 0.9f}) {
        const Field field = noise(grid, scale, 1);
        double inside = 0, across = 0;
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                const double step =
                    std::max(std::fabs(field.at((i + 1) % grid.width, j) - field.at(i, j)),
                             std::fabs(field.at(i, (j + 1) % grid.height) - field.at(i, j)));
                const bool at_side = i + 1 == grid.width || j + 1 == grid.height;
                double& largest = at_side ? across : inside;
                largest = std::max(largest, step);
            }
        }
        EXPECT_LE(across, inside * 1.05) << scale;
        EXPECT_LT(inside, 0.12 / static_cast<double>(scale) * 0.5) << scale;
    }
}

TEST(Noise, DrawsKeysAndOctavesAreIndependent) {
    const Grid grid{256, 256, Boundary::periodic};
    const std::vector<double> one = cells_of(noise(grid, 0.03f, 1));
    const double variance = moments_of(one).variance;
    const auto correlation = [&](const std::vector<double>& other) {
        double sum = 0;
        for (std::size_t k = 0; k < one.size(); ++k) sum += one[k] * other[k];
        return sum / static_cast<double>(one.size()) / variance;
    };
    EXPECT_NEAR(correlation(one), 1, 1e-2);
    // About 1100 independent lattice points, so the tolerance is 5 / √1100.
    for (std::uint32_t draw = 1; draw < 12; ++draw) {
        EXPECT_LT(std::fabs(correlation(cells_of(noise(grid, 0.03f, 1, some_key, draw)))), 0.15);
    }
    for (int bit = 0; bit < 64; ++bit) {
        const auto other = cells_of(noise(grid, 0.03f, 1, some_key ^ (1ULL << bit)));
        EXPECT_LT(std::fabs(correlation(other)), 0.15) << "bit " << bit;
    }
}

TEST(Noise, ALineHasIt) {
    const auto moments = moments_of(cells_of(noise({4096, 1, Boundary::periodic}, 0.01f, 3)));
    EXPECT_NEAR(moments.mean, 0, 0.05);
    EXPECT_GT(moments.variance, 0.01);
    EXPECT_GE(moments.least, -1);
    EXPECT_LE(moments.most, 1);
    EXPECT_EQ(moments_of(cells_of(noise({1, 1, Boundary::periodic}, 0.1f, 1))).most, 0);
}

TEST(Noise, AVolumeHasIt) {
    const Grid grid{48, 40, Boundary::periodic, 32};
    const auto cells = cells_of(noise(grid, 0.125f, 1));
    const auto moments = moments_of(cells);
    EXPECT_NEAR(moments.mean, 0, 0.01);
    EXPECT_GT(moments.variance, 0.01);
    EXPECT_GT(moments.least, -1);
    EXPECT_LT(moments.most, 1);
    const std::size_t slice = 48 * 40;
    double across = 0, inside = 0;
    for (std::size_t k = 0; k < slice; ++k) {
        across = std::max(across, std::fabs(cells[k] - cells[31 * slice + k]));
        inside = std::max(inside, std::fabs(cells[k + 15 * slice] - cells[k + 16 * slice]));
    }
    EXPECT_LT(across, 2 * inside) << "no seam between the last slice and the first";
    EXPECT_GT(inside, 0.02);
}

TEST(Noise, StrangeScalesGiveNumbers) {
    for (const float scale : {1e-30f, 1e-9f, 7.0f, 1e30f, -1.0f}) {
        const auto moments = moments_of(cells_of(noise({32, 16, Boundary::periodic}, scale, 2)));
        EXPECT_LE(moments.most, 1) << scale;
        EXPECT_GE(moments.least, -1) << scale;
    }
}

Field seeds(const Grid& grid, LatticeKind kind, float spacing, float radius, float jitter) {
    return field_of(grid, [&](KernelBuilder& builder, const Space& space) {
        return seed_lattice(builder, space, kind, builder.number(spacing), builder.number(radius),
                            builder.number(jitter), {builder.word(0), some_key});
    });
}

double covered(const Field& field) { return moments_of(cells_of(field)).mean; }

TEST(Seeds, CoverTheAreaOfTheirDiscs) {
    const Grid grid{512, 256, Boundary::periodic};
    const double disc = std::acos(-1.0) * 0.02 * 0.02;
    // 10 by 5 seeds, and twice as many in a diamond lattice, on an area of ½. With this jitter no
    // discs overlap.
    for (const float jitter : {0.0f, 0.01f, 0.025f}) {
        EXPECT_NEAR(covered(seeds(grid, LatticeKind::square, 0.1f, 0.02f, jitter)), 100 * disc,
                    0.002);
    }
    EXPECT_NEAR(covered(seeds(grid, LatticeKind::diamond, 0.1f, 0.02f, 0.005f)), 200 * disc, 0.004);
}

TEST(Seeds, LieWhereTheSpecificationPutsThem) {
    const Grid grid{300, 120, Boundary::periodic};
    const double side_x = 1.0 / 10, side_y = 0.4 / 4, jitter = 0.03f, radius = 0.04f;
    const Field field = seeds(grid, LatticeKind::diamond, 0.1f, 0.04f, 0.03f);
    std::size_t wrong = 0, inside_count = 0;
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const double x = (static_cast<double>(i) + 0.5) / 300,
                         y = (static_cast<double>(j) + 0.5) / 300;
            bool inside = false;
            for (int seed = 0; seed < 2 * 12 * 6; ++seed) {
                const int part = seed % 2, a = seed / 2 % 12 - 1, b = seed / 24 - 1;
                const std::uint32_t hash = point_hash(wrapped(a, 10), wrapped(b, 4), 0, some_key,
                                                      static_cast<std::uint32_t>(part));
                const double at = part == 0 ? 0.25 : 0.75;
                const double dx = (a + at) * side_x + fraction(hash) * jitter - x;
                const double dy = (b + at) * side_y + fraction(hash << 16) * jitter - y;
                inside = inside || dx * dx + dy * dy < radius * radius;
            }
            inside_count += inside;
            wrong += inside != (field.at(i, j) == 1);
        }
    }
    EXPECT_LE(wrong, 4u) << "cells on a rim may fall to either side";
    EXPECT_GT(inside_count, 9000u);
}

TEST(Seeds, FillAVolume) {
    const Grid grid{80, 80, Boundary::periodic, 80};
    const double ball = 4.0 / 3 * std::acos(-1.0) * 0.06 * 0.06 * 0.06;
    EXPECT_NEAR(covered(seeds(grid, LatticeKind::square, 0.2f, 0.06f, 0.02f)), 125 * ball, 0.004);
    EXPECT_NEAR(covered(seeds(grid, LatticeKind::diamond, 0.2f, 0.06f, 0.01f)), 250 * ball, 0.008);
}

TEST(Seeds, GoOnAcrossPeriodicSidesOnly) {
    const Field periodic =
        seeds({200, 200, Boundary::periodic}, LatticeKind::square, 0.25f, 0.2f, 0.04f);
    for (std::int64_t k = 0; k < 200; ++k) {
        // Few cells at the side are at the rim of a disc. A seam would affect many cells.
        EXPECT_TRUE(periodic.at(0, k) == 0 || periodic.at(0, k) == 1);
    }
    const Field closed =
        seeds({200, 200, Boundary::no_flux}, LatticeKind::square, 0.3f, 0.05f, 0.0f);
    EXPECT_EQ(closed.at(30, 30), 1) << "the first seed is half a spacing from the sides";
    EXPECT_EQ(closed.at(90, 90), 1) << "a closed side stretches no spacing";
    EXPECT_EQ(closed.at(0, 0), 0);
}

}  // namespace
}  // namespace cascade
