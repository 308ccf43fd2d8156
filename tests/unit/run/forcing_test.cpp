// How long steps may be where rates change with time.
#include "run/stage/forcing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

namespace cascade {
namespace {

Forcing by(double duration, std::initializer_list<ValueAt> parts) {
    Forcing forcing(duration);
    for (const ValueAt& part : parts) forcing.add(values_over(duration, part));
    return forcing;
}

TEST(Forcing, ConstantRatesLimitNothing) {
    EXPECT_EQ(Forcing().longest_step(3), std::numeric_limits<double>::infinity());
    const Forcing constant = by(10, {[](double) { return 4.0; }});
    EXPECT_EQ(constant.longest_step(3), std::numeric_limits<double>::infinity());
}

TEST(Forcing, StepsEndBeforeAPulseAndAreShortWithinIt) {
    const auto pulse = [](double t) { return std::exp(-std::pow((t - 50) / 0.05, 2)); };
    const Forcing forcing = by(100, {pulse});
    for (double t = 0; t < 49.9;) {
        const double step = forcing.longest_step(t);
        EXPECT_LT(pulse(t + step), 0.35) << t;
        t += step;
    }
    EXPECT_LT(forcing.longest_step(49.96), 0.03);
    EXPECT_GT(forcing.longest_step(60), 4);
}

TEST(Forcing, AJumpIsMetByOneInterval) {
    const Forcing forcing = by(100, {[](double t) { return t < 30 ? 0.0 : 1.0; }});
    EXPECT_NEAR(forcing.longest_step(29.995), 0.01, 1e-12);
    EXPECT_LE(29 + forcing.longest_step(29), 30.011);
}

TEST(Forcing, AllPartsCount) {
    const ValueAt slow = [](double t) { return t; };
    const ValueAt fast = [](double t) { return std::sin(10 * t); };
    EXPECT_NEAR(by(100, {slow, fast}).longest_step(10), by(100, {fast}).longest_step(10), 1e-12);
    EXPECT_GT(by(100, {slow}).longest_step(10), 4.9);
}

TEST(Forcing, ValuesThatAreNoNumbersAreLeftOut) {
    const ValueAt bad = [](double t) { return t > 0.5 ? std::nan("") : 1 / t; };
    EXPECT_GT(by(1, {bad}).longest_step(0.2), 0);
}

std::vector<Jump> jumps_of(double duration, const ValueAt& part) {
    return find_jumps(values_over(duration, part), duration, part);
}

TEST(Forcing, JumpsAreFoundToTheLastDigit) {
    const auto jumps = jumps_of(22, [](double t) { return std::fmod(t, 10) < 5 ? 1.0 : 0.0; });
    ASSERT_EQ(jumps.size(), 4u);
    for (std::size_t k = 0; k < jumps.size(); ++k) {
        const double at = 5.0 * static_cast<double>(k + 1);
        EXPECT_EQ(jumps[k].after, at);
        EXPECT_EQ(jumps[k].before, std::nextafter(at, 0));
    }
    EXPECT_EQ(jumps_of(100, [](double t) { return t < 20 ? 0.0 : t < 60 ? 1.0 : 1.2; }).size(), 2u);
}

TEST(Forcing, WhatIsSteepDoesNotJump) {
    EXPECT_TRUE(jumps_of(100, [](double t) { return std::tanh(1e6 * (t - 31.4)); }).empty());
    EXPECT_TRUE(jumps_of(100, [](double t) { return std::sin(t) + t; }).empty());
    EXPECT_TRUE(
        jumps_of(100, [](double t) { return std::exp(-1e4 * std::pow(t - 50, 2)); }).empty());
    EXPECT_TRUE(jumps_of(100, [](double) { return 4.0; }).empty());
}

TEST(Forcing, AStepEndsAtAJumpAndTheNextBeginsAfterIt) {
    const ValueAt part = [](double t) { return t < 30 ? 0.0 : 1.0; };
    Forcing forcing = by(100, {part});
    forcing.add_jumps(jumps_of(100, part));
    const double t = 29.995, end = t + forcing.longest_step(t);
    EXPECT_LT(end, 30);
    EXPECT_NEAR(end, 30, 1e-10);
    EXPECT_EQ(forcing.time_after(end), 30);
    EXPECT_EQ(forcing.time_after(t), t);
    EXPECT_EQ(forcing.time_after(30), 30);
    EXPECT_GT(forcing.longest_step(30), 10);
}

TEST(Forcing, WhatMovesLimitsStepsWhileItMoves) {
    std::vector<double> changes(1000, 0.0);
    for (std::size_t m = 400; m < 600; ++m) changes[m] = 0.06;
    Forcing forcing(100);
    forcing.add_motion(changes);
    EXPECT_NEAR(forcing.longest_step(50), 0.5, 0.02);
    EXPECT_NEAR(30 + forcing.longest_step(30), 40.4, 0.2);
    EXPECT_NEAR(forcing.longest_step(70), 25, 0.02);
}

}  // namespace
}  // namespace cascade
