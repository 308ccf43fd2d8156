// Flat states, critical values and waves whose closed forms are known.
#include "tests/unit/analysis/closed_forms.h"

#include <cmath>
#include <numbers>

namespace cascade::test {
namespace {

using analysis::Stability;

/// The wavelength in cells along an axis on which the grid's Laplacian multiplies the wave by
/// −square.
double cells_of(double square) { return std::numbers::pi / std::asin(std::sqrt(square) / 2); }

TEST(TuringConditions, BrusselatorHasItsThresholds) {
    const auto analysed = analyse("stage s: brusselator { feed: 4.5; decay: 7 }");
    const auto& state = analysed.first().state;
    EXPECT_TRUE(state.is_from_start);
    EXPECT_NEAR(state.species[0], 4.5, 1e-12);
    EXPECT_NEAR(state.species[1], 7 / 4.5, 1e-12);
    EXPECT_EQ(analysed.relation().stability, Stability::turing);
    EXPECT_EQ(analysed.analysis->states.size(), 1U);
    // B = (1 + A √(Du/Dv))² and B = 1 + A².
    const auto changes = critical(analysed, "decay", 1, 30);
    ASSERT_EQ(changes.size(), 2U);
    const double ratio = 1 + 4.5 * std::sqrt(4.0 / 32);
    EXPECT_NEAR(changes[0].value, ratio * ratio, 1e-5);
    EXPECT_EQ(changes[0].below, Stability::stable);
    EXPECT_EQ(changes[0].above, Stability::turing);
    // k² = A / √(Du Dv).
    EXPECT_NEAR(changes[0].cells, cells_of(4.5 / std::sqrt(4.0 * 32)), 0.01);
    EXPECT_NEAR(changes[1].value, 1 + 4.5 * 4.5, 1e-5);
    EXPECT_EQ(changes[1].above, Stability::both);
}

TEST(TuringConditions, BrusselatorOscillatesAtItsFrequency) {
    const auto analysed =
        analyse("stage s: brusselator { feed: 1; decay: 2.2; diff_u: 1; diff_v: 1 }");
    EXPECT_EQ(analysed.relation().stability, Stability::hopf);
    // Eigenvalues of [[B − 1, A²], [−B, −A²]].
    EXPECT_NEAR(analysed.relation().at_rest.real(), 0.1, 1e-12);
    EXPECT_NEAR(std::abs(analysed.relation().at_rest.imag()), std::sqrt(1 - 0.01), 1e-12);
}

/// det(J + λ D) = 0 has a double root: h² = 4 d det, h = d f_u + g_v.
TEST(TuringConditions, SchnakenbergHasItsThreshold) {
    const auto analysed = analyse("stage s: schnakenberg { }");
    const double u = 1, v = 0.9;
    EXPECT_NEAR(analysed.first().state.species[0], u, 1e-12);
    EXPECT_NEAR(analysed.first().state.species[1], v, 1e-12);
    const double fu = 2 * u * v - 1, fv = u * u, gu = -2 * u * v, gv = -u * u;
    const double det = fu * gv - fv * gu;
    const double root = (std::sqrt(det) + std::sqrt(det - fu * gv)) / fu;
    const auto changes = critical(analysed, "diff_v", 0.7, 50);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_NEAR(changes[0].value, 0.6 * root * root, 1e-5);
}

TEST(TuringConditions, GiererMeinhardtHasItsThreshold) {
    const auto analysed = analyse("stage s: gierer_meinhardt { source: 0; decay_h: 2 }");
    // a = decay_h, h = decay_h; J = [[1, −1], [2 a, −decay_h]].
    EXPECT_NEAR(analysed.first().state.species[0], 2, 1e-9);
    EXPECT_NEAR(analysed.first().state.species[1], 2, 1e-9);
    const double det = 1.0 * -2 + 1 * 4;
    const double root = std::sqrt(det) + std::sqrt(det + 2);
    const auto changes = critical(analysed, "diff_h", 0.5, 50);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_NEAR(changes[0].value, root * root, 1e-5);
}

TEST(TuringConditions, LengyelEpsteinHasItsHopfPoint) {
    const auto analysed =
        analyse("stage s: lengyel_epstein { a: 12; b: 0.3; sigma: 1; c: 1; diffusion: 0.01 }");
    // u = a / 5, v = 1 + u²; the trace (3 u² − 5 − σ b u) / (1 + u²) is 0 at b = (3 u² − 5) / σ u.
    const double u = 12.0 / 5;
    EXPECT_NEAR(analysed.first().state.species[0], u, 1e-10);
    EXPECT_NEAR(analysed.first().state.species[1], 1 + u * u, 1e-10);
    const auto changes = critical(analysed, "b", 0.1, 20);
    bool found = false;
    for (const auto& change : changes) {
        found = found || std::abs(change.value - (3 * u * u - 5) / u) < 1e-4;
    }
    EXPECT_TRUE(found);
}

TEST(TuringConditions, SwiftHohenbergGrowsByItsParameter) {
    const auto analysed = analyse("stage s: swift_hohenberg { r: 0.1 }\ndomain { grid: 64, 64 }");
    const auto& relation = analysed.relation();
    EXPECT_EQ(relation.stability, Stability::turing);
    EXPECT_NEAR(relation.fastest.rate.real(), 0.1, 1e-9);
    EXPECT_NEAR(relation.fastest.cells(), cells_of(0.7 * 0.7), 1e-3);
    // The rate at rest is r − kc⁴.
    EXPECT_NEAR(relation.at_rest.real(), 0.1 - std::pow(0.7, 4), 1e-12);
    // The band ends where (kc² − q)² = r.
    ASSERT_EQ(relation.bands.size(), 1U);
    const double root = std::sqrt(0.1);
    EXPECT_NEAR(2 * std::numbers::pi / relation.bands[0].least, cells_of(0.49 - root), 1e-3);
    EXPECT_NEAR(2 * std::numbers::pi / relation.bands[0].most, cells_of(0.49 + root), 1e-3);
    EXPECT_EQ(critical(analysed, "r", -0.5, 0.2).size(), 1U);
    EXPECT_NEAR(critical(analysed, "r", -0.5, 0.2)[0].value, 0, 1e-6);
}

TEST(TuringConditions, CahnHilliardKeepsItsMean) {
    const auto analysed = analyse("stage s: cahn_hilliard { c: 0.1 }");
    EXPECT_TRUE(analysed.analysis->has_conserved_totals);
    EXPECT_NEAR(analysed.first().state.species[0], 0.1, 1e-12);
    EXPECT_NEAR(analysed.relation().at_rest.real(), 0, 1e-12);
    EXPECT_TRUE(analysed.relation().has_growing_waves());
    EXPECT_EQ(analysed.relation().bands[0].least, 0);
}

TEST(TuringConditions, DeflationFindsAllStatesOfACubic) {
    const auto analysed =
        analyse("system s { u: 0.1; u' = u - u^3 + lap(u) }\nstage a: s { iterations: 1 }");
    std::vector<double> found;
    for (const auto& state : analysed.analysis->states) found.push_back(state.state.species[0]);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found.size(), 3U);
    EXPECT_NEAR(found[0], -1, 1e-9);
    EXPECT_NEAR(found[1], 0, 1e-9);
    EXPECT_NEAR(found[2], 1, 1e-9);
}

/// The rate of the mean is a − 1, where a is the sum of all weights.
TEST(TuringConditions, KernelsFollowTheirParameters) {
    const auto analysed = analyse(
        "system s { u: 0; a: 0.5 in 0 .. 2; w: 1 in 0.7 .. 3\n"
        "u' = convolve(a * exp(-distance^2 / (2 * w^2)) / (2 * pi), u, 9 * w) - u }\n"
        "stage s: s { }");
    const auto by_weight = critical(analysed, "a", 0, 2);
    ASSERT_EQ(by_weight.size(), 1U);
    EXPECT_NEAR(by_weight[0].value, 1, 1e-5);
    EXPECT_EQ(by_weight[0].above, Stability::uniform);
    const auto by_width = critical(analysed, "w", 0.7, 3);
    ASSERT_EQ(by_width.size(), 1U);
    EXPECT_NEAR(by_width[0].value, std::sqrt(2.0), 1e-5);
}

/// A state at 0 gives no scale for its change with the parameter.
TEST(TuringConditions, StatesAreFollowedFromZero) {
    const auto analysed =
        analyse("system s { u: 0; b: 0 in -3 .. 3; u' = tanh(b) - u + lap(u) }\nstage s: s { }");
    EXPECT_TRUE(critical(analysed, "b", -3, 3).empty());
}

TEST(TuringConditions, MapAgreesWithTheBrusselatorsThresholds) {
    const auto analysed = analyse("stage s: brusselator { }");
    const Program& program = *analysed.script->program;
    const analysis::ParameterSpan across{item_named(program, "decay"), 4, 12};
    const analysis::ParameterSpan up{item_named(program, "feed"), 3.5, 6};
    constexpr std::size_t side = 41;
    const auto map =
        analysis::map_parameters(program, 0, across, up, side, analysed.first().state.species);
    ASSERT_TRUE(map);
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
            const double decay = 4 + 8.0 * static_cast<double>(i) / (side - 1);
            const double feed = 3.5 + 2.5 * static_cast<double>(j) / (side - 1);
            const double root = 1 + feed * std::sqrt(4.0 / 32);
            if (std::abs(decay - root * root) < 1e-6) continue;
            EXPECT_EQ(map->classes[j * side + i],
                      decay > root * root ? Stability::turing : Stability::stable)
                << decay << " " << feed;
        }
    }
}

}  // namespace
}  // namespace cascade::test
