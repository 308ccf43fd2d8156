// Runs that go on in finer cells keep their pattern, their lengths and their noise.
#include "detailed_simulations.h"

#include "core/resample.h"
#include "run/domain/domain_mask.h"
#include "tests/support/mean_of.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace cascade::test {
namespace {

using Runs = DetailedSimulations;

/// The fraction of the values above the middle of their range.
double part_above_middle(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double middle = (*low + *high) / 2;
    const auto above =
        std::count_if(values.begin(), values.end(), [&](double value) { return value > middle; });
    return static_cast<double>(above) / static_cast<double>(values.size());
}

double wavelength_of(const Simulation& of, const Field& field) {
    return measure::peak_wavelength(measure::radial_spectrum(Runs::samples(of, field)));
}

bool have_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

TEST(FinerCells, APatternKeepsItsStatistics) {
    const Runs runs(
        "stage spots: turing_spots { iterations: 6000; ka: 1/60 }\n"
        "domain { grid: 64, 48; seed: 3 }",
        2, compiled());
    ASSERT_TRUE(runs.finer);
    EXPECT_EQ(runs.finer->domain().grid, (Grid{.width = 128, .height = 96, .spacing = 0.5}));
    const Field& coarse = runs.field(*runs.coarse, "b");
    const Field& finer = runs.field(*runs.finer, "b");
    EXPECT_NEAR(wavelength_of(*runs.finer, finer) / wavelength_of(*runs.coarse, coarse), 1, 0.03);
    const auto before = Runs::numbers(*runs.coarse, coarse);
    const auto after = Runs::numbers(*runs.finer, finer);
    EXPECT_NEAR(mean_of(after) / mean_of(before), 1, 0.02);
    EXPECT_NEAR(part_above_middle(after), part_above_middle(before), 0.02);
    EXPECT_NEAR(runs.finer->state(0).t, 6600, 0.01);
}

TEST(FinerCells, ResultsDependNeitherOnCodeNorOnThreads) {
    const std::string text =
        "stage large: turing_spots { iterations: 300; ka: 1/60 }\n"
        "stage small: turing_spots { iterations: 100; ka: 1/20; frozen: b < 4; a: a; b: b; "
        "beta: beta }\ndomain { grid: 40, 24 }";
    const Runs one(text, 3), two(text, 3, interpreted(3)), three(text, 3, compiled());
    ASSERT_TRUE(one.finer && two.finer && three.finer);
    for (const std::string name : {"a", "b"}) {
        const auto of = [&](const Runs& runs) {
            return Runs::numbers(*runs.finer, runs.field(*runs.finer, name, 1));
        };
        EXPECT_TRUE(have_same_bits(of(one), of(two))) << name;
        EXPECT_TRUE(have_same_bits(of(one), of(three))) << name;
    }
}

/// Expects that a wave along each axis decays by diffusion as exp(−rate t).
void expect_decay(const std::string& start, double rate, const std::string& domain) {
    const Runs runs("system heat {\n  u: " + start + "\n  u' = lap(u)\n}\ndomain { " + domain +
                    " }\nstage one: heat { iterations: 100; speed: 0.1 * domain.spacing^2 }");
    ASSERT_TRUE(runs.finer);
    const double t = runs.finer->state(0).t;
    EXPECT_NEAR(t, 1.1 * runs.coarse->state(0).t, 1e-6 * t) << domain;
    const auto values = Runs::numbers(*runs.finer, runs.field(*runs.finer, "u"));
    EXPECT_NEAR(*std::max_element(values.begin(), values.end()), std::exp(-rate * t), 0.01)
        << domain;
}

TEST(FinerCells, DerivativesMeanTheSameInLengths) {
    const auto wave = [](double length) { return std::pow(2 * std::numbers::pi / length, 2); };
    expect_decay("cos(2 * pi * sx)", wave(32), "grid: 32, 24");
    expect_decay("cos(2 * pi * sx)", wave(4), "grid: 32, 24; extent: 4");
    expect_decay("cos(2 * pi * sx)", wave(32), "grid: 32");
    expect_decay("cos(2 * pi * sz)", wave(8), "grid: 6, 4, 16; spacing: 0.5");
    expect_decay("cos(2 * pi * sy)", wave(24), "grid: 1, 24");
}

TEST(FinerCells, IntegralsAndMeansStay) {
    const Runs runs(
        "system s {\n  u: 1\n  m: 0\n  k: integral(1 over domain)\n"
        "  u' = 0\n  m' = integral(u over domain) - 20\n}\n"
        "domain { grid: 20, 10; extent: 10, 5 }\n"
        "stage one: s { iterations: 10; speed: 0.1 }");
    ASSERT_TRUE(runs.finer);
    EXPECT_NEAR(runs.finer->state(0).numbers[Runs::item(*runs.finer, "k")], 50, 1e-3);
    EXPECT_NEAR(runs.field(*runs.finer, "m").number_at(3, 4), 1.1 * 30, 1e-3);
}

TEST(FinerCells, WhatWasDrawnInEachCellIsCarried) {
    const Runs runs(
        "system s {\n  u: 0\n  p: random(1, 0.5)\n  q: 2 * p\n  n: noise(0.3)\n"
        "  u' = p - u\n}\ndomain { grid: 16, 12 }\nstage one: s { iterations: 3 }");
    ASSERT_TRUE(runs.finer);
    for (const std::string name : {"p", "q"}) {
        const Field& coarse = runs.field(*runs.coarse, name);
        const Plane<float> wanted = divided_in_range(coarse.plane(), runs.coarse->domain().grid, 2);
        for (std::int64_t j = 0; j < 24; ++j) {
            for (std::int64_t i = 0; i < 32; ++i)
                EXPECT_EQ(runs.field(*runs.finer, name).at(i, j), wanted.at(i, j)) << name;
        }
    }
    // Noise is a function of the place, so finer cells have the noise of a grid that was as fine
    // from the beginning.
    const Runs fine(
        "system s {\n  u: 0\n  n: noise(0.3)\n  u' = n - u\n}\n"
        "domain { grid: 32, 24 }\nstage one: s { iterations: 0 }",
        2, interpreted(), false);
    EXPECT_EQ(runs.field(*runs.finer, "n").at(7, 5), fine.field(*fine.coarse, "n").at(7, 5));
}

TEST(FinerCells, OutlinesOfFrozenCellsAreThoseOfPlaces) {
    const Runs runs(
        "system s {\n  u: if(disc(0.5, 0.5, 0.3), 4, 0)\n  u' = 1\n}\n"
        "domain { grid: 20, 20 }\n"
        "stage one: s { iterations: 10; speed: 0.1; frozen: disc(0.5, 0.5, 0.3) }");
    ASSERT_TRUE(runs.finer);
    const auto values = Runs::numbers(*runs.finer, runs.field(*runs.finer, "u"));
    std::int64_t frozen = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double x = (static_cast<double>(k % 40) + 0.5) / 40 - 0.5;
        const double y = (static_cast<double>(k / 40) + 0.5) / 40 - 0.5;
        const bool is_inside = x * x + y * y < 0.09;
        frozen += is_inside;
        if (is_inside) EXPECT_EQ(values[k], 4) << k;
        else EXPECT_LT(values[k], 4) << k;
    }
    EXPECT_GT(frozen, 400);
}

