// Branches compared with closed forms: folds, branch points and Hopf points of known systems.
#include "tests/unit/continuation/steady_script.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace cascade::test {
namespace {

using continuation::Branch;
using continuation::Point;
using continuation::PointKind;

/// Follows the states of a script from its starting values.
std::vector<Branch> followed(SteadyScript& script, double low, double high,
                             std::size_t branches = 1, double step = 0.05) {
    const Vector state = script.state();
    const auto size = static_cast<double>(state.size());
    continuation::Scales scales{Vector::Constant(state.size(), 1 / size),
                                1 / std::pow(high - low, 2)};
    continuation::Corrector corrector(script.problem(), scales);
    corrector.keep_totals(script.problem().conserved_near(state, script.parameter()));
    const auto start =
        corrector.solve({state, script.parameter()}, {Vector::Zero(state.size()), 1});
    EXPECT_TRUE(start);
    if (!start) return {};
    continuation::FollowSettings settings;
    settings.low = low;
    settings.high = high;
    settings.step = step;
    settings.most_branches = branches;
    return continuation::Follower(corrector, settings).follow(*start);
}

std::vector<Point> special(const Branch& branch, PointKind kind) {
    std::vector<Point> found;
    for (const Point& point : branch.points) {
        if (point.kind == kind) found.push_back(point);
    }
    return found;
}

/// −4 sin²(θ/2) / h², the symbol of lap for the wave number k.
double laplacian(double k, double h) { return -4 * std::pow(std::sin(k * h / 2), 2) / (h * h); }

TEST(Branches, TurnBackAtAFold) {
    // Steady states are u = ±√p. On the lower branch waves grow where 2√p exceeds −lap.
    SteadyScript script(
        "system s { u: 0.8; p: 0.64; u' = p - u^2 + lap(u) }\n"
        "domain { grid: 12, 1; boundary: noflux; precision: double }\nstage a: s { }");
    const auto branches = followed(script, -0.5, 1);
    ASSERT_EQ(branches.size(), 1U);
    const auto folds = special(branches[0], PointKind::fold);
    ASSERT_EQ(folds.size(), 1U);
    EXPECT_NEAR(folds[0].place.parameter, 0, 1e-9);
    EXPECT_NEAR(branches[0].points.front().place.parameter, 1, 1e-6);
    EXPECT_NEAR(branches[0].points.back().place.parameter, 1, 1e-6);
    for (const Point& point : branches[0].points) {
        const double u = point.place.state[0];
        EXPECT_NEAR(u * u, point.place.parameter, 1e-9);
        int growing = 0;
        double nearest = 1;
        for (int wave = 0; wave < 12; ++wave) {
            const double rate = -2 * u + laplacian(std::numbers::pi * wave / 12, 1);
            growing += rate > 0 ? 1 : 0;
            nearest = std::min(nearest, std::abs(rate));
        }
        if (nearest < 1e-6) continue;
        EXPECT_EQ(point.growing, growing) << u;
    }
    const auto meetings = special(branches[0], PointKind::branch);
    ASSERT_FALSE(meetings.empty());
    for (const Point& point : meetings) {
        double nearest = 1;
        for (int wave = 1; wave < 12; ++wave) {
            const double u = laplacian(std::numbers::pi * wave / 12, 1) / 2;
            nearest = std::min(nearest, std::abs(point.place.parameter - u * u));
        }
        EXPECT_LT(nearest, 1e-7);
    }
}

TEST(Branches, MeetAtPitchforks) {
    // u = 0 loses its stability at p = 0. On the other branch u² = (1 ± √(1 + 4p)) / 2, which turns
    // back at p = −1/4.
    SteadyScript script(
        "system s { u: 0; p: -0.5; u' = p * u + u^3 - u^5 + 9 * lap(u) }\n"
        "domain { grid: 8, 1; boundary: noflux; precision: double }\nstage a: s { }");
    const auto branches = followed(script, -0.6, 0.3, 5);
    ASSERT_EQ(branches.size(), 2U) << "the branches u and -u are one";
    const auto meetings = special(branches[0], PointKind::branch);
    ASSERT_EQ(meetings.size(), 1U);
    EXPECT_NEAR(meetings[0].place.parameter, 0, 1e-8);
    EXPECT_EQ(meetings[0].crossing, 1);
    const auto folds = special(branches[1], PointKind::fold);
    ASSERT_EQ(folds.size(), 1U);
    EXPECT_NEAR(folds[0].place.parameter, -0.25, 1e-9);
    EXPECT_NEAR(std::abs(folds[0].place.state[0]), std::sqrt(0.5), 1e-4);
    EXPECT_EQ(branches[1].points.front().growing, 1);
    EXPECT_EQ(branches[1].points.back().growing, 0);
    EXPECT_EQ(branches[0].points.front().growing, 0);
    EXPECT_EQ(branches[0].points.back().growing, 1);
}

TEST(Branches, BeginToOscillateAtHopfPoints) {
    // The Brusselator oscillates from b = 1 + a² on, and with equal diffusion no wave grows before.
    SteadyScript script(
        "system s { u: 1.3; v: 1.2; a: 1.3; p: 1.56\n"
        "u' = a - (p + 1) * u + u^2 * v + lap(u); v' = p * u - u^2 * v + lap(v) }\n"
        "domain { grid: 90, 1; boundary: noflux; spacing: 0.5; precision: double }\nstage a: s { }");
    const auto branches = followed(script, 1.2, 2.72);
    ASSERT_EQ(branches.size(), 1U);
    const auto hopf = special(branches[0], PointKind::hopf);
    ASSERT_GE(hopf.size(), 2U);
    EXPECT_NEAR(hopf[0].place.parameter, 1 + 1.3 * 1.3, 1e-7);
    EXPECT_NEAR(std::abs(hopf[0].leading[0].imag()), 1.3, 1e-6);
    EXPECT_EQ(hopf[0].crossing, 2);
    // Waves follow, each where its trace b − 1 − a² + 2 lap is 0.
    EXPECT_NEAR(hopf[1].place.parameter, 1 + 1.3 * 1.3 - 2 * laplacian(std::numbers::pi / 45, 0.5),
                1e-7);
}

TEST(Branches, OfPatternsDoNotCountTheirTranslations) {
    // Swift and Hohenberg's equation on a ring of two waves. The grid moves the point at which the
    // waves begin to grow from p = 0 to (1 + lap)².
    const double h = 2 * std::numbers::pi / 16;
    SteadyScript script(
        "system s { u: 0; p: -0.2; u' = p * u - (u + 2 * lap(u) + lap(lap(u))) - u^3 }\n"
        "domain { grid: 32, 1; spacing: pi / 8; precision: double }\nstage a: s { }");
    const auto branches = followed(script, -0.3, 0.2, 2);
    ASSERT_EQ(branches.size(), 2U);
    const auto meetings = special(branches[0], PointKind::branch);
    ASSERT_GE(meetings.size(), 1U);
    EXPECT_NEAR(meetings[0].place.parameter, std::pow(1 + laplacian(1, h), 2), 1e-8);
    EXPECT_EQ(meetings[0].crossing, 2) << "a sine and a cosine";
    // The pattern is stable, though a translation costs nothing. Its amplitude is √(4p/3).
    const Point& last = branches[1].points.back();
    EXPECT_EQ(last.growing, 0);
    EXPECT_LT(last.leading[0].real(), -1e-3);
    const double above = last.place.parameter - meetings[0].place.parameter;
    EXPECT_NEAR(last.place.state.maxCoeff(), std::sqrt(4 * above / 3), 0.01);
}

TEST(Branches, CountEigenvaluesThatOccurSeveralTimes) {
    // On a square ring the waves along x and y, and sines and cosines, grow together.
    SteadyScript script(
        "system s { u: 0; p: -0.05; u' = p * u - u^3 + lap(u) }\n"
        "domain { grid: 20, 20; precision: double }\nstage a: s { }");
    const auto branches = followed(script, -0.1, 0.21);
    ASSERT_EQ(branches.size(), 1U);
    const auto meetings = special(branches[0], PointKind::branch);
    const double wave = -laplacian(2 * std::numbers::pi / 20, 1);
    const auto passing_at = [&](double parameter) {
        int passing = 0;
        for (const Point& point : meetings) {
            const bool is_here = std::abs(point.place.parameter - parameter) < 1e-6;
            passing += is_here ? point.crossing : 0;
        }
        return passing;
    };
    EXPECT_EQ(passing_at(0), 1);
    EXPECT_EQ(passing_at(wave), 4);
    EXPECT_EQ(passing_at(2 * wave), 4);
    EXPECT_TRUE(special(branches[0], PointKind::hopf).empty());
    EXPECT_EQ(branches[0].points.back().growing, 9);
}

TEST(Branches, KeepTotalsThatNoRateChanges) {
    // Cahn and Hilliard's equation on half a wave: the mean 0 loses its stability where p = −lap.
    SteadyScript script(
        "system s { u: 0; p: 0.05; u' = lap(u^3 - p * u - lap(u)) }\n"
        "domain { grid: 16, 1; boundary: noflux; spacing: 0.5; precision: double }\nstage a: s { }");
    const auto branches = followed(script, 0, 0.3, 2);
    ASSERT_EQ(branches.size(), 2U);
    const auto meetings = special(branches[0], PointKind::branch);
    ASSERT_EQ(meetings.size(), 1U);
    EXPECT_NEAR(meetings[0].place.parameter, -laplacian(std::numbers::pi / 8, 0.5), 1e-8);
    for (const Point& point : branches[1].points) EXPECT_NEAR(point.place.state.mean(), 0, 1e-12);
    EXPECT_EQ(branches[1].points.back().growing, 0);
}

}  // namespace
}  // namespace cascade::test
