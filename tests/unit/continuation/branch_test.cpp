// Branches compared with closed forms: folds, branch points and Hopf points of known systems.
#include "tests/unit/continuation/steady_script.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Branches, OfSymmetricStatesEndAtBranchPointsNotFolds) {
    // The branch u² = (1 + √(1 + 4p)) / 2 turns back at the fold p = −1/4, and then, where it meets
    // u = 0, at the branch point p = 0.
    SteadyScript script(
        "system s { u: 1.05; p: 0.1; u' = p * u + u^3 - u^5 + 9 * lap(u) }\n"
        "domain { grid: 8, 1; boundary: noflux; precision: double }\nstage a: s { }");
    const auto branches = followed(script, -0.6, 0.3);
    ASSERT_EQ(branches.size(), 1U);
    const auto meetings = special(branches[0], PointKind::branch);
    ASSERT_EQ(meetings.size(), 1U);
    EXPECT_NEAR(meetings[0].place.parameter, 0, 1e-8);
    EXPECT_FALSE(meetings[0].vanishes) << "these states are uniform, too";
    const auto folds = special(branches[0], PointKind::fold);
    ASSERT_EQ(folds.size(), 2U) << "of u and of -u";
    for (const Point& fold : folds) EXPECT_NEAR(fold.place.parameter, -0.25, 1e-9);
}

TEST(Branches, OfPatternsEndWhereThePatternVanishes) {
    // The waves of Swift and Hohenberg's equation meet u = 0 at p = (1 + lap)², on rings and
    // between sides. From there, the uniform states are followed in both directions.
    const double meeting = std::pow(1 + laplacian(1, 2 * std::numbers::pi / 16), 2);
    for (const std::string sides : {"periodic", "noflux"}) {
        SteadyScript script(
            "system s { u: 0.36 * cos(4 * pi * (x + 1/64)); p: 0.1\n"
            "u' = p * u - (u + 2 * lap(u) + lap(lap(u))) - u^3 }\n"
            "domain { grid: 32, 1; spacing: pi / 8; precision: double; boundary: " +
            sides +
            " }\n"
            "stage a: s { }");
        const auto branches = followed(script, -0.2, 0.2, 3);
        ASSERT_EQ(branches.size(), 3U) << sides;
        EXPECT_TRUE(special(branches[0], PointKind::fold).empty());
        const auto meetings = special(branches[0], PointKind::branch);
        ASSERT_GE(meetings.size(), 1U);
        const auto vanishes = [](const Point& point) { return point.vanishes; };
        ASSERT_EQ(std::ranges::count_if(meetings, vanishes), 1) << sides;
        const Point& end = *std::ranges::find_if(meetings, vanishes);
        EXPECT_NEAR(end.place.parameter, meeting, 1e-7);
        EXPECT_TRUE(branches[0].begins == "the pattern vanishes" ||
                    branches[0].ends == "the pattern vanishes");
        for (std::size_t k = 1; k < 3; ++k) {
            for (const Point& point : branches[k].points) {
                EXPECT_LT(point.place.state.cwiseAbs().maxCoeff(), 1e-9);
            }
        }
    }
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
    // Waves begin to oscillate later, each where its trace b − 1 − a² + 2 lap is 0.
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

TEST(Branches, OfLightInRingsHaveTheThresholdsOfCombs) {
    // L. A. Lugiato and R. Lefever's equation, E' = −(1 + iθ) E + i E_xx + i |E|² E + F, with E = u
    // + iv and p = F². The flat states have F² = I (1 + (I − θ)²), where I = |E|². For θ > √3 they
    // turn back at I = (2θ ± √(θ² − 3)) / 3, and the wave k begins to grow where 3I² − 4aI + a² + 1
    // = 0 with a = θ + k². The first combs grow at I = 1.
    for (const auto& [theta, length] : {std::pair(1.2, 10.0), std::pair(2.0, 6.0)}) {
        SteadyScript script(fmt::format(
            "system s {{ u: 0.4; v: 0.1; p: 0.4; theta: {}\n"
            "u' = -u + theta * v - lap(v) - v * (u^2 + v^2) + sqrt(p)\n"
            "v' = -theta * u - v + lap(u) + u * (u^2 + v^2) }}\n"
            "domain {{ grid: 24, 1; extent: {}; boundary: noflux; precision: double }}\nstage a: s {{ }}",
            theta, length));
        const auto branches = followed(script, 0.2, 6, 1, 0.01);
        ASSERT_EQ(branches.size(), 1U);
        const auto folds = special(branches[0], PointKind::fold);
        ASSERT_EQ(folds.size(), theta > std::sqrt(3) ? 2U : 0U);
        const auto pump = [&](double power) { return power * (1 + std::pow(power - theta, 2)); };
        for (std::size_t k = 0; k < folds.size(); ++k) {
            const double root = std::sqrt(theta * theta - 3) * (k == 0 ? -1 : 1);
            EXPECT_NEAR(folds[k].place.parameter, pump((2 * theta + root) / 3), 1e-7);
        }
        int thresholds = 0;
        double first = 10;
        for (int wave = 1; wave < 24; ++wave) {
            const double a = theta - laplacian(std::numbers::pi * wave / length, length / 24);
            if (a * a < 3) continue;
            for (const double sign : {-1.0, 1.0}) {
                const double power = (2 * a + sign * std::sqrt(a * a - 3)) / 3, at = pump(power);
                if (at > 6 || at < 0.2) continue;
                ++thresholds;
                first = std::min(first, power);
                double nearest = 1;
                for (const Point& point : special(branches[0], PointKind::branch)) {
                    const double own = point.place.state.squaredNorm() / 24;
                    const double distance = std::abs(point.place.parameter - at);
                    nearest = std::min(nearest, distance + std::abs(own - power));
                }
                EXPECT_LT(nearest, 1e-6) << wave << ", " << power;
            }
        }
        EXPECT_GE(thresholds, 3);
        EXPECT_GE(first, 1);
        EXPECT_LT(first, 1.1) << "a wave of this ring is near the best";
    }
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
