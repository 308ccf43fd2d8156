// How far steps may go through rates that change with time.
#include "run/stage/forcing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace cascade {
namespace {

std::vector<double> over_time(double duration, const std::function<double(double)>& value) {
    std::vector<double> values;
    for (std::size_t n = 0; n <= Forcing::intervals; ++n) {
        values.push_back(value(duration * static_cast<double>(n) / Forcing::intervals));
    }
    return values;
}

TEST(Forcing, ConstantRatesLimitNothing) {
    EXPECT_EQ(Forcing().longest_step(3), std::numeric_limits<double>::infinity());
    const Forcing constant({over_time(10, [](double) { return 4.0; })}, 10);
    EXPECT_EQ(constant.longest_step(3), std::numeric_limits<double>::infinity());
}

TEST(Forcing, StepsEndBeforeAPulseAndAreShortWithinIt) {
    const auto pulse = [](double t) { return std::exp(-std::pow((t - 50) / 0.05, 2)); };
    const Forcing forcing({over_time(100, pulse)}, 100);
    for (double t = 0; t < 49.9;) {
        const double step = forcing.longest_step(t);
        EXPECT_LT(pulse(t + step), 0.35) << t;
        t += step;
    }
    EXPECT_LT(forcing.longest_step(49.96), 0.03);
    EXPECT_GT(forcing.longest_step(60), 4);
}

TEST(Forcing, AJumpIsMetByOneInterval) {
    const Forcing forcing({over_time(100, [](double t) { return t < 30 ? 0.0 : 1.0; })}, 100);
    EXPECT_NEAR(forcing.longest_step(29.995), 0.01, 1e-12);
    EXPECT_LE(29 + forcing.longest_step(29), 30.011);
}

TEST(Forcing, AllPartsCount) {
    const auto slow = over_time(100, [](double t) { return t; });
    const auto fast = over_time(100, [](double t) { return std::sin(10 * t); });
    EXPECT_NEAR(Forcing({slow, fast}, 100).longest_step(10), Forcing({fast}, 100).longest_step(10),
                1e-12);
    EXPECT_GT(Forcing({slow}, 100).longest_step(10), 4.9);
}

TEST(Forcing, ValuesThatAreNoNumbersAreLeftOut) {
    const auto bad = over_time(1, [](double t) { return t > 0.5 ? std::nan("") : 1 / t; });
    EXPECT_GT(Forcing({bad}, 1).longest_step(0.2), 0);
}

}  // namespace
}  // namespace cascade
