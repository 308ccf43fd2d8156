// The built-in systems, compared with the C listings of the thesis, Appendix B, which are written
// here again in double precision and without code of the compiler.
#include "lower_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace cascade::test {
namespace {

using ::testing::ElementsAre;

constexpr int side = 6;
using Cells = std::array<std::array<double, side>, side>;

double neighbour_sum(const Cells& c, int i, int j) {
    const auto at = [&](int column, int row) {
        return c[static_cast<std::size_t>((row + side) % side)]
                [static_cast<std::size_t>((column + side) % side)];
    };
    return at(i, j - 1) + at(i, j + 1) + at(i + 1, j) + at(i - 1, j);
}

/// A listing of Appendix B computes the new state of one cell from the values of its species and
/// parameters, by name, and from the sums of species over its neighbours.
using State = std::map<std::string, double>;
using Listing = std::function<State(const State& value, const State& sum)>;

State turing(const State& v, const State& sum) {
    const double a = v.at("a"), b = v.at("b"), ka = v.at("ka");
    const double laplace_a = sum.at("a") - 4 * a;
    const double laplace_b = sum.at("b") - 4 * b;
    return {{"a", ka * (16 - a * b) + v.at("diff_a") * laplace_a},
            {"b", ka * (a * b - b - v.at("beta")) + v.at("diff_b") * laplace_b}};
}

State meinhardt_spots(const State& v, const State& sum) {
    const double a = v.at("a"), b = v.at("b"), s = v.at("s");
    const double ka = -s * v.at("p1") - 4 * v.at("diff1");
    const double kb = -s * v.at("p2") - 4 * v.at("diff2");
    const double temp = 0.01 * v.at("ai") * a * a;
    return {{"a", a * ka + v.at("diff1") * sum.at("a") + s * (temp / b + v.at("p3"))},
            {"b", b * kb + v.at("diff2") * sum.at("b") + s * temp}};
}

State meinhardt_stripes(const State& v, const State& sum) {
    const double a = v.at("a"), b = v.at("b"), c = v.at("c"), d = v.at("d"), e = v.at("e");
    const double ka = -v.at("p1") - 4 * v.at("diff1");
    const double kd = -v.at("p3") - 4 * v.at("diff2");
    const double temp1 = 0.01 * a * a * e * v.at("ai");
    const double temp2 = 0.01 * b * b * d;
    return {{"a", a * ka + v.at("diff1") * sum.at("a") + temp1 / c},
            {"b", b * ka + v.at("diff1") * sum.at("b") + temp2 / c},
            {"c", c * -v.at("p2") + temp1 + temp2},
            {"d", d * kd + v.at("diff2") * sum.at("d") + v.at("p3") * a},
            {"e", e * kd + v.at("diff2") * sum.at("e") + v.at("p3") * b}};
}

struct Case {
    const char* system;
    std::vector<const char*> species;
    std::vector<const char*> parameters;
    Listing listing;
    const char* fixed_point;  ///< Statements that remove the noise.
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        {"turing_spots", {"a", "b"}, {"diff_a", "diff_b", "beta", "ka"}, turing, "beta: 12"},
        {"autocatalysis",
         {"a", "b"},
         {"p1", "p2", "p3", "ai", "diff1", "diff2", "s"},
         meinhardt_spots,
         "ai: 1"},
        {"stripes",
         {"a", "b", "c", "d", "e"},
         {"p1", "p2", "p3", "ai", "diff1", "diff2"},
         meinhardt_stripes,
         "ai: 1"},
    };
    return all;
}

std::unique_ptr<Checked> stage_of(const Case& system, const std::string& statements) {
    auto checked = check_text(fmt::format("domain {{ grid: {0}, {0} }}\nstage one: {1} {{\n{2}\n}}",
                                          side, system.system, statements));
    EXPECT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    return checked;
}

TEST(Systems, HaveTheNamesOfTheListings) {
    for (const Case& each : cases()) {
        const auto checked = stage_of(each, "");
        const System& system = checked->program->system_of(0);
        std::vector<std::string> species, parameters;
        for (const Quantity& quantity : system.quantities) {
            (quantity.is_species ? species : parameters).push_back(quantity.name);
        }
        EXPECT_THAT(species, ::testing::ElementsAreArray(each.species));
        EXPECT_THAT(parameters, ::testing::UnorderedElementsAreArray(each.parameters));
    }
}