TEST(FinerCells, MasksAreEvaluatedAnewAndValuesGoOnBeyondTheirBorder) {
    const Runs runs(
        "system s {\n  u: 5\n  v: x\n  u' = 0\n  v' = 0\n}\n"
        "domain { grid: 24, 24; mask: disc(0.5, 0.5, 0.37) }\n"
        "stage one: s { iterations: 1 }");
    ASSERT_TRUE(runs.finer);
    const DomainMask& mask = *runs.finer->domain().mask;
    EXPECT_NEAR(static_cast<double>(mask.cells) / (48 * 48), std::numbers::pi * 0.37 * 0.37, 0.007);
    for (std::int64_t j = 0; j < 48; ++j) {
        for (std::int64_t i = 0; i < 48; ++i) {
            const bool is_inside = mask.inside.at(i, j) != 0;
            EXPECT_EQ(runs.field(*runs.finer, "u").at(i, j), is_inside ? 5 : 0);
            const double x = (static_cast<double>(i) + 0.5) / 48;
            EXPECT_NEAR(runs.field(*runs.finer, "v").at(i, j), is_inside ? x : 0, 0.05);
        }
    }
}

TEST(FinerCells, EverySolverStaysStable) {
    for (const std::string settings :
         {"speed: 0.2", "solver: rk4; speed: 0.3", "solver: rk2; speed: 0.2",
          "speed: 0.1 + 0.1 * x", "solver: rkl2; speed: 2", "solver: etdrk4; speed: 2",
          "solver: rk23", "solver: symplectic; speed: 0.2"}) {
        const std::string end =
            settings.find("rk23") != std::string::npos ? "; duration: 40" : "; iterations: 200";
        const Runs runs(
            "system s {\n  u: 0.1 * noise(0.2)\n  u' = lap(u) + u - u^3\n}\n"
            "domain { grid: 32, 32 }\nstage one: s { " +
            settings + end + " }");
        ASSERT_TRUE(runs.finer) << settings;
        const auto values = Runs::numbers(*runs.finer, runs.field(*runs.finer, "u"));
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        EXPECT_GE(*low, -1.001) << settings;
        EXPECT_LE(*high, 1.001) << settings;
        EXPECT_GT(*high - *low, 0.01) << settings;
        EXPECT_GT(runs.finer->state(0).steps, runs.coarse->state(0).steps) << settings;
    }
}

