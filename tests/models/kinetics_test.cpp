// The reactions of the library's systems without space: steady states, thresholds, clocks, and what
// they conserve.
#include "tests/models/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::models {
namespace {

constexpr const char* two_cells = "grid: 2";

/// Growth rate of a swing about a level, from its extremes over two stretches of `steps`.
double swing_growth(Model& model, const std::string& species, double level, double time_step,
                    std::int64_t steps) {
    const auto swing = [&] {
        double largest = 0;
        for (int k = 0; k < 200; ++k) {
            model.step(steps / 200);
            largest = std::max(largest, std::abs(model.at(species, 0) - level));
        }
        return largest;
    };
    const double first = swing();
    const double second = swing();
    return std::log(second / first) / (time_step * static_cast<double>(steps));
}

TEST(Kinetics, SchnakenbergComesToItsSteadyState) {
    Model model("schnakenberg", two_cells, "a: 0.3; b: 0.9; u: 1.5; v: 0.5");
    model.step(4000);
    EXPECT_NEAR(model.at("u", 0), 0.3 + 0.9, 1e-4);
    EXPECT_NEAR(model.at("v", 0), 0.9 / (1.2 * 1.2), 1e-4);
}

/// I. Prigogine, R. Lefever 1968: the flat state becomes a clock at B = 1 + A²; near it a swing
/// grows at (B − 1 − A²) / 2. Euler's rule adds ω² dt / 2 with ω = A.
TEST(Kinetics, BrusselatorHopf) {
    for (const double excess : {-0.1, 0.1}) {
        const double decay = 2 + excess, step = 0.002;
        Model model("brusselator", two_cells,
                    "speed: 0.002; feed: 1; u: 1.006; v: " + std::to_string(decay) +
                        "; decay: " + std::to_string(decay));
        const double growth = swing_growth(model, "u", 1, step, 9400);
        EXPECT_NEAR(growth, excess / 2 + step / 2, 0.004) << decay;
    }
}

/// E. E. Sel'kov 1968: the flat state swings where supply² lies between (1 − 2a ∓ √(1 − 8a)) / 2.
TEST(Kinetics, SelkovSwingsBetweenTwoSupplies) {
    const double leak = 0.06;
    const double root = std::sqrt(1 - 8 * leak);
    for (const double sign : {-1.0, 1.0}) {
        const double edge = std::sqrt((1 - 2 * leak + sign * root) / 2);
        for (const double shift : {-0.04, 0.04}) {
            const double supply = edge + shift;
            const double rest = supply / (leak + supply * supply);
            Model model("selkov", two_cells,
                        "speed: 0.001; x_adp: [supply] + 0.001; y_f6p: " + std::to_string(rest) +
                            "; leak: 0.06; supply: " + std::to_string(supply));
            const double growth = swing_growth(model, "x_adp", supply, 0.001, 30000);
            EXPECT_EQ(growth > 0, sign * shift < 0) << supply << " " << growth;
        }
    }
}

/// The peak of the prey's nullcline is at (1 − half) / 2: the flat state is steady right of it and
/// swings left of it (M. L. Rosenzweig, Science 171, 1971).
TEST(Kinetics, RosenzweigMacarthurParadoxOfEnrichment) {
    for (const double shift : {-0.05, 0.05}) {
        const double half = 0.4, prey = (1 - half) / 2 + shift, gain = 2;
        const double death = gain * prey / (prey + half);
        const double predator = (1 - prey) * (prey + half);
        Model model("rosenzweig_macarthur", two_cells,
                    "speed: 0.001; half: 0.4; gain: 2; death: " + std::to_string(death) +
                        "; prey: " + std::to_string(prey + 0.001) +
                        "; predator: " + std::to_string(predator));
        const double growth = swing_growth(model, "prey", prey, 0.001, 60000);
        EXPECT_EQ(growth > 0, shift < 0) << growth;
    }
}

/// W. O. Kermack, A. G. McKendrick 1927: ln(s∞ / s0) = −(β/γ) (s0 + i0 − s∞).
TEST(Kinetics, SirFinalSize) {
    Model model("sir", two_cells,
                "speed: 0.005; contact: 1; recovery: 0.4; susceptible: 0.999; infected: 0.001");
    model.step(40000);
    const double left = model.at("susceptible", 0);
    EXPECT_NEAR(std::log(left / 0.999), -(1 / 0.4) * (1.0 - left), 0.01);
    EXPECT_NEAR(left + model.at("infected", 0) + model.at("recovered", 0), 1, 1e-4);
    EXPECT_LT(left, 0.12);
}

/// With weak + strong = 2 the whole population is logistic: N' = N (1 − N).
TEST(Kinetics, CyclicCompetitionIsLogisticAsAWhole) {
    Model model("cyclic_competition", two_cells,
                "speed: 0.0005; weak: 0.6; strong: 1.4; u: 0.05; v: 0.1; w: 0.02");
    const double start = 0.17;
    for (int k = 1; k <= 4; ++k) {
        model.step(2000);
        const double time = k;
        const double expected = start * std::exp(time) / (1 + start * (std::exp(time) - 1));
        EXPECT_NEAR(model.at("u + v + w", 0), expected, 2e-3) << time;
    }
}

/// E. Frey, Physica A 389, 2010: about a = b = c = μ / (3 μ + σ) a swing grows at
/// μ σ / (2 (3 μ + σ)) and turns at √3/2 · μ σ / (3 μ + σ); Euler's rule adds ω² dt / 2.
TEST(Kinetics, RockScissorsPaperSpiralsOutward) {
    Model model("rock_scissors_paper", two_cells,
                "speed: 0.01; a: 0.253; b: 0.25; c: 0.247; growth: 1; defeat: 1");
    const double growth = swing_growth(model, "a", 0.25, 0.01, 1200);
    const double turn = std::sqrt(3.0) / 2 / 4;
    EXPECT_NEAR(growth / (1.0 / 8 + turn * turn * 0.005), 1, 0.1);
}

/// r' = a r − r³, θ' = c r² (N. Kopell, L. N. Howard 1973).
TEST(Kinetics, LambdaOmegaTurnsByItsSwing) {
    Model model("lambda_omega", two_cells, "speed: 0.0005; a: 0.8; c: -1.5; u: 0.2; v: 0");
    model.step(40000);
    EXPECT_NEAR(model.at("sqrt(u^2 + v^2)", 0), std::sqrt(0.8), 2e-3);
    const double early = std::atan2(model.at("v", 0), model.at("u", 0));
    model.step(2000);
    const double late = std::atan2(model.at("v", 0), model.at("u", 0));
    EXPECT_NEAR(std::remainder(late - early, 2 * std::numbers::pi), -1.5 * 0.8 * 1.0, 5e-3);
}

/// A living state of Gray-Scott needs feed ≥ 4 (feed + kill)²: u = (1 − √(1 − 4 (F+k)²/F)) / 2,
/// v = (F / (F + k)) (1 − u).
TEST(Kinetics, GrayScottLivesUpToItsFold) {
    const double feed = 0.06, edge = std::sqrt(feed) / 2 - feed;
    for (const double shift : {-0.002, 0.002}) {
        const double kill = edge + shift, loss = feed + kill;
        Model model("gray_scott", two_cells,
                    "feed: 0.06; kill: " + std::to_string(kill) + "; u: 0.45; v: 0.28");
        model.step(20000);
        if (shift > 0) {
            EXPECT_LT(model.at("v", 0), 1e-6);
            EXPECT_NEAR(model.at("u", 0), 1, 1e-4);
            continue;
        }
        const double u = (1 - std::sqrt(1 - 4 * loss * loss / feed)) / 2;
        EXPECT_NEAR(model.at("u", 0), u, 2e-4);
        EXPECT_NEAR(model.at("v", 0), feed / loss * (1 - u), 2e-4);
    }
}

/// The rest state of the Oregonator solves (1 − u)(u + q) = f (u − q) with v = u. At f = 3 it is
/// stable, and the system's own `rest` is near it.
TEST(Kinetics, OregonatorRests) {
    const double q = 0.002, f = 3, b = f + q - 1;
    const double rest = (-b + std::sqrt(b * b + 4 * q * (1 + f))) / 2;
    Model model("oregonator", two_cells, "speed: 0.0005; f: 3; u: [rest]; v: [rest]");
    EXPECT_NEAR(model.at("u", 0) / rest, 1, 0.05);
    model.step(60000);
    EXPECT_NEAR(model.at("u", 0) / rest, 1, 1e-3);
}

/// Plants live on bare ground where it holds more water than half_uptake · death / (gain · uptake −
/// death) = 5: rain above 1 (M. Rietkerk et al. 2002).
TEST(Kinetics, RietkerkPlantsNeedRain) {
    for (const double rain : {0.9, 1.1}) {
        const double water = rain / 0.2, surface = rain / (0.2 * 0.2);
        Model model("rietkerk", two_cells,
                    "speed: 0.02; plants: 0.001; soil_water: " + std::to_string(water) +
                        "; surface_water: " + std::to_string(surface) +
                        "; rain: " + std::to_string(rain));
        model.step(5000);
        const double growth = 0.5 * water / (water + 5) - 0.25;
        EXPECT_NEAR(std::log(model.at("plants", 0) / 0.001) / 100, growth, 0.004) << rain;
    }
}

/// What is made of the one is taken from the other.
TEST(Kinetics, WavePinningKeepsItsProtein) {
    Model model("wave_pinning", "grid: 48, 48; boundary: noflux", "");
    const double before = model.mean("active + inactive");
    model.step(20000);
    EXPECT_NEAR(model.mean("active + inactive") / before, 1, 1e-5);
    model.step(40000);
    const double place = model.mean("active");
    EXPECT_GT(model.largest("active") - model.smallest("active"), 0.5);
    model.step(5000);
    EXPECT_NEAR(model.mean("active") / place, 1, 2e-3) << "the front is pinned";
}

}  // namespace
}  // namespace cascade::models
