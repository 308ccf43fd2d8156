// The waves that grow in a growing domain, for an equation whose growing waves are known.
#include "analysis/growing_domain.h"
#include "tests/unit/analysis/closed_forms.h"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

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

}  // namespace
}  // namespace cascade::test
