// Random numbers of cells: the formula of the specification, and its statistics.
#include "core/floating_point.h"
#include "core/hash.h"
#include "core/plane.h"
#include "ir/builder.h"
#include "ir/draw_of_step.h"
#include "ir/interpreter.h"
#include "tests/unit/ir/space_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace cascade {
namespace {

using test::some_key;

using Expand = ValueId (KernelBuilder::*)(ValueId, std::uint64_t);

template <typename Number>
Plane<Number> random_plane(const Grid& grid, std::uint64_t key, std::int64_t step,
                           Expand expand = &KernelBuilder::random_symmetric) {
    KernelBuilder builder(precision_of<Number>);
    const ValueId draw = builder.draw_word(builder.uniform(builder.uniform_slot("draw")));
    builder.result("r", (builder.*expand)(draw, key));
    const CellKernel kernel = std::move(builder).finish();
    Plane<Number> out{PlaneLayout(grid)};
    Number* results[] = {out.origin()};
    const Number uniforms[] = {draw_uniform<Number>(step)};
    const FlushDenormals environment;
    const KernelPointer compiled = *make_interpreter()->compile(kernel, grid.stencil());
    compiled->run({{}, {}, uniforms, results, out.layout()}, {0, grid.height});
    return out;
}

Field random_field(const Grid& grid, std::uint64_t key, std::int64_t step,
                   Expand expand = &KernelBuilder::random_symmetric) {
    return Field(random_plane<float>(grid, key, step, expand));
}

// Binary64 gives the random numbers of binary32 with more digits: 52 bits.
TEST(RandomNumbers, HaveMoreDigitsInBinary64) {
    const Grid grid{300, 40, Boundary::periodic};
    for (const std::int64_t draw : {0, 1, 27999, 1048575}) {
        const auto plane = random_plane<double>(grid, some_key, draw);
        const auto rough = random_plane<float>(grid, some_key, draw);
        const auto normal =
            random_plane<double>(grid, some_key, draw, &KernelBuilder::random_normal);
        const auto rough_normal =
            random_plane<float>(grid, some_key, draw, &KernelBuilder::random_normal);
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                const std::uint32_t step = to_bits(static_cast<float>(draw));
                const auto hash =
                    pcg4d({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                           step ^ 0x01234567u, 0x89abcdefu});
                const std::uint64_t digits = std::uint64_t{hash[0]} << 20 | hash[1] >> 12;
                const auto exact =
                    static_cast<double>((static_cast<long double>(digits) + 0.5L) * 0x1p-51L - 1);
                ASSERT_EQ(plane.at(i, j), exact) << i << ", " << j;
                ASSERT_NEAR(plane.at(i, j), rough.at(i, j), 0x1p-23);
                // If log(a) is nearly 0, it has few digits in single precision.
                ASSERT_NEAR(normal.at(i, j), rough_normal.at(i, j), 1e-3);
            }
        }
    }
}