TEST(Systems, FixedPointsStay) {
    for (const Case& each : cases()) {
        const auto checked = stage_of(each, each.fixed_point);
        ScriptRun run(*checked->program);
        run.start(0);
        for (const Field& rate : run.rates(0)) {
            EXPECT_NEAR(rate.at(2, 3), 0, 1e-8) << each.system;
        }
        std::vector<float> before;
        for (const char* name : each.species) before.push_back(run.field(0, name).at(2, 3));
        run.step(0, 200);
        for (std::size_t k = 0; k < before.size(); ++k) {
            EXPECT_NEAR(run.field(0, each.species[k]).at(2, 3), before[k], 1e-4) << each.system;
        }
    }
}

TEST(Systems, StepsAreThoseOfTheListings) {
    for (const Case& each : cases()) {
        // Every quantity varies from cell to cell, by up to a third of a typical value.
        std::string statements = "speed: 0.5\nfrozen: x + y < 0.3\n";
        for (const char* name : each.species) statements += fmt::format("{}: random(3, 1)\n", name);
        for (const char* name : each.parameters) {
            statements += fmt::format("{}: random(0.06, 0.02)\n", name);
        }
        const auto checked = stage_of(each, statements);
        ScriptRun run(*checked->program);
        run.start(0);
        std::map<std::string, Cells> old;
        for (const auto* names : {&each.species, &each.parameters}) {
            for (const char* name : *names) {
                for (int j = 0; j < side; ++j) {
                    for (int i = 0; i < side; ++i) {
                        old[name][static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] =
                            run.field(0, name).at(i, j);
                    }
                }
            }
        }
        run.step(0);
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                State value, sum;
                for (const auto& [name, cells] : old) {
                    value[name] = cells[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
                    sum[name] = neighbour_sum(cells, i, j);
                }
                const bool frozen = (i + 0.5) / side + (j + 0.5) / side < 0.3;
                for (const auto& [name, delta] : each.listing(value, sum)) {
                    double expected = value[name] + (frozen ? 0 : 0.5 * delta);
                    EXPECT_NEAR(run.field(0, name).at(i, j), expected, 2e-6)
                        << each.system << " " << name << " at " << i << ", " << j;
                }
            }
        }
    }
}

TEST(Systems, OnlyTheInhibitorOfTuringIsClamped) {
    const auto checked = stage_of(cases()[0], "a: -1; b: 0.001; beta: 1000; ka: 1");
    ScriptRun run(*checked->program);
    run.start(0);
    run.step(0);
    EXPECT_EQ(run.field(0, "b").at(1, 1), 0.0f);
    const auto other = stage_of(cases()[0], "a: 1; b: 1000; ka: 1");
    ScriptRun falling(*other->program);
    falling.start(0);
    falling.step(0);
    EXPECT_LT(falling.field(0, "a").at(1, 1), 0.0f);
    const auto spots = stage_of(cases()[1], "b: 1; p2: 100; s: 1; ai: 0");
    ScriptRun unclamped(*spots->program);
    unclamped.start(0);
    unclamped.step(0);
    EXPECT_LT(unclamped.field(0, "b").at(1, 1), 0.0f);
}

/// The Leopard of Appendix C as printed, but with fewer steps: its two stages and the values that
/// pass between them.
TEST(Systems, LeopardRuns) {
    const auto checked = check_text(R"(
system_name: turing_spots
iterations: 28000
interval: 4000
frozen: 0
speed: 1.0
a: 4.0
b: 4.0
diff_a: 1/8
diff_b: 1/32
beta: random(12,0.1)
ka: 0.05 * 1/16

system_name: turing_spots
iterations: 7000
interval: 1000
frozen: b < 4
speed: 1.0
a: if([frozen],4,a)
b: if([frozen],4,b)
diff_a: 1/8
diff_b: 1/32
beta: beta
ka: 0.2 * 1/16
)");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    EXPECT_EQ(checked->program->stages[0].iterations, 28000);
    EXPECT_EQ(checked->program->stages[1].interval, 1000);
    ScriptRun run(*checked->program);
    run.start(0);
    run.step(0, 50);
    run.start(1);
    run.step(1, 5);
    int frozen_cells = 0;
    for (int j = 0; j < 64; ++j) {
        for (int i = 0; i < 64; ++i) {
            const bool frozen = run.field(0, "b").at(i, j) < 4;
            frozen_cells += frozen;
            EXPECT_EQ(run.field(1, "frozen").at(i, j), frozen ? 1.0f : 0.0f);
            EXPECT_TRUE(!frozen || run.field(1, "b").at(i, j) == 4.0f);
            EXPECT_EQ(run.field(1, "beta").at(i, j), run.field(0, "beta").at(i, j));
        }
    }
    EXPECT_GT(frozen_cells, 500);
    EXPECT_LT(frozen_cells, 3500);
}

}  // namespace
}  // namespace cascade::test
