// Amplitude equations whose coefficients are known in closed form.
#include "analysis/describe_parameters.h"
#include "tests/unit/analysis/closed_forms.h"

#include <array>
#include <cmath>

namespace cascade::test {
namespace {

using analysis::AmplitudeEquations;

/// The amplitude equations at the only critical value of a parameter between two values.
AmplitudeEquations onset(const std::string& text, const std::string& parameter, double low,
                         double high) {
    const auto analysed = analyse(text);
    for (const auto& change : critical(analysed, parameter, low, high)) {
        if (change.amplitudes) return *change.amplitudes;
    }
    ADD_FAILURE() << "no amplitude equations";
    return {};
}

std::string swift_hohenberg(double b, const std::string& grid = "64, 64") {
    return fmt::format(
        "system sh {{ u: 0; r: -0.1; u' = r*u - (u + 2*lap(u) + lap(lap(u))) + {} * u^2 - u^3 }}\n"
        "domain {{ grid: {}; spacing: 0.1; precision: double }}\nstage s: sh {{ iterations: 1 }}\n",
        b, grid);
}

TEST(Amplitudes, SwiftHohenbergHasItsCoefficients) {
    for (const double b : {0.0, 0.5, 0.8, 1.2}) {
        const AmplitudeEquations by = onset(swift_hohenberg(b), "r", -0.5, 0.5);
        EXPECT_NEAR(by.quadratic, 2 * b, 1e-6);
        // J(0) = −1, J(2k) = −9 and J(√3 k) = −4, except for the error of the grid for short waves.
        EXPECT_NEAR(by.self, 3 - 38.0 / 9 * b * b, 0.005);
        EXPECT_NEAR(by.cross, 6 - 5 * b * b, 0.005);
        // Subcritical above b² = 27/38 (J. Burke and E. Knobloch, Physical Review E 73, 2006).
        EXPECT_EQ(by.is_supercritical(), b * b < 27.0 / 38);
    }
    EXPECT_EQ(onset(swift_hohenberg(0), "r", -0.5, 0.5).quadratic, 0);
}

TEST(Amplitudes, ARowHasStripesOnly) {
    const AmplitudeEquations by = onset(swift_hohenberg(1, "64"), "r", -0.5, 0.5);
    EXPECT_FALSE(by.has_plane());
    EXPECT_NEAR(by.self, 3 - 38.0 / 9, 0.005);
}

/// x = A η with η = √(Du / Dv): J. Verdasca, A. De Wit, G. Dewel and P. Borckmans, Physics Letters
/// A 168 (1992). Their h omits the wave that v forces in the critical wave, which is small if v is
/// small.
TEST(Amplitudes, BrusselatorHasItsCoefficients) {
    const double feed = 3;
    const auto at = [&](double x) {
        const double eta = x / feed;
        return onset(fmt::format("system b {{ u: {0}; v: 1; decay: 1\n"
                                 "u' = {0} - (decay + 1) * u + u^2*v + {1} * lap(u)\n"
                                 "v' = decay*u - u^2*v + {2} * lap(v) }}\n"
                                 "domain {{ grid: 64, 64; spacing: 0.1; precision: double }}\n"
                                 "stage s: b {{ v: [decay] / {0} }}\n",
                                 feed, eta, 1 / eta),
                     "decay", 0.5, 0.9 * (1 + feed * feed));
    };
    const auto quadratic = [&](double x) { return 2 / feed * (1 - x) / (1 + x); };
    const auto self = [&](double x) {
        return (-8 + 38 * x + 5 * x * x - 8 * x * x * x) / (9 * feed * feed * x * (1 + x));
    };
    const auto cross = [&](double x) {
        return (-3 + 5 * x + 7 * x * x - 3 * x * x * x) / (feed * feed * x * (1 + x));
    };
    for (const double x : {0.6, 0.8, 1.2, 1.5}) {
        const AmplitudeEquations by = at(x);
        const double expected = quadratic(x) / self(x);
        EXPECT_NEAR(by.quadratic / by.self, expected, 0.01 * std::abs(expected)) << x;
    }
    for (const double x : {0.98, 1.0, 1.02}) {
        const AmplitudeEquations by = at(x);
        EXPECT_NEAR(by.cross / by.self, cross(x) / self(x), 0.02) << x;
        EXPECT_TRUE(by.ends_in_stripes());
    }
}

TEST(Amplitudes, KnowWhereTheyDoNotApply) {
    const auto none = [](const std::string& text, const std::string& parameter, double low,
                         double high) {
        const auto analysed = analyse(text);
        for (const auto& change : critical(analysed, parameter, low, high)) {
            if (change.amplitudes) return false;
        }
        return true;
    };
    // Amplitude equations do not apply if the diffusion depends on the state.
    EXPECT_TRUE(
        none("system s { u: 1; r: -0.1\nu' = r*(u-1) - (u - 1 + 2*lap(u^2)/2 + "
             "lap(lap(u))) - (u-1)^3 }\ndomain { grid: 64, 64; spacing: 0.2 }\n"
             "stage a: s { }\n",
             "r", -0.5, 0.5));
    // Nor do they apply if a conserved total responds to a pattern without limit.
    EXPECT_TRUE(
        none("system s { u: 0; w: 1; r: -0.1\nu' = r*u - (u + 2*lap(u) + lap(lap(u))) + "
             "u*(w - 1) - u^3\nw' = lap(w) }\n"
             "domain { grid: 64, 64; spacing: 0.2 }\nstage a: s { }\n",
             "r", -0.5, 0.5));
    // Nor do they apply to waves that travel.
    EXPECT_TRUE(
        none("system s { u: 0; r: -0.1\nu' = r*u - (u + 2*dxx(u) + dxx(dxx(u))) - dx(u) - "
             "u^3 }\ndomain { grid: 64; spacing: 0.2 }\nstage a: s { }\n",
             "r", -0.5, 0.5));
}

TEST(Amplitudes, SpotsAreOfASpeciesWhereverItIsDeclared) {
    // Schnakenberg's equations, in which u has spots.
    const std::string a = "a: 0.1 in 0 .. 0.4", b = "b: 0.9", u = "u: 1 + normal(0, 0.01)",
                      v = "v: 0.9",
                      rates = "u' = a - u + u^2*v + lap(u)\nv' = b - u^2*v + 40*lap(v)";
    for (const auto& order : {std::array{u, v, a, b}, std::array{a, b, u, v},
                              std::array{b, u, a, v}, std::array{u, a, v, b}}) {
        std::string text = "system s {\n";
        for (const std::string& line : order) text += line + "\n";
        const Analysed analysed =
            analyse(text + rates + " }\ndomain { grid: 96, 96; spacing: 0.625 }\nstage k: s { }\n");
        const Program& program = *analysed.script->program;
        const auto scan = analysis::scan_parameter(program, 0, {item_named(program, "a"), 0, 0.4},
                                                   analysed.first().state.species);
        ASSERT_TRUE(scan);
        const std::string words = analysis::describe(program, 0, *scan);
        EXPECT_NE(words.find("spots high in u"), std::string::npos) << words;
    }
}

TEST(Amplitudes, SpotsAreOfASpeciesThatTakesPart) {
    // q fades by itself, and is declared first.
    const Analysed analysed = analyse(
        "system s {\nq: 1; a: 0.1 in 0 .. 0.4; b: 0.9\nu: 1 + normal(0, 0.01); v: 0.9\nq' = -q\n"
        "u' = a - u + u^2*v + lap(u)\nv' = b - u^2*v + 40*lap(v) }\n"
        "domain { grid: 96, 96; spacing: 0.625 }\nstage k: s { }\n");
    const Program& program = *analysed.script->program;
    const auto scan = analysis::scan_parameter(program, 0, {item_named(program, "a"), 0, 0.4},
                                               analysed.first().state.species);
    ASSERT_TRUE(scan);
    const std::string words = analysis::describe(program, 0, *scan);
    EXPECT_NE(words.find("spots high in u"), std::string::npos) << words;
}

}  // namespace
}  // namespace cascade::test
