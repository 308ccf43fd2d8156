// Lengths of the domain and integrals in runs, compared with closed forms, on grids of any size.
#include "unit/run/ran_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace cascade {
namespace {

/// On a domain of 3 × 1.5, a mode decays at the rate of its wavelength in units, and w grows by
/// the integral of a Gaussian, which is π s² up to its tails.
constexpr const char* lengths_of_domain = R"(
let k = 2 * pi / domain.width
system s {
  u: cos(k * domain.x)
  v: exp(-((domain.x - 1.5)^2 + (domain.y - 0.75)^2) / (2 * 0.01))
  w: 0
  u' = lap(u)
  v' = 0
  w' = integral(v over domain)
}
domain { grid: 32, 16; extent: 3, 1.5; precision: double }
stage a: s { solver: rk4; speed: 0.1 * domain.spacing^2; duration: 0.1 }
)";

TEST(DomainLengthsInRuns, AgreeWithTheoryOnAnyGrid) {
    std::vector<double> errors;
    for (const std::int64_t columns : {32, 64, 128}) {
        Overrides overrides;
        overrides.grid = GridSize{columns, columns / 2, 1};
        const Ran ran = run_text(lengths_of_domain, {"interp", 0, 1}, overrides);
        ASSERT_EQ(ran.failure, "");
        const double h = 3.0 / static_cast<double>(columns);
        EXPECT_DOUBLE_EQ(ran.simulation->domain().grid.spacing, h);
        const double rate = std::pow(2 * std::numbers::pi / 3, 2);
        const double first = std::cos(2 * std::numbers::pi / 3 * h / 2);
        const double decayed = ran.species(0).number_at(0, 0) / first;
        errors.push_back(std::abs(decayed - std::exp(-rate * 0.1)));
        EXPECT_NEAR(ran.species(2).number_at(0, 0), 0.1 * 2 * std::numbers::pi * 0.01, 1e-7);
    }
    // The errors are of second order in the spacing.
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.2);
    EXPECT_NEAR(errors[1] / errors[2], 4, 0.1);
}

TEST(DomainLengthsInRuns, InterpreterAndNativeCodeAgree) {
    const Ran interpreted = run_text(lengths_of_domain);
    const Ran native = run_text(lengths_of_domain, {"jit", 0, 2});
    ASSERT_TRUE(interpreted.simulation && native.simulation);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::int64_t x = 0; x < 32; ++x) {
            EXPECT_EQ(interpreted.species(k).number_at(x, 5), native.species(k).number_at(x, 5));
        }
    }
}

}  // namespace
}  // namespace cascade