/// Diffusion limits the step in one half of the domain. There is no diffusion in the other half.
/// The bound of its reaction, which has become large by then, must not hide the limit of diffusion.
TEST(FinerCells, StepsAreSplitByTheDiffusionOfEachCell) {
    const Runs runs(
        "system s {\n  u: 0.1 * noise(0.2)\n  m: 0\n  d: 0.24 * (x > 0.5)\n"
        "  u' = d * lap(u) + m * u - m * min(u, 100)\n  m' = x < 0.5\n}\n"
        "domain { grid: 32, 32 }\nstage one: s { iterations: 200 }");
    ASSERT_TRUE(runs.finer);
    const auto values = Runs::numbers(*runs.finer, runs.field(*runs.finer, "u"));
    EXPECT_LT(*std::max_element(values.begin(), values.end()), 0.1);
    EXPECT_GT(*std::min_element(values.begin(), values.end()), -0.1);
}

TEST(FinerCells, ConditionsThatCameTrueEndNothing) {
    const std::string system = "system s {\n  u: 0.5\n  u' = u - u^3\n}\ndomain { grid: 4, 4 }\n";
    const Runs grown(system +
                     "stage one: s { speed: 0.1; until: max(u over domain) > 0.8; "
                     "check: 1 }");
    ASSERT_TRUE(grown.finer);
    EXPECT_TRUE(grown.coarse->state(0).condition_met);
    EXPECT_GT(grown.finer->state(0).t, grown.coarse->state(0).t);
    EXPECT_GT(grown.field(*grown.finer, "u").at(0, 0), grown.field(*grown.coarse, "u").at(0, 0));
    const Runs settled(system + "stage one: s { speed: 0.1; until: steady(0.001); check: 1 }");
    EXPECT_TRUE(settled.finer->state(0).condition_met);
    EXPECT_LT(settled.finer->state(0).t, 1.09 * settled.coarse->state(0).t);
}

TEST(FinerCells, SidesKeepTheirValues) {
    const Runs runs(
        "system s {\n  u: 0\n  u' = lap(u)\n  u.left: fixed(sy)\n  u.right: slope(-u)\n"
        "  u.top: noflux\n}\ndomain { grid: 12, 8; boundary: noflux }\n"
        "stage one: s { iterations: 4000; speed: 0.2 }");
    ASSERT_TRUE(runs.finer);
    const Field& u = runs.field(*runs.finer, "u");
    EXPECT_NEAR(u.at(0, 0), u.at(0, 1), 0.05);
    EXPECT_NEAR((3 * u.at(0, 8) - u.at(1, 8)) / 2, (8 + 0.5) / 16, 0.02);  // At the face.
    EXPECT_GT(u.at(0, 15), u.at(0, 0));
}

