// Solvers that treat diffusion wave by wave, in scripts: how a step changes each wave, what is
// conserved, steps far beyond the explicit limit, and the same bits with every executor.
#include "ran_text.h"
#include "resumed_run.h"

#include "measure/spectrum.h"
#include "run/simulation/simulation.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace cascade {
namespace {

using ::testing::HasSubstr;

using std::numbers::pi;

SimulationOptions fast() {
    SimulationOptions options;
    options.threads = 1;
    return options;
}

std::string faults_of(const std::string& text, const Overrides& overrides = {}) {
    const Script script = load_script("test", text, ".", overrides);
    EXPECT_FALSE(script.program);
    return script.messages(false);
}

/// A wave of 3 periods along x and 2 half periods along y on 24 × 20 cells, after `steps` steps.
struct Wave {
    static double eigenvalue() {
        const double x = std::sin(pi * 3 / 24), y = std::sin(pi * 2 / 40);
        return -4 * (x * x + y * y);
    }
    static std::string script(const char* rate, const char* solver, double speed, int steps) {
        return fmt::format(
            "system s {{ u: 2 + cos(6 * pi * sx) * cos(2 * pi * sy); k: 0.7; g: 0.2\n"
            " u' = {} }}\n"
            "stage one: s {{ solver: {}; speed: {}; iterations: {} }}\n"
            "domain {{ grid: 24, 20; boundary: periodic, noflux }}",
            rate, solver, speed, steps);
    }
    /// The height of the wave in u.
    static double height(const Field& u) {
        double sum = 0;
        for (std::int64_t j = 0; j < 20; ++j) {
            for (std::int64_t i = 0; i < 24; ++i) {
                const double sx = (static_cast<double>(i) + 0.5) / 24,
                             sy = (static_cast<double>(j) + 0.5) / 20;
                sum += u.at(i, j) * std::cos(6 * pi * sx) * std::cos(2 * pi * sy);
            }
        }
        return sum / (24 * 20 / 4.0);
    }
};

TEST(SemiImplicit, EachWaveIsDampedAsTheFormulaSays) {
    const double s = Wave::eigenvalue(), h = 40;
    const struct {
        const char* rate;
        double m;
    } cases[] = {{"k * lap(u)", 0.7 * s},
                 {"lap(k * u - g * lap(u))", 0.7 * s - 0.2 * s * s},
                 {"div(k * grad(u)) + 0.1 * dxx(u)",
                  0.7 * s - 0.1 * 4 * std::pow(std::sin(pi * 3 / 24), 2)},
                 {"diffuse(u, 0.8, 0.5, 0)", -0.64 * 4 * std::pow(std::sin(pi * 3 / 24), 2) -
                                                 0.25 * 4 * std::pow(std::sin(pi * 2 / 40), 2)}};
    for (const auto& [rate, m] : cases) {
        const Ran implicit = run_text(Wave::script(rate, "imex", h, 2));
        EXPECT_NEAR(Wave::height(implicit.species()), std::pow(1 - h * m, -2), 2e-6) << rate;
        const Ran exact = run_text(Wave::script(rate, "gauss", 0.1 * h, 3));
        EXPECT_NEAR(Wave::height(exact.species()), std::exp(0.3 * h * m), 2e-6) << rate;
        const Ran fourth = run_text(Wave::script(rate, "etdrk4", 0.1 * h, 3));
        EXPECT_NEAR(Wave::height(fourth.species()), std::exp(0.3 * h * m), 2e-6) << rate;
        for (const Ran* ran : {&implicit, &exact, &fourth}) {
            EXPECT_NEAR(moments(ran->species()).mean, 2, 1e-6) << rate;
        }
    }
}

constexpr const char* alloy =
    "system alloy {{ c: random({}, 0.1); gamma: 0.5\n c' = lap(c^3 - c - gamma * lap(c)) }}\n"
    "domain {{ grid: 64, 64; boundary: {} }}\n"
    "stage s: alloy {{ solver: {}; speed: {}; iterations: {} }}\n";

// Euler's limit is 0.04: 2 / (8 (8 gamma + 2)).
TEST(SemiImplicit, CahnHilliardAtAThousandTimesTheExplicitLimit) {
    for (const char* solver : {"imex", "gauss"}) {
        for (const char* boundary : {"periodic", "periodic, noflux"}) {
            const Ran start =
                run_text(fmt::format(fmt::runtime(alloy), 0.2, boundary, solver, 40, 0), fast());
            const Ran ran =
                run_text(fmt::format(fmt::runtime(alloy), 0.2, boundary, solver, 40, 400), fast());
            EXPECT_EQ(ran.failure, "");
            const FieldMoments found = moments(ran.species());
            // The mean is conserved up to rounding, and the two components have separated.
            EXPECT_NEAR(found.mean, moments(start.species()).mean, 2e-6) << solver;
            EXPECT_GT(found.deviation, 0.85) << solver;
            EXPECT_LT(found.deviation, 1.0) << solver;
        }
    }
}

TEST(SemiImplicit, CahnHilliardCoarsensAsWithEuler) {
    const auto wavelength = [](const char* solver, double speed, int steps) {
        const Ran ran =
            run_text(fmt::format(fmt::runtime(alloy), 0, "periodic", solver, speed, steps), fast());
        const FieldMoments found = moments(ran.species());
        EXPECT_GT(found.deviation, 0.7) << solver;
        measure::Samples samples;
        samples.cells = {64, 64, 1};
        samples.periodic = {true, true, true};
        for (std::int64_t j = 0; j < 64; ++j) {
            for (std::int64_t i = 0; i < 64; ++i) {
                samples.values.push_back(static_cast<double>(ran.species().at(i, j)));
            }
        }
        return measure::peak_wavelength(measure::radial_spectrum(samples));
    };
    const double euler = wavelength("euler", 0.025, 8000);
    // imex is of first order, and the damping that the steepest cells need slows all cells, so it
    // takes shorter steps than the other two solvers.
    EXPECT_NEAR(wavelength("imex", 0.2, 1000) / euler, 1, 0.12);
    EXPECT_NEAR(wavelength("etdrk4", 0.5, 400) / euler, 1, 0.12);
    EXPECT_NEAR(wavelength("gauss", 0.5, 400) / euler, 1, 0.12);
}

TEST(SemiImplicit, GrowsTheSameSpotsAsEuler) {
    const auto spots = [](const Overrides& overrides) {
        return run_text(
            "stage s: turing_spots { iterations: 12000; ka: 1/200 }\n"
            "domain { grid: 48, 48 }",
            fast(), overrides);
    };
    const Ran euler = spots({});
    for (const char* solver : {"imex", "etdrk4", "gauss"}) {
        Overrides changes;
        changes.solver = solver;
        const Ran found = spots(changes);
        EXPECT_DOUBLE_EQ(found.last().t, 12000);
        EXPECT_LT(found.last().steps, 2500) << solver;
        const Field& a = euler.species(1);
        const Field& b = found.species(1);
        const double difference =
            moments_of_difference(a, b).root_mean_square / moments(a).deviation;
        // The correlation of two fields with the same mean and deviation is 1 − difference² / 2.
        const double correlation = std::string_view(solver) == "imex" ? 0.95 : 0.98;
        EXPECT_LT(difference, std::sqrt(2 * (1 - correlation))) << solver;
    }
}

// A diffusion coefficient that depends on the species itself: with u' = lap(u^3) a sharp front
// spreads and the total stays the same.
TEST(SemiImplicit, FactorsThatVaryAreBounded) {
    for (const char* solver : {"imex", "gauss"}) {
        const Ran ran = run_text(fmt::format(
            "system s {{ u: 2 * gauss(0.5, 0.5, 0.1); k: 1 + x; u' = lap(u^3) + 0.1 * div(k * "
            "grad(u)) }}\n"
            "stage one: s {{ solver: {}; speed: 2; iterations: 200 }}\ndomain {{ grid: 40, 40 }}",
            solver));
        const Ran start = run_text(
            "system s { u: 2 * gauss(0.5, 0.5, 0.1); u' = lap(u) }\n"
            "stage one: s { iterations: 0 }\ndomain { grid: 40, 40 }");
        EXPECT_EQ(ran.failure, "");
        EXPECT_NEAR(moments(ran.species()).mean, moments(start.species()).mean, 1e-5);
        EXPECT_LT(ran.species().at(20, 20), 0.6f) << solver;
        EXPECT_GT(ran.species().at(20, 20), 0.05f) << solver;
    }
}

std::string everything(const char* solver) {
    return fmt::format(
        "system s {{ a: 4; b: 4; c: random(0, 0.3); beta: random(12, 0.1); k: 0.5 + x\n"
        " a' = 0.05 * (16 - a*b) + (0.125 + 0.1 * sin(t)) * lap(a)\n"
        " b' = 0.05 * (a*b - b - beta) + k * 0.03125 * lap(b)\n"
        " c' = lap(c^3 - c - 0.5 * lap(c)) + 0.001 * mean(a over domain)\n"
        " b >= 3.9\n a.left: fixed(4)\n a.right: fixed(5)\n }}\n"
        "stage one: s {{ solver: {}; {}; iterations: 60 }}\n"
        "domain {{ grid: 145, 139; boundary: noflux, periodic }}\n",
        solver, std::string_view(solver) == "etdrk4" ? "speed: 0.5" : "speed: 2");
}

TEST(SemiImplicit, SameBitsOnEveryBackendAndThread) {
    if (!is_available("jit")) GTEST_SKIP() << "no native code in this build";
    for (const char* solver : {"imex", "etdrk4", "gauss"}) {
        const Ran expected = run_text(everything(solver));
        EXPECT_EQ(expected.failure, "") << solver;
        for (const int lanes : {4, 16}) {
            const Ran found = run_text(everything(solver), {"jit", lanes, 3});
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(
                    moments_of_difference(found.species(k), expected.species(k)).root_mean_square,
                    0)
                    << solver;
            }
        }
        EXPECT_GE(expected.species(1).at(70, 30), 3.9f);
    }
}