template <typename Number>
void expect_new_numbers_late() {
    const Grid grid{64, 1, Boundary::periodic};
    std::set<std::vector<double>> seen;
    int drawn = 0;
    for (const std::int64_t first :
         {std::int64_t{0}, std::int64_t{1} << 23, (std::int64_t{1} << 24) - 50,
          std::int64_t{1} << 27, std::int64_t{1'000'000'000}}) {
        for (std::int64_t step = first; step < first + 100; ++step) {
            const Plane<Number> plane = random_plane<Number>(grid, some_key, step);
            std::vector<double> row(plane.row(0), plane.row(0) + grid.width);
            seen.insert(std::move(row));
            ++drawn;
        }
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(drawn));
}

// From 2^24 on, binary32 numbers are at least 2 apart, but every step still has its own word.
TEST(RandomNumbers, OfLateStepsDiffer) {
    expect_new_numbers_late<float>();
    expect_new_numbers_late<double>();
}

TEST(RandomNumbers, NoTwoStepsAreDrawnByTheSameWord) {
    std::vector<std::uint32_t> words;
    // All steps up to 2^20, and some steps near each higher power of two, where exponents change.
    for (std::int64_t step = 0; step < 1 << 20; ++step) words.push_back(draw_of_step(step));
    for (int bit = 20; bit < 31; ++bit) {
        const std::int64_t power = std::int64_t{1} << bit;
        for (std::int64_t step = power; step < power + 5000; ++step)
            words.push_back(draw_of_step(step));
        for (std::int64_t step = 2 * power - 5000; step < 2 * power; ++step)
            words.push_back(draw_of_step(step));
    }
    std::sort(words.begin(), words.end());
    EXPECT_EQ(std::adjacent_find(words.begin(), words.end()), words.end());
}

TEST(RandomNumbers, AreTheHashOfCellDrawAndKey) {
    const Grid grid{300, 40, Boundary::periodic};
    for (const std::int64_t draw : {0, 1, 27999, 1 << 24, 1'000'000'000}) {
        const Field field = random_field(grid, some_key, draw);
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                const auto column = static_cast<std::uint32_t>(i);
                const auto row = static_cast<std::uint32_t>(j);
                const std::uint32_t word = draw < 1 << 24
                                               ? to_bits(static_cast<float>(draw))
                                               : 0x80000000u + static_cast<std::uint32_t>(draw);
                const auto hash = pcg4d({column, row, word ^ 0x01234567u, 0x89abcdefu});
                const double exact = ((hash[0] >> 9) + 0.5) / 4194304.0 - 1.0;
                ASSERT_EQ(static_cast<double>(field.at(i, j)), exact) << i << ", " << j;
            }
        }
    }
}

TEST(RandomNumbers, AreUniformAndSymmetric) {
    const Grid grid{512, 512, Boundary::periodic};
    const Field field = random_field(grid, some_key, 0);
    const double count = static_cast<double>(grid.cell_count());
    std::vector<double> bins(64);
    double sum = 0, squares = 0;
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const double value = field.at(i, j);
            ASSERT_GT(value, -1);
            ASSERT_LT(value, 1);
            sum += value;
            squares += value * value;
            ++bins[static_cast<std::size_t>((value + 1) * 32)];
        }
    }
    // Mean 0 and variance 1/3, within five standard deviations of their estimates.
    EXPECT_NEAR(sum / count, 0, 5 * std::sqrt(1.0 / 3 / count));
    EXPECT_NEAR(squares / count, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / count));
    // χ² with 63 degrees of freedom has the standard deviation √126.
    double chi_square = 0;
    for (const double bin : bins)
        chi_square += (bin - count / 64) * (bin - count / 64) * 64 / count;
    EXPECT_NEAR(chi_square, 63, 5 * std::sqrt(126.0));
}

/// Correlation of two fields, the second shifted by (di, dj) across periodic sides.
double correlation(const Field& a, const Field& b, std::int64_t di, std::int64_t dj) {
    const PlaneLayout& layout = a.layout();
    double sum = 0;
    for (std::int64_t j = 0; j < layout.height; ++j) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            sum += static_cast<double>(a.at(i, j)) *
                   b.at((i + di) % layout.width, (j + dj) % layout.height);
        }
    }
    return sum * 3 / static_cast<double>(layout.width * layout.height);
}

TEST(RandomNumbers, NeighboursAreIndependent) {
    const Grid grid{256, 256, Boundary::periodic};
    const Field field = random_field(grid, some_key, 0);
    const double limit = 5.0 / 256;  // Five standard deviations.
    for (std::int64_t dj = 0; dj <= 2; ++dj) {
        for (std::int64_t di = 0; di <= 2; ++di) {
            if (di == 0 && dj == 0) continue;
            EXPECT_LT(std::fabs(correlation(field, field, di, dj)), limit) << di << ", " << dj;
        }
    }
}

