// The symbol of each operator, compared with closed forms.
#include "tests/unit/analysis/closed_forms.h"

#include <cmath>
#include <numbers>

namespace cascade::test {
namespace {

using analysis::Complex;

/// The growth rate of a wave in a system with one species `u`, where `rate` is the right side of u'
/// = ….
Complex rate_of(const std::string& rate, double x, double y, const std::string& stencil = "cross") {
    const auto analysed = analyse("system s { u: 0.5; u' = " + rate +
                                  " }\ndomain { grid: 64, 64; spacing: 0.5; stencil: " + stencil +
                                  " }\n"
                                  "stage a: s { iterations: 1; speed: 1e-6 }");
    if (!analysed.analysis || analysed.analysis->states.empty()) return 1e300;
    const auto& model = analysed.analysis->model;
    return analysis::eigenvalues(model, analysed.first().matrices,
                                 analysis::lattice_of(*model.program), {x, y, 0})[0];
}

void expect_rate(const std::string& rate, Complex expected, double x = 0.7, double y = 0.3) {
    const Complex found = rate_of(rate, x, y);
    EXPECT_NEAR(found.real(), expected.real(), 1e-9) << rate;
    EXPECT_NEAR(found.imag(), expected.imag(), 1e-9) << rate;
}

TEST(OperatorsOfWaves, HaveTheSymbolsOfTheirDifferences) {
    constexpr double h = 0.5, x = 0.7, y = 0.3;
    const Complex i(0, 1);
    const double sx = -4 * std::pow(std::sin(x / 2), 2) / (h * h);
    const double sy = -4 * std::pow(std::sin(y / 2), 2) / (h * h);
    const double cx = std::sin(x) / h, cy = std::sin(y) / h;
    expect_rate("lap(u)", sx + sy);
    expect_rate("lap(lap(u))", (sx + sy) * (sx + sy));
    expect_rate("dx(u)", i * cx);
    expect_rate("dyy(u)", sy);
    expect_rate("dxy(u)", -cx * cy);
    expect_rate("div(grad(u))", sx + sy);
    expect_rate("div(u * grad(u))", 0.5 * (sx + sy));
    expect_rate("div(vector(u^2, 0))", i * cx);  // Averaged at faces: 2u · (E − W) / 2h.
    expect_rate("advect(2, -1, u)",
                2.0 * (1.0 - std::exp(-i * x)) / h - (std::exp(i * y) - 1.0) / h);
    expect_rate("advect(vector(2, -1), u)",
                2.0 * (1.0 - std::exp(-i * x)) / h - (std::exp(i * y) - 1.0) / h);
    expect_rate("transport(2, -1, u)", i * (2 * cx - cy));
    expect_rate("dot(vector(2, -1), grad(u))", i * (2 * cx - cy));
    expect_rate("grad(u).y", i * cy);
    expect_rate("lap(u^3 - u)", (3 * 0.25 - 1) * (sx + sy));
    expect_rate("grad2(u)", 0);
    expect_rate("lap(u) + 3 * (mean(u over domain) - u)", sx + sy - 3);
    // Along the x axis.
    expect_rate("diffuse(u, 2, 1, 0)", 4 * sx + sy);
    expect_rate("div(tensor(2, 1, 0) * grad(u))", 4 * sx + sy);
    expect_rate("div(symmetric(4, 0, 1) * grad(u))", 4 * sx + sy);
    expect_rate("div((symmetric(1, 0, 1) + 2 * symmetric(0, 1, 0)) * grad(u))",
                sx + sy - 4 * cx * cy);
}

TEST(OperatorsOfWaves, FollowTheStencil) {
    constexpr double h = 0.5, x = 0.7, y = 0.3;
    const Complex i(0, 1);
    const auto expect = [&](const char* stencil, const char* rate, Complex expected) {
        EXPECT_NEAR(std::abs(rate_of(rate, x, y, stencil) - expected), 0, 1e-9)
            << stencil << " " << rate;
    };
    // The isotropic stencil with nine weights, by Patra and Karttunen.
    const double nine =
        (8 * (std::cos(x) + std::cos(y)) + 4 * std::cos(x) * std::cos(y) - 20) / (6 * h * h);
    expect("isotropic", "lap(u)", nine);
    expect("isotropic", "dx(u)", i * std::sin(x) / h);
    // The differences of fourth order, with the weights -1 16 -30 16 -1 and 1 -8 0 8 -1.
    const auto second = [&](double phase) {
        return (32 * std::cos(phase) - 2 * std::cos(2 * phase) - 30) / (12 * h * h);
    };
    const auto first = [&](double phase) {
        return i * (8 * std::sin(phase) - std::sin(2 * phase)) / (6 * h);
    };
    expect("fourth", "lap(u)", second(x) + second(y));
    expect("fourth", "dyy(u)", second(y));
    expect("fourth", "dx(u)", first(x));
    expect("fourth", "dxy(u)", first(x) * first(y));
    expect("fourth", "dot(vector(2, -1), grad(u))", 2.0 * first(x) - first(y));
}

TEST(OperatorsOfWaves, OfConvolutionsAreTransformsOfTheirKernels) {
    constexpr double h = 0.5, x = 0.7, y = 0.3;
    // 2π exp(−k²/2) is the transform of exp(−r²/2). The sum over cells differs by less than 1e-9.
    const double bell = 2 * std::numbers::pi * std::exp(-(x * x + y * y) / (2 * h * h));
    expect_rate("convolve(exp(-distance^2 / 2), u, 8)", bell);
    expect_rate("convolve(exp(-distance^2 / 2), lap(u) / 3, 8) - u",
                bell * rate_of("lap(u)", x, y) / 3.0 - 1.0);
    // The right neighbour alone.
    expect_rate("convolve(if(direction.x > 0.9, 1, 0), u, 0.6)", h * h * std::exp(Complex(0, x)));
}

TEST(OperatorsOfWaves, FieldsOfConstraintsFollowTheWave) {
    constexpr double h = 0.5;
    const double s = -4 * (std::pow(std::sin(0.35), 2) + std::pow(std::sin(0.15), 2)) / (h * h);
    expect_rate("p\n 0 = lap(p) - 4 * p + u", 1 / (4 - s));
    // The value of the field, u / 4 in the flat state, enters the rate.
    expect_rate("p * u - u^2 / 4\n 0 = lap(p) - 4 * p + u", 0.125 + 0.5 / (4 - s) - 0.25);
    // A source without a mean has a potential.
    const std::string potential = "p\n 0 = lap(p) + u - mean(u over domain)";
    expect_rate(potential, -1 / s);
    EXPECT_EQ(rate_of(potential, 0, 0), 0.0);
    // One field depends on the other.
    expect_rate("q\n 0 = lap(p) - p + u\n 0 = lap(q) - 2 * q + 3 * p", 3 / ((1 - s) * (2 - s)));
}

TEST(OperatorsOfWaves, TellWhatIsTheSameInAllCells) {
    EXPECT_NEAR(rate_of("lap(u) + 3 * (mean(u over domain) - u)", 0, 0).real(), 0, 1e-12);
}

TEST(OperatorsOfWaves, OfFluxesAcrossAxesAreThoseOfTheTensor) {
    // At 45 degrees a11 = a22 = (4 + 1)/2 and a12 = ±(4 − 1)/2. Flux and diffuse have the same
    // sign.
    const Complex by_flux = rate_of("div(tensor(2, 1, pi/4) * grad(u))", 0.2, 0.2);
    const Complex against = rate_of("div(tensor(2, 1, pi/4) * grad(u))", 0.2, -0.2);
    const Complex by_diffuse = rate_of("diffuse(u, 2, 1, pi/4)", 0.2, 0.2);
    EXPECT_LT(by_flux.real(), 1.5 * against.real());
    EXPECT_NEAR(by_flux.real() / by_diffuse.real(), 1, 0.02);
}

TEST(OperatorsOfWaves, FixTheLongestStableSteps) {
    const auto analysed = analyse(
        "system s { u: 0; u' = 2 * lap(u) }\ndomain { grid: 64, 64 }\nstage a: s { iterations: 1 }");
    // The shortest wave fades at the rate 8 · 2.
    for (const auto& step : analysed.first().steps) {
        EXPECT_NEAR(step.step * 16, stability_interval(step.solver), 2e-3) << name_of(step.solver);
    }
}

TEST(OperatorsOfWaves, OscillationsWithoutDecayAreStableWithNoStepOfEuler) {
    const auto analysed =
        analyse("system s { u: 0; v: 0; u' = v; v' = lap(u) - u }\nstage a: s { iterations: 1 }");
    for (const auto& step : analysed.first().steps) {
        if (step.solver == Solver::euler || step.solver == Solver::rk2) {
            EXPECT_EQ(step.step, 0);
        }
        // The method is stable on the imaginary axis up to 2 √2, and the wave has ω = 3.
        if (step.solver == Solver::rk4) {
            EXPECT_NEAR(step.step, 2 * std::sqrt(2.0) / 3, 1e-3);
        }
    }
}

std::string refusal_of(const std::string& text) {
    const auto script = check_text(text);
    EXPECT_TRUE(script->program) << text;
    if (!script->program) return "";
    const auto model = analysis::linear_model(*script->program, 0);
    return model ? "" : model.error().message;
}

TEST(OperatorsOfWaves, RatesThatDependOnPlacesAreRefused) {
    EXPECT_EQ(refusal_of("system s { u: 0; u' = x - u }\nstage a: s { iterations: 1 }"),
              "its rates read 'x', so that no state is flat");
    EXPECT_EQ(refusal_of(
                  "system s { u: 0; u' = disc(0.5, 0.5, 0.1) - u }\nstage a: s { iterations: 1 }"),
              "'disc' in its rates varies over the domain, so no state is flat");
    EXPECT_EQ(refusal_of("domain { surface: sphere }\n"
                         "system s { u: 0; u' = diffuse(u, 2, 1, 0) - u }\n"
                         "stage a: s { iterations: 1 }"),
              "on a model it spreads in a direction, so that waves of one length decay at "
              "different rates");
}

TEST(OperatorsOfWaves, ConvolutionsThatEndAtBordersAreRefused) {
    const std::string system = "system s { u: 0; u' = convolve(exp(-distance), u) - u }\n";
    const auto refusal_on = [&](const std::string& domain) {
        return refusal_of(system + "domain { " + domain + " }\nstage a: s { iterations: 1 }");
    };
    const std::string border =
        "its convolutions end at the border of the domain, so that no state is flat";
    EXPECT_EQ(refusal_on("grid: 64, 64; boundary: noflux"), border);
    EXPECT_EQ(refusal_on("grid: 64, 64; mask: disc(0.5, 0.5, 0.4)"), border);
    EXPECT_EQ(refusal_on("grid: 512, 512"), "its convolutions reach more than 65536 cells");
    EXPECT_EQ(refusal_on("grid: 64, 64"), "");
}

TEST(OperatorsOfWaves, WordsNameStateAndWaves) {
    const auto analysed = analyse("stage s: brusselator { }");
    const std::string words = describe(*analysed.analysis);
    EXPECT_NE(words.find("flat state u = 4.5, v = 1.5556 (from the starting values)"),
              std::string::npos)
        << words;
    EXPECT_NE(words.find("Turing: stable if all cells change alike"), std::string::npos) << words;
    EXPECT_NE(words.find("fastest wave        9.57"), std::string::npos) << words;
}

}  // namespace
}  // namespace cascade::test