class SemiImplicitRun : public ResumedRunTest {};

TEST_F(SemiImplicitRun, ResumesWithTheSameBits) {
    for (const char* settings :
         {"solver: imex; speed: 3; iterations: 30", "solver: etdrk4; speed: 2; iterations: 30",
          "solver: gauss; speed: auto; duration: 300"}) {
        const std::string text =
            fmt::format("stage one: turing_spots {{ {} }}\ndomain {{ grid: 30, 20 }}", settings);
        run_whole(text);
        run_in_two_parts(text, "one", 7);
        for (const char* name : {"one.a.npy", "one.b.npy"}) {
            EXPECT_EQ(bytes(std::string("whole/") + name), bytes(std::string("rest/") + name))
                << settings;
        }
    }
}

TEST(SemiImplicit, SaysWhatItCannotTake) {
    Overrides changes;
    changes.solver = "etdrk4";
    EXPECT_THAT(faults_of("stage one: turing_spots { speed: 0.5 + x }", changes),
                HasSubstr("1:34: error: with etdrk4 all cells must have the same speed"));
    EXPECT_THAT(faults_of("stage one: turing_spots { frozen: x > 0.5 }", changes),
                HasSubstr("stage 'one' freezes cells, but the solver etdrk4 cannot"));
}

}  // namespace
}  // namespace cascade
