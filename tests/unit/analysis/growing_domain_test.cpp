// The waves that grow in a growing domain, for an equation whose growing waves are known.
#include "analysis/growing_domain.h"
#include "tests/unit/analysis/closed_forms.h"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace cascade::test {
namespace {

/// Waves of Swift and Hohenberg's equation grow if |k² − 1| < √r.
TEST(GrowingDomain, CountsTheWavesThatFit) {
    const double r = 0.09;
    for (const char* boundary : {"noflux", "periodic"}) {
        const auto analysed = analyse(fmt::format(
            "system sh {{ u: 0; u' = {} * u - (u + 2*lap(u) + lap(lap(u))) - u^3; undiluted: u }}\n"
            "domain {{ grid: 512; extent: 20 * (1 + 0.01 * t); boundary: {}; precision: double }}\n"
            "stage s: sh {{ duration: 400 }}\n",
            r, boundary));
        std::string expected = "\nas the domain grows\n";
        const bool is_noflux = std::string_view(boundary) == "noflux";
        for (const double t : {0.0, 100.0, 200.0, 300.0, 400.0}) {
            const double length = 20 * (1 + 0.01 * t);
            const double unit = (is_noflux ? 1 : 2) * std::numbers::pi / length;
            const double least = std::ceil(std::sqrt(1 - std::sqrt(r)) / unit);
            const double most = std::floor(std::sqrt(1 + std::sqrt(r)) / unit);
            const std::string waves = is_noflux ? "half wave" : "wave";
            expected += fmt::format("  {:<20}{:.4g}: ", fmt::format("t = {:.4g}", t), length);
            expected += least == most ? fmt::format("{} {}s grow along x\n", most, waves)
                                      : fmt::format("{} to {} {}s grow along x, {:.0f} fastest\n",
                                                    least, most, waves, std::round(1 / unit));
        }
        EXPECT_EQ(analysis::waves_of_growing_domain(*analysed.script->program, 0), expected);
    }
}

/// On a sphere of radius R, spherical harmonics of degree l have k² = l (l + 1) / R².
TEST(GrowingDomain, CountsHarmonicsOfAGrowingSphere) {
    const double r = 0.09;
    const auto analysed = analyse(
        "system sh { u: 0; u' = 0.09 * u - (u + 2*lap(u) + lap(lap(u))) - u^3; undiluted: u }\n"
        "domain { surface: sphere; cells: 20000; extent: 20 * (1 + 0.01 * t); precision: double }\n"
        "stage s: sh { duration: 400 }\n");
    const auto moments = analysis::moments_of_growing_domain(*analysed.script->program, 0);
    ASSERT_EQ(moments.size(), 5u);
    for (const analysis::GrowingMoment& moment : moments) {
        const double radius = 10 * (1 + 0.01 * moment.t);
        const auto grows = [&](double l) {
            return std::abs(l * (l + 1) / (radius * radius) - 1) < std::sqrt(r);
        };
        ASSERT_TRUE(moment.waves) << moment.t;
        EXPECT_EQ(moment.lengths, std::vector<double>{2 * radius});
        EXPECT_TRUE(grows(moment.waves->least) && !grows(moment.waves->least - 1)) << moment.t;
        EXPECT_TRUE(grows(moment.waves->most) && !grows(moment.waves->most + 1)) << moment.t;
        EXPECT_EQ(moment.waves->fastest, std::round(std::sqrt(radius * radius + 0.25) - 0.5));
    }
}

/// On any other model the lengths of growing waves stay the same.
TEST(GrowingDomain, GivesLengthsOfWavesOnAGrowingModel) {
    const auto analysed = analyse(
        "system sh { u: 0; u' = 0.09 * u - (u + 2*lap(u) + lap(lap(u))) - u^3; undiluted: u }\n"
        "domain { surface: creature; cells: 20000; extent: 20 * exp(0.01 * t) }\n"
        "stage s: sh { duration: 100 }\n");
    const auto moments = analysis::moments_of_growing_domain(*analysed.script->program, 0);
    ASSERT_EQ(moments.size(), 5u);
    for (const analysis::GrowingMoment& moment : moments) {
        ASSERT_TRUE(moment.waves) << moment.t;
        EXPECT_NEAR(moment.waves->least, 2 * std::numbers::pi / std::sqrt(1.3), 0.02);
        EXPECT_NEAR(moment.waves->most, 2 * std::numbers::pi / std::sqrt(0.7), 0.02);
        EXPECT_NEAR(moment.waves->fastest, 2 * std::numbers::pi, 0.02);
    }
    EXPECT_THAT(analysis::waves_of_growing_domain(*analysed.script->program, 0),
                ::testing::HasSubstr("waves from 5.511 to 7.51 long grow, 6.283 fastest"));
}

}  // namespace
}  // namespace cascade::test
