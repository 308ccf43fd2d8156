// Rates compared with an explicit step of a run, and derivatives with differences of rates.
#include "tests/unit/continuation/steady_script.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace cascade::test {
namespace {

/// Checks the rates of two species on a domain.
void expect_rates_of_a_run(const std::string& rates, const std::string& domain) {
    // Steps of length 1 change a state by its rates.
    SteadyScript script(fmt::format(
        "system s {{ u: 1.2 + 0.5 * sin(7 * x + 3 * y) + random(0, 0.2); v: 0.7 + "
        "0.3 * cos(5 * x - 2 * y); p: 0.3; q: 2 * p + 0.1; w: 0.5 + x\n{} }}\n"
        "domain {{ {}; precision: double }}\nstage a: s {{ solver: euler; iterations: 1; speed: 1 }}",
        rates, domain));
    if (testing::Test::HasFailure()) return;
    const Vector before = script.state();
    auto at = script.problem().linearised(before, script.parameter());
    script.advance();
    const Vector change = script.state() - before;
    const double size = change.cwiseAbs().maxCoeff() + 1;
    EXPECT_LT((at.rates - change).cwiseAbs().maxCoeff(), 1e-13 * size) << rates << "\n" << domain;
    EXPECT_LT((at.rates - script.problem().rates(before, script.parameter())).cwiseAbs().maxCoeff(),
              1e-15 * size)
        << rates;

    Vector way(before.size());
    for (Index k = 0; k < way.size(); ++k) way[k] = std::sin(static_cast<double>(3 * k + 1));
    constexpr double little = 1e-5;
    const auto rates_at = [&](double along, double aside) {
        return script.problem().rates(before + along * way, script.parameter() + aside);
    };
    const Vector by_state = (rates_at(little, 0) - rates_at(-little, 0)) / (2 * little);
    const Vector by_parameter = (rates_at(0, little) - rates_at(0, -little)) / (2 * little);
    EXPECT_LT((at.jacobian * way - by_state).cwiseAbs().maxCoeff(), 1e-7 * size) << rates << domain;
    EXPECT_LT((at.by_parameter - by_parameter).cwiseAbs().maxCoeff(), 1e-7 * size) << rates;
}

TEST(SteadyProblem, HasTheRatesOfARun) {
    const std::string reaction =
        "u' = p * u * v - u^3 + exp(-u) * q + w; v' = sqrt(u) - v / (1 + p)";
    const std::vector<std::string> rates{
        reaction,
        "u' = lap(u) + lap(u * v) + lap(lap(u)) * p; v' = 0.2 * lap(v) + min(u, v) - grad2(v)",
        "u' = div(v * grad(u)) - dx(u) * p; v' = div(u^2 * grad(v) - w * grad(u)) + dy(dx(v))",
        "u' = advect(p, -0.4, u) + transport(0.3, v, u); v' = dxx(v) + dxy(u) + shifted(u, 2, -1)",
        "u' = diffuse(u, 2, 1, 0.3) + p; v' = div(tensor(2, 1, u) * grad(v)) + mean(u over domain)",
        "u' = div(vector(u * v, u)) ; v' = div(symmetric(2, v, 1) * grad(u)) + if(u > 1, u, p)",
        "u' = div(u * grad(v) / (1 + v)) + disc(0.5, 0.5, 0.2); v' = dot(grad(u), grad(v)) + p"};
    const std::vector<std::string> domains{
        "grid: 7, 5; spacing: 0.8",
        "grid: 6, 5; boundary: noflux",
        "grid: 6, 5; boundary: noflux; stencil: isotropic",
        "grid: 7, 6; stencil: fourth",
        "grid: 6, 5; left: fixed(0.4); right: slope(0.3); top: noflux; bottom: noflux",
    };
    for (const std::string& each : rates) {
        for (const std::string& domain : domains) expect_rates_of_a_run(each, domain);
    }
}

TEST(SteadyProblem, HasTheRatesOfLinesAndVolumes) {
    const std::string rates =
        "u' = lap(u) + p * lap(u * v) + dx(v); v' = lap(lap(v)) - u^2 + div(u * grad(v))";
    expect_rates_of_a_run(rates, "grid: 12, 1; spacing: 0.7");
    expect_rates_of_a_run(rates, "grid: 12, 1; boundary: noflux");
    expect_rates_of_a_run(rates, "grid: 4, 5, 3");
    expect_rates_of_a_run(rates, "grid: 4, 3, 3; boundary: noflux; spacing: 0.9");
}

TEST(SteadyProblem, FollowsSidesThatReadSpeciesAndTheParameter) {
    expect_rates_of_a_run(
        "u.left: fixed(p * v + y); u.right: slope(p - u * v); v.right: flux(0.2 * u)\n"
        "v.left: noflux; u' = lap(u) + dx(v); v' = 2 * lap(v) + u * p",
        "grid: 8, 3; boundary: noflux");
}

TEST(SteadyProblem, HasTheRatesOfMaskedDomains) {
    const std::string mask = "; mask: not disc(0.5, 0.4, 0.2) and not (x > 0.8 and y > 0.7)";
    const std::vector<std::string> rates{
        "u' = lap(u) + lap(u * v) + lap(lap(u)) * p; v' = 0.2 * lap(v) + u - grad2(v)",
        "u' = div(v * grad(u)) - dx(u) * p; v' = div(u^2 * grad(v) - w * grad(u)) + dy(dx(v))",
        "u' = advect(p, -0.4, u) + transport(0.3, v, u); v' = dxx(v) + dxy(u) + shifted(u, 2, -1)",
        "u' = diffuse(u, 2, 1, 0.3) + p; v' = div(tensor(2, 1, u) * grad(v)) + mean(u over domain)",
        "u.border: fixed(p * v); u' = lap(u) + dxy(u); v' = div(u * grad(v)) + lap(u * v)",
        "v.border: flux(u * p); u' = div(vector(u * v, u)); v' = 2 * lap(v) + lap(lap(u))"};
    for (const std::string& each : rates) {
        expect_rates_of_a_run(each, "grid: 9, 8; spacing: 0.8" + mask);
        expect_rates_of_a_run(each, "grid: 8, 9; boundary: noflux" + mask);
    }
    expect_rates_of_a_run(rates[0], "grid: 6, 5, 4; boundary: noflux; mask: x + y + z > 0.9");
}

TEST(SteadyProblem, HasTheRatesOfModels) {
    for (const std::string model : {"surface: sphere; cells: 60; unit: 0.05",
                                    "surface: torus(1, 0.4); cells: 90; unit: 0.05"}) {
        expect_rates_of_a_run("u' = lap(u) + lap(u * v) + lap(lap(u)) * p; v' = lap(v) - grad2(v)",
                              model);
        expect_rates_of_a_run(
            "u' = div(v * grad(u)) + p * u; v' = dx(v) * dy(u) + div(w * grad(u * v))", model);
        expect_rates_of_a_run(
            "u' = mean(u over domain) - u; v' = integral(u * v over domain) + nx * z", model);
    }
}

TEST(SteadyProblem, HasTheRatesOfSurfaces) {
    const std::string ring =
        "surface: (1 + 0.4 * cos(2 * pi * sy)) * cos(2 * pi * sx), (1 + 0.4 * cos(2 * pi * sy)) * "
        "sin(2 * pi * sx), 0.4 * sin(2 * pi * sy); unit: 0.3; grid: 9, 6";
    expect_rates_of_a_run("u' = 0.01 * lap(u) + 0.01 * lap(u * v) * p; v' = grad2(v) * 0.01", ring);
    expect_rates_of_a_run(
        "u' = 0.01 * div(v * grad(u)); v' = mean(u over domain) + p * 0.1 * dx(u)", ring);
}

TEST(SteadyProblem, MovesStatesAlongAxesAloneThatTheRatesDoNotFeel) {
    const auto moved = [](const std::string& rate, const std::string& domain) {
        SteadyScript script(
            "system s { u: 1 + 0.3 * sin(2 * pi * x + 5 * y); p: 0.3; u' = " + rate +
            " }\ndomain { " + domain + "; precision: double }\nstage a: s { }");
        return script.problem().motions(script.state()).size();
    };
    EXPECT_EQ(moved("lap(u)", "grid: 9, 8"), 2U);
    EXPECT_EQ(moved("lap(u) + y * u", "grid: 9, 8"), 1U);
    EXPECT_EQ(moved("lap(u)", "grid: 9, 8; top: fixed(1); bottom: fixed(2)"), 1U);
    EXPECT_EQ(moved("lap(u)", "grid: 9, 8; mask: y > 0.3"), 1U);
    EXPECT_EQ(moved("lap(u)", "grid: 9, 8; mask: x > 0.3"), 1U);
    EXPECT_EQ(moved("lap(u)", "grid: 9, 8; mask: x + y > 0.3"), 0U);
    EXPECT_EQ(moved("lap(u)", "grid: 9, 8; boundary: noflux"), 0U);
    EXPECT_EQ(moved("lap(u)",
                    "surface: (1 + 0.4 * cos(2 * pi * sy)) * cos(2 * pi * sx), (1 + 0.4 * "
                    "cos(2 * pi * sy)) * sin(2 * pi * sx), 0.4 * sin(2 * pi * sy); "
                    "grid: 9, 6"),
              1U);
}

TEST(SteadyProblem, RefusesWhatHasNoSteadyState) {
    const auto refused = [](const std::string& rate, const std::string& rest = "") {
        const Script script = load_script(
            "test", "system s { u: 1; p: 1; u' = " + rate + " }\n" + rest + "stage a: s { }", ".");
        EXPECT_TRUE(script.program) << script.messages(false);
        if (!script.program) return std::string();
        const auto problem = continuation::SteadyProblem::create(
            *script.program, 0, {script.program->domain.grid, {}, nullptr, {}, {}}, ItemId(1),
            [](const Formula&) { return std::vector{1.0}; });
        return problem ? std::string() : problem.error().message;
    };
    EXPECT_EQ(refused("p * u + lap(u)"), "");
    EXPECT_EQ(refused("white(0.1) - u"), "random numbers in its rates leave no state steady");
    EXPECT_EQ(refused("sin(t) - u"), "its rates depend on time, so that no state is steady");
    EXPECT_EQ(refused("max(u over domain) - u"),
              "its rates use 'max over domain', which is not supported here");
    EXPECT_EQ(refused("convolve(exp(-distance), u, 3) - u"),
              "its rates use 'convolve', which is not supported here");
}

}  // namespace
}  // namespace cascade::test