TEST(RandomNumbers, StepsAndKeysAreIndependent) {
    const Grid grid{128, 128, Boundary::periodic};
    const double limit = 5.0 / 128;
    Field before = random_field(grid, some_key, 0);
    for (int step = 1; step <= 40; ++step) {
        Field now = random_field(grid, some_key, step);
        EXPECT_LT(std::fabs(correlation(before, now, 0, 0)), limit) << "step " << step;
        before = std::move(now);
    }
    const Field original = random_field(grid, some_key, 0);
    for (int bit = 0; bit < 62; ++bit) {
        if (bit == 30 || bit == 31) continue;  // See the test of pcg4d.
        const Field other = random_field(grid, some_key ^ (1ULL << bit), 0);
        EXPECT_LT(std::fabs(correlation(original, other, 0, 0)), limit) << "bit " << bit;
    }
}

TEST(RandomNumbers, NormalOnesAreTheFormulaOfBoxAndMuller) {
    const Grid grid{300, 40, Boundary::periodic};
    const Field field = random_field(grid, some_key, 5, &KernelBuilder::random_normal);
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const auto hash = pcg4d({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                                     to_bits(5.0f) ^ 0x01234567u, 0x89abcdefu});
            const double a = ((hash[0] >> 1) + 0.5) * 0x1p-31;
            const double b = static_cast<std::int32_t>(hash[1]) * 0x1p-32;
            const double exact = std::sqrt(-2 * std::log(a)) * std::cos(2 * std::acos(-1.0) * b);
            ASSERT_NEAR(field.at(i, j), exact, 3e-6) << i << ", " << j;
        }
    }
}

TEST(RandomNumbers, NormalOnesAreNormal) {
    const Grid grid{1024, 1024, Boundary::periodic};
    const Field field = random_field(grid, some_key, 0, &KernelBuilder::random_normal);
    const double count = static_cast<double>(grid.cell_count());
    double sum = 0, squares = 0, fourth = 0, largest = 0;
    std::vector<double> bins(40);  // Bins of 0.2 from −4 to 4. The outer bins contain the tails.
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const double value = field.at(i, j);
            sum += value;
            squares += value * value;
            fourth += value * value * value * value;
            largest = std::max(largest, std::fabs(value));
            ++bins[static_cast<std::size_t>(std::clamp(std::floor(value * 5) + 20, 0.0, 39.0))];
        }
    }
    // The mean is 0, the mean square 1 and the mean fourth power 3, within five standard deviations
    // of their estimates.
    EXPECT_NEAR(sum / count, 0, 5 / std::sqrt(count));
    EXPECT_NEAR(squares / count, 1, 5 * std::sqrt(2 / count));
    EXPECT_NEAR(fourth / count, 3, 5 * std::sqrt(96 / count));
    EXPECT_GT(largest, 4.4);
    EXPECT_LT(largest, 6.7);
    const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
    double chi_square = 0;
    for (std::size_t k = 0; k < bins.size(); ++k) {
        const double low = k == 0 ? 0 : below(static_cast<double>(k) * 0.2 - 4);
        const double high = k == 39 ? 1 : below(static_cast<double>(k) * 0.2 - 3.8);
        const double expected = (high - low) * count;
        chi_square += (bins[k] - expected) * (bins[k] - expected) / expected;
    }
    EXPECT_NEAR(chi_square, 39, 5 * std::sqrt(78.0));
}

TEST(RandomNumbers, ALargerGridBeginsWithTheSameValues) {
    const Field small = random_field({20, 10, Boundary::periodic}, some_key, 3);
    const Field large = random_field({500, 30, Boundary::no_flux}, some_key, 3);
    for (std::int64_t j = 0; j < 10; ++j) {
        for (std::int64_t i = 0; i < 20; ++i) ASSERT_EQ(small.at(i, j), large.at(i, j));
    }
}

}  // namespace
}  // namespace cascade
