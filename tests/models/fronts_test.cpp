// Fronts and waves of the library's systems move with the speeds from theory.
#include "tests/models/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::models {
namespace {

/// The speed, in cells per unit of time, at which the position where `species` falls below `level`
/// moves from step `first` to step `last`.
double front_speed(Model& model, const std::string& species, double level, double time_step,
                   std::int64_t first, std::int64_t last) {
    model.step(first);
    const double start = front_position(model.values(species), level);
    model.step(last - first);
    const double end = front_position(model.values(species), level);
    return (end - start) / (time_step * static_cast<double>(last - first));
}

/// The speed is 2 √(r D) (R. A. Fisher 1937). It is reached slowly: x(t) = 2 t − 3/2 ln t + … in
/// units of r = D = 1 (M. Bramson, Memoirs of the AMS 285, 1983).
TEST(Fronts, FisherKpp) {
    Model model("fisher_kpp", "grid: 1200; boundary: noflux",
                "speed: 0.01; growth: 1; diffusion: 9; u: x < 0.05");
    const double speed = front_speed(model, "u", 0.5, 0.01, 8000, 16000);
    const double predicted = 3 * (2 - 1.5 * std::log(160.0 / 80) / 80);
    EXPECT_NEAR(speed / predicted, 1, 0.01);
    EXPECT_NEAR(speed / (2 * std::sqrt(9.0)), 1, 0.02);
}

/// The speed is √(D/2) (1 − 2 a) (H. P. McKean, Advances in Mathematics 4, 1970).
TEST(Fronts, Nagumo) {
    for (const double threshold : {0.1, 0.3}) {
        Model model("nagumo", "grid: 400; boundary: noflux",
                    "speed: 0.02; diffusion: 8; u: x < 0.2; threshold: " +
                        std::to_string(threshold));
        const double speed = front_speed(model, "u", 0.5, 0.02, 1000, 5000);
        EXPECT_NEAR(speed / (std::sqrt(8.0 / 2) * (1 - 2 * threshold)), 1, 0.015) << threshold;
    }
}

/// With a threshold above ½ the front moves backwards.
TEST(Fronts, NagumoRetreats) {
    Model model("nagumo", "grid: 400; boundary: noflux",
                "speed: 0.02; diffusion: 8; u: x < 0.7; threshold: 0.7");
    const double speed = front_speed(model, "u", 0.5, 0.02, 1000, 5000);
    EXPECT_NEAR(speed / (std::sqrt(8.0 / 2) * (1 - 1.4)), 1, 0.015);
}

/// With a constant recovery, the front of the voltage is Nagumo's.
TEST(Fronts, FitzhughNagumo) {
    Model model("fitzhugh_nagumo", "grid: 400; boundary: noflux",
                "speed: 0.02; diffusion: 8; slowness: 0; voltage: x < 0.2; recovery: 0");
    const double speed = front_speed(model, "voltage", 0.5, 0.02, 1000, 5000);
    EXPECT_NEAR(speed / (std::sqrt(8.0 / 2) * (1 - 2 * 0.1)), 1, 0.015);
}

/// With s susceptibles, the wave moves with the speed 2 √(D (β s − γ)) (J. V. Noble, Nature 250,
/// 1974). It is a pulled front like Fisher's with r = β s − γ, and approaches its speed equally
/// slowly.
TEST(Fronts, Sir) {
    Model model("sir", "grid: 1000; boundary: noflux",
                "speed: 0.01; contact: 1; recovery: 0.4; diffusion: 9; susceptible: 1\n"
                "infected: 0.1 * (x < 0.05)");
    const double speed = front_speed(model, "infected", 0.01, 0.01, 8000, 16000);
    const double rate = 0.6;
    const double predicted = std::sqrt(9 * rate) * (2 - 1.5 * std::log(2.0) / (80 * rate));
    EXPECT_NEAR(speed / predicted, 1, 0.01);
}

/// A wall moves at D times its curvature, so d(π R²)/dt = −2 π D (S. M. Allen and J. W. Cahn 1979).
TEST(Fronts, AllenCahnDiscShrinks) {
    Model model("allen_cahn", "grid: 128, 128",
                "speed: 0.04; diffusion: 4; u: 2 * disc(0.5, 0.5, 0.32) - 1");
    const auto area = [&] { return model.mean("(u + 1) / 2") * 128 * 128; };
    model.step(250);
    const double first = area();
    model.step(1500);
    const double rate = (area() - first) / 60;
    EXPECT_NEAR(rate / (-2 * std::numbers::pi * 4), 1, 0.02);
}

/// A spiral of Barkley's model turns uniformly, and hardly faster on a finer grid.
TEST(Fronts, BarkleySpiralTurns) {
    std::vector<double> periods;
    for (const double diffusion : {4.0, 9.0}) {
        const std::string side = diffusion > 4 ? "192, 192" : "128, 128";
        Model model("barkley", "boundary: noflux; grid: " + side,
                    "speed: 0.01; diffusion: " + std::to_string(diffusion));
        const auto probe =
            static_cast<std::size_t>(model.width() * model.width() / 8 + model.width() / 8);
        std::vector<double> passages;
        double before = model.at("u", probe);
        for (int k = 0; k < 700; ++k) {
            model.step(5);
            const double now = model.at("u", probe);
            if (before < 0.5 && now >= 0.5) {
                passages.push_back(0.05 * (k + (0.5 - before) / (now - before)));
            }
            before = now;
        }
        ASSERT_GE(passages.size(), 5u);
        const std::size_t last = passages.size() - 1;
        const double period = passages[last] - passages[last - 1];
        EXPECT_NEAR(period / (passages[last - 1] - passages[last - 2]), 1, 0.02);
        periods.push_back(period);
    }
    EXPECT_NEAR(periods[1] / periods[0], 1, 0.05);
}

/// A skate glides uniformly along its axis and keeps its shape (R. P. Munafo 2014).
TEST(Fronts, GrayScottSkatesGlide) {
    Model model("gray_scott_gliders", "grid: 192, 192", "");
    const std::string dent = "(v < 0.15) * (y < 0.4)", other = "(v < 0.15) * (abs(y - 0.5) < 0.1)";
    const auto place = [&](const std::string& where, const std::string& axis) {
        return 192 * model.mean(axis + " * " + where) / model.mean(where);
    };
    std::vector<double> right, left, down, size;
    for (int k = 0; k < 4; ++k) {
        model.step(4000);
        right.push_back(place(dent, "x"));
        left.push_back(place(other, "x"));
        down.push_back(place(dent, "y"));
        size.push_back(model.mean(dent) * 192 * 192);
    }
    const double pace = (right[3] - right[1]) / 2;
    EXPECT_GT(pace, 4);
    EXPECT_NEAR((right[3] - right[2]) / pace, 1, 0.1);
    EXPECT_NEAR((left[3] - left[1]) / 2 / pace, -1, 0.05) << "the one that faces the other way";
    EXPECT_NEAR(down[3], down[1], 0.3);
    EXPECT_NEAR(size[3] / size[1], 1, 0.1);
}

/// The plane wave is A = √(1 − q²) exp(i (q x − ω t)) with ω = β + (α − β) q² (I. S. Aranson, L.
/// Kramer, Reviews of Modern Physics 74, 2002).
TEST(Fronts, ComplexGinzburgLandauPlaneWave) {
    constexpr int cells = 128, mode = 3;
    constexpr double alpha = 0.5, beta = 1.2, diffusion = 2;
    Model model("complex_ginzburg_landau", "grid: 128",
                "speed: 0.001; alpha: 0.5; beta: 1.2; diffusion: 2\n"
                "re: 0.9 * cos(6 * pi * x); im: 0.9 * sin(6 * pi * x)");
    const double step = 2 * std::sin(std::numbers::pi * mode / cells);
    const double square = diffusion * step * step;  // q² on the grid.
    const double omega = beta + (alpha - beta) * square;
    model.step(20000);
    const double early = std::atan2(model.at("im", 0), model.at("re", 0));
    EXPECT_NEAR(std::hypot(model.at("im", 0), model.at("re", 0)), std::sqrt(1 - square), 1e-3);
    model.step(1000);
    const double late = std::atan2(model.at("im", 0), model.at("re", 0));
    const double turned = std::remainder(late - early, 2 * std::numbers::pi);
    EXPECT_NEAR(-turned / 1.0 / omega, 1, 0.002);
}

}  // namespace
}  // namespace cascade::models