TEST(FinerCells, SurfacesKeepTheirUnit) {
    const std::string torus =
        "grid: 48, 24; surface: (2 + cos(2*pi*sy)) * cos(2*pi*sx), "
        "(2 + cos(2*pi*sy)) * sin(2*pi*sx), sin(2*pi*sy)";
    for (const std::string unit : {"", "; unit: 0.2", "; metric: 0"}) {
        const Runs runs(
            "system s {\n  u: cos(2 * pi * sy)\n  a: sum(1 over domain)\n"
            "  u' = lap(u)\n}\ndomain { " +
            torus + unit + " }\nstage one: s { iterations: 30; speed: 0.05 }");
        ASSERT_TRUE(runs.finer);
        const auto number = [&](const Simulation& of) {
            return of.state(0).numbers[Runs::item(of, "a")];
        };
        // With `metric: 0` the sum counts cells, otherwise it adds areas.
        const double cells = unit == "; metric: 0" ? 4 : 1;
        EXPECT_NEAR(number(*runs.finer) / number(*runs.coarse), cells, 0.01) << unit;
        const Runs fine("system s {\n  u: cos(2 * pi * sy)\n  u' = lap(u)\n}\ndomain { " + torus +
                            unit + " }\nstage one: s { iterations: 33; speed: 0.05 }",
                        2, interpreted(), false);
        const auto largest = [](const Simulation& of, const Field& field) {
            const auto values = Runs::numbers(of, field);
            return *std::max_element(values.begin(), values.end());
        };
        EXPECT_NEAR(largest(*runs.finer, runs.field(*runs.finer, "u")),
                    largest(*fine.coarse, fine.field(*fine.coarse, "u")), 0.01)
            << unit;
    }
}

/// The largest and the mean error with which x, and a wave along x, are carried to finer cells.
std::pair<double, double> error_on_sphere(int cells) {
    const Runs runs("system s {\n  u: sin(6 * x)\n  u' = 0\n}\ndomain { surface: sphere; cells: " +
                        std::to_string(cells) + " }\nstage one: s { iterations: 1 }",
                    2, interpreted(2), false);
    EXPECT_TRUE(runs.finer);
    if (!runs.finer) return {};
    const ModelCells& model = *runs.finer->domain().model->cells;
    EXPECT_EQ(model.count(), 4 * static_cast<std::size_t>(cells));
    EXPECT_NEAR(model.spread().unit / runs.coarse->domain().model->cells->spread().unit, 1, 1e-9);
    const auto found = cell_values(runs.field(*runs.finer, "u"), model);
    const auto x =
        cell_values(model.spread().planes[static_cast<std::size_t>(ModelPlane::x)], model);
    double worst = 0, sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double error = std::abs(found[k] - std::sin(6 * x[k]));
        worst = std::max(worst, error);
        sum += error;
    }
    return {worst, sum / static_cast<double>(x.size())};
}

TEST(FinerCells, AreOfSecondOrderOnModels) {
    const auto [coarse_worst, coarse_mean] = error_on_sphere(600);
    const auto [fine_worst, fine_mean] = error_on_sphere(2400);
    // Cells of half the width give a quarter of the error.
    EXPECT_LT(fine_mean, coarse_mean / 3.5);
    EXPECT_LT(fine_worst, coarse_worst / 2.5);
    EXPECT_LT(coarse_mean, 0.01);
}

TEST(FinerCells, PatternsOfModelsKeepTheirStatistics) {
    const Runs runs(
        "stage spots: turing_spots { iterations: 6000; ka: 1/80 }\n"
        "domain { surface: torus(1, 0.5); cells: 3000 }",
        2, compiled());
    ASSERT_TRUE(runs.finer);
    const auto before = Runs::numbers(*runs.coarse, runs.field(*runs.coarse, "b"));
    const auto after = Runs::numbers(*runs.finer, runs.field(*runs.finer, "b"));
    EXPECT_EQ(after.size(), 12000);
    EXPECT_NEAR(mean_of(after) / mean_of(before), 1, 0.03);
    EXPECT_NEAR(part_above_middle(after), part_above_middle(before), 0.03);
}

}  // namespace
}  // namespace cascade::test
