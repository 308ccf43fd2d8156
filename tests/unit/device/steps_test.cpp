// Steps on a device give the same bits as steps on threads: solvers, sides, halos, aggregates,
// noise, masks and models.
#include "device/devices.h"
#include "tests/agreement/script_outcome.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace cascade::test {
namespace {

std::shared_ptr<Device> device() {
    static const auto opened = open_device("cpu");
    EXPECT_TRUE(opened) << (opened ? "" : opened.error().message);
    return opened ? *opened : nullptr;
}

/// Runs a script on threads and on the device, and compares the bits. The device must refuse the
/// script with these words, or without words take its steps.
void compare(const std::string& script, const std::string& expected_words = "") {
    const Outcome here = run_script("device", script, {}, {"interp", 0, 1});
    std::string told;
    SimulationOptions options{"interp", 0, 1};
    options.executor = on_device(device(), false, [&](const std::string& words) { told = words; });
    const Outcome there = run_script("device", script, {}, options);
    expect_same(here, there, script);
    if (expected_words.empty()) {
        EXPECT_EQ(told, "") << script;
    } else {
        EXPECT_NE(told.find(expected_words), std::string::npos) << told;
    }
}

/// A script of one system with the formulas `rules`.
std::string script_of(const std::string& domain, const std::string& rules,
                      const std::string& settings) {
    return fmt::format("domain {{ {} }}\nsystem s {{\n{}\n}}\nstage only: s {{ {} }}\n", domain,
                       rules, settings);
}

const std::string spots =
    "u: 1 - 0.5 * disc(0.5, 0.5, 0.2)\nv: 0.25 * disc(0.5, 0.5, 0.2) + random(0.01, 0.01)\n"
    "rate = u * v^2\nu' = 0.16 * lap(u) - rate + 0.037 * (1 - u)\n"
    "v' = 0.08 * lap(v) + rate - 0.097 * v";
const std::string steps = "iterations: 30";

TEST(StepsOnADevice, OfLinesPlanesAndVolumes) {
    compare(script_of("grid: 33, 21", spots, steps));
    compare(script_of("grid: 60, 1; boundary: noflux", spots, steps));
    compare(script_of("grid: 12, 9, 7; boundary: noflux, periodic, noflux", spots, steps));
    compare(script_of("grid: 33, 21; precision: double", spots, steps));
}

TEST(StepsOnADevice, OfModels) { compare(script_of("surface: sphere; cells: 300", spots, steps)); }

TEST(StepsOnADevice, WithSolversOfSeveralSweeps) {
    compare(script_of("grid: 20, 11", spots, "iterations: 20; solver: rk4"));
    compare(script_of("grid: 20, 11", spots, "iterations: 20; solver: rkl2; speed: 2"));
}

TEST(StepsOnADevice, OfChosenLengths) {
    compare(script_of("grid: 21, 11", spots, "duration: 30; solver: rk23"));
    compare(script_of("grid: 40, 3; precision: double", spots, "duration: 20; solver: rk45"));
}

TEST(StepsOnADevice, WithSides) {
    const std::string tide =
        "u: 0\nv: 0\nu' = lap(u) + v\nv' = lap(v) - u\n"
        "u.left: fixed(sin(t / 10) * sy)\nu.right: slope(-0.1)\n"
        "v.top: fixed(sx)\nv.bottom: slope(0.2 * t)";
    compare(script_of("grid: 32, 16; boundary: noflux", tide,
                      "iterations: 20; speed: 0.2; solver: rk4"));
    compare(script_of("grid: 9, 8, 5; boundary: noflux; front: fixed(1)", tide,
                      "iterations: 10; speed: 0.1"));
}

TEST(StepsOnADevice, WithAggregatesMasksAndNoise) {
    const std::string rules =
        "u: noise(0.3)\nv: 1\n"
        "u' = 0.2 * lap(u) + 0.1 * (mean(u over domain) - u) + normal(0, 0.1)\n"
        "v' = 0.1 * div(u * grad(v)) + 0.01 * (max(u over domain) - v) * step";
    compare(script_of("grid: 37, 19", rules, steps));
    compare(script_of("grid: 37, 19; boundary: noflux; mask: disc(0.5, 0.5, 0.4)", rules, steps));
}

TEST(StepsOnADevice, EndWhereValuesAreNotFinite) {
    compare(script_of("grid: 20, 10", "u: 1 + 0.1 * sx\nu' = u^2 + lap(u)",
                      "iterations: 3000; speed: 0.05"));
}

TEST(StepsOnADevice, RunOnThreadsWhereADeviceCannot) {
    compare(script_of("grid: 20, 10", spots, "iterations: 20; solver: imex"), "filters waves");
    compare(script_of("grid: 20, 10",
                      "u: sx\nu' = lap(u) + p\n0 = lap(p) + u - mean(u over domain)",
                      "iterations: 5; speed: 0.1"),
            "constraint");
    compare(script_of("grid: 20, 10; boundary: noflux",
                      "u: sx\nw: 0\nu' = lap(u)\nw' = lap(w)\nu.left: slope(w - u)",
                      "iterations: 5; speed: 0.1"),
            "sides depend on species");
}

}  // namespace
}  // namespace cascade::test
