// Lowering, judged by what the interpreter computes from it.
#include "lower_helpers.h"

#include "core/palette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace cascade::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string small_grid = "domain { grid: 8, 4 }\n";

/// A system with a species `u` (of no meaning) and a parameter `p` that is read.
std::string system_with(const std::string& p) {
    return "system s { u: 0; p: " + p + "; u' = p }\nstage one: s {}\n";
}

/// The values of a formula over the cells of a domain.
class Values {
public:
    Values(const std::string& domain, const std::string& formula)
        : checked_(check_text(domain + system_with(formula))) {
        EXPECT_TRUE(checked_->program) << ::testing::PrintToString(checked_->faults());
        if (!checked_->program) return;
        run_ = std::make_unique<ScriptRun>(*checked_->program);
        run_->start(0);
        uniform_ = checked_->program->stages[0].uniform[ItemId(1)];
    }
    float at(std::int64_t i, std::int64_t j, std::int64_t k = 0) {
        return uniform_ ? run_->number(0, "p") : run_->field(0, "p").at(i, j, k);
    }
    float number() { return at(0, 0); }
    std::size_t count_ones(std::int64_t width, std::int64_t height) {
        std::size_t count = 0;
        for (std::int64_t j = 0; j < height; ++j) {
            for (std::int64_t i = 0; i < width; ++i) count += at(i, j) == 1.0f;
        }
        return count;
    }

private:
    std::unique_ptr<Checked> checked_;
    std::unique_ptr<ScriptRun> run_;
    bool uniform_ = false;
};

TEST(Lower, OperatorsAndFunctions) {
    const std::pair<const char*, float> cases[] = {
        {"1/8", 0.125f},
        {"0.05 * 1/16", (0.05f * 1.0f) / 16.0f},
        {"2 - 3 - 4", -5.0f},
        {"-2^2", -4.0f},
        {"2^-1", 0.5f},
        {"2^3^2", 512.0f},
        {"(1 < 2) + (2 < 1) + (2 <= 2) + (3 > 2) + (2 >= 3)", 3.0f},
        {"(1 == 1) + (1 != 1)", 1.0f},
        {"(1 and 0) + (1 or 0) + (not 1)", 1.0f},
        {"if(2, 3, 4) + if(0, 10, 20)", 23.0f},
        {"min(3, 2) + 10 * max(3, 2)", 32.0f},
        {"clamp(5, 1, 3) + 10 * clamp(0, 1, 3) + 100 * clamp(2, 1, 3)", 213.0f},
        {"mix(1, 3, 0.25)", 1.5f},
        {"step(2, 1) + 10 * step(2, 2) + 100 * step(2, 3)", 110.0f},
        {"smoothstep(1, 3, 2)", 0.5f},
        {"mod(-7, 3) + 10 * floor(-0.5) + 100 * ceil(0.5) + 1000 * round(2.5)", 2092.0f},
        {"sign(-3) + 10 * pow(2, 3) + 100 * hypot(3, 4) + 1000 * cbrt(27)", 3579.0f},
        {"tan(0) + asin(0) + acos(1) + atan(0) + atan2(0, 1) + sinh(0) + cosh(0)", 1.0f},
        {"abs(-3) + sqrt(16)", 7.0f},
    };
    for (const auto& [text, value] : cases) EXPECT_EQ(Values("", text).number(), value) << text;
    EXPECT_NEAR(Values("", "exp(1)").number(), std::exp(1.0), 1e-6);
    EXPECT_NEAR(Values("", "log(10)").number(), std::log(10.0), 1e-6);
    EXPECT_NEAR(Values("", "sin(1) + 10 * cos(1)").number(), std::sin(1.0) + 10 * std::cos(1.0),
                1e-5);
    EXPECT_NEAR(Values("", "tanh(0.5)").number(), std::tanh(0.5), 1e-6);
    EXPECT_NEAR(Values("", "2^0.5").number(), std::sqrt(2.0), 1e-6);
    EXPECT_EQ(Values("", "pi").number(), 3.14159265f);
}

TEST(Lower, Coordinates) {
    for (const auto& [i, j] : {std::pair{0, 0}, {7, 3}, {2, 1}}) {
        EXPECT_FLOAT_EQ(Values(small_grid, "x").at(i, j), (static_cast<float>(i) + 0.5f) / 8);
        EXPECT_FLOAT_EQ(Values(small_grid, "y").at(i, j), (static_cast<float>(j) + 0.5f) / 8);
        EXPECT_FLOAT_EQ(Values(small_grid, "sx").at(i, j), (static_cast<float>(i) + 0.5f) / 8);
        EXPECT_FLOAT_EQ(Values(small_grid, "sy").at(i, j), (static_cast<float>(j) + 0.5f) / 4);
    }
}

/// Cells whose centre is within r, by looking at the nine nearest images of the disc.
std::size_t disc_cells(int width, int height, double x, double y, double r, bool periodic) {
    const double side = std::max(width, height);
    std::size_t count = 0;
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            bool inside = false;
            for (int image = 0; image < 9; ++image) {
                if (!periodic && image != 4) continue;
                const double dx = (i + 0.5) / side - x + (image % 3 - 1) * width / side;
                const double dy = (j + 0.5) / side - y + (image / 3 - 1) * height / side;
                inside = inside || dx * dx + dy * dy < r * r;
            }
            count += inside;
        }
    }
    return count;
}

TEST(Lower, ShapesAreThoseOfGeometry) {
    const std::string grid = "domain { grid: 40, 20 }\n";
    const auto count = [&](const std::string& value) {
        return Values(grid, value).count_ones(40, 20);
    };
    EXPECT_EQ(count("ring(0.5, 0.25, 0.15, 0.1)"),
              disc_cells(40, 20, 0.5, 0.25, 0.2, true) - disc_cells(40, 20, 0.5, 0.25, 0.1, true));
    EXPECT_EQ(count("box(0.5, 0.25, 0.2, 0.1)"), 8u * 4u);
    EXPECT_EQ(count("box(0, 0.5, 0.2, 0.1)"), 8u * 4u) << "across periodic sides";
    EXPECT_EQ(count("box(0.5, 0.1, 2, 0.1)"), 40u * 4u) << "a band";
    EXPECT_EQ(count("stripe(0.5, 0.2)"), 8u * 20u);
    EXPECT_EQ(count("stripe(-0.05, 0.2)"), 8u * 20u);
    EXPECT_EQ(count("stripe(0.25, 0.1, pi/2)"), 40u * 4u);
    EXPECT_EQ(count("stripe(0.5, 0.1, 0)"), 4u * 20u);
    EXPECT_EQ(count("disc(0.5, 0.25, 0.7, 0.113)"), count("disc(0.5, 0.25, 0.113)"))
        << "a plane has no depth";
    EXPECT_EQ(count("ring(0.5, 0.25, 0.7, 0.15, 0.1)"), count("ring(0.5, 0.25, 0.15, 0.1)"));
    EXPECT_EQ(count("box(0.5, 0.25, 9, 0.2, 0.1, 0.01)"), 8u * 4u);
    EXPECT_EQ(Values("domain { grid: 40, 20; boundary: noflux }\n", "box(0, 0.5, 0.2, 0.1)")
                  .count_ones(40, 20),
              4u * 2u);
    const double dx = 0.4125 - 0.5, dy = 0.0875 - 0.4 + 0.5;
    EXPECT_NEAR(Values(grid, "gauss(0.5, 0.4, 0.1)").at(16, 3),
                std::exp(-(dx * dx + dy * dy) / 0.02), 1e-6);
}

TEST(Lower, ShapesInSpace) {
    const std::string grid = "domain { grid: 20, 16, 12 }\n";
    Values ball(grid, "disc(0.5, 0.4, 0.1, 0.24)");
    Values cylinder(grid, "disc(0.5, 0.4, 0.24)");
    for (int k = 0; k < 12; ++k) {
        for (int j = 0; j < 16; ++j) {
            for (int i = 0; i < 20; ++i) {
                const double dx = (i + 0.5) / 20 - 0.5, dy = (j + 0.5) / 20 - 0.4;
                double dz = (k + 0.5) / 20 - 0.1;
                if (dz > 0.3) dz -= 0.6;
                const double across = dx * dx + dy * dy;
                EXPECT_EQ(cylinder.at(i, j, k), across < 0.0576 ? 1 : 0) << i << " " << j;
                EXPECT_EQ(ball.at(i, j, k), across + dz * dz < 0.0576 ? 1 : 0) << i << " " << j;
            }
        }
    }
    Values draws(grid, "random(0, 1)");
    Values plane("domain { grid: 20, 16 }\n", "random(0, 1)");
    EXPECT_EQ(draws.at(7, 3, 0), plane.at(7, 3)) << "the first slice is the plane";
    EXPECT_NE(draws.at(7, 3, 1), plane.at(7, 3));
}

TEST(Lower, RandomFunctionsOfOneExpressionAreTold) {
    // The first of two equal calls, alone, draws the same numbers; the second others.
    const std::string grid = "domain { grid: 8, 4; seed: 5 }\n";
    EXPECT_EQ(Values(grid, "normal(0, 1) + 0 * normal(0, 1)").at(3, 2),
              Values(grid, "normal(0, 1)").at(3, 2));
    EXPECT_NE(Values(grid, "0 * random(0, 1) + normal(0, 1)").at(3, 2),
              Values(grid, "normal(0, 1)").at(3, 2));
    EXPECT_NE(Values(grid, "0 * lattice(0.5, 0.1) + noise(0.3)").at(3, 2),
              Values(grid, "noise(0.3)").at(3, 2));
}

TEST(Lower, WhiteNoiseDoesNotDependOnTheStep) {
    for (const std::string speed : {"1", "0.25", "0.01"}) {
        const auto checked = check_text(
            "domain { grid: 64, 64 }\nsystem s { u: 0; k: 3; u' = white(k) }\n"
            "stage one: s { speed: " +
            speed + "; iterations: 1 }\n");
        ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        ScriptRun run(*checked->program);
        run.start(0);
        const Field rate = run.rates(0)[0].clone();
        double squares = 0;
        for (int k = 0; k < 4096; ++k) squares += std::pow(rate.at(k % 64, k / 64), 2) / 4096;
        // What one unit of time adds has the variance k², within five deviations.
        EXPECT_NEAR(squares * std::stod(speed), 9, 9 * 5 * std::sqrt(2.0 / 4096)) << speed;
    }
}

TEST(Lower, Discs) {
    const std::string grid = "domain { grid: 40, 20 }\n";
    const std::string closed = "domain { grid: 40, 20; boundary: noflux }\n";
    EXPECT_EQ(Values(grid, "disc(0.5, 0.25, 0.113)").count_ones(40, 20),
              disc_cells(40, 20, 0.5, 0.25, 0.113, true));
    EXPECT_EQ(Values(grid, "disc(0.03, 0.48, 0.113)").count_ones(40, 20),
              disc_cells(40, 20, 0.03, 0.48, 0.113, true));
    EXPECT_EQ(Values(grid, "disc(3.03, -1.02, 0.113)").count_ones(40, 20),
              disc_cells(40, 20, 0.03, 0.48, 0.113, true))
        << "whole periods make no difference";
    EXPECT_EQ(Values(closed, "disc(0.03, 0.48, 0.113)").count_ones(40, 20),
              disc_cells(40, 20, 0.03, 0.48, 0.113, false));
    EXPECT_EQ(Values("domain { grid: 40 }\n", "disc(0.5, 0.5, 0.1)").count_ones(40, 1), 8u)
        << "an interval on a line";
}

TEST(Lower, RandomNumbers) {
    Values first("domain { grid: 64, 64 }\n", "random(12, 3)");
    double sum = 0, squares = 0;
    std::set<float> different;
    for (int j = 0; j < 64; ++j) {
        for (int i = 0; i < 64; ++i) {
            const double value = first.at(i, j);
            EXPECT_LT(std::abs(value - 12), 3.00001);
            sum += value - 12;
            squares += (value - 12) * (value - 12);
            different.insert(first.at(i, j));
        }
    }
    // Mean 0 and variance s²/3 within five standard errors of 4096 draws.
    EXPECT_LT(std::abs(sum / 4096), 5 * 3 / std::sqrt(3.0 * 4096));
    EXPECT_NEAR(squares / 4096, 3.0, 5 * 3 * 0.298 * 3 / 64);
    EXPECT_GT(different.size(), 4000u);
}

TEST(Lower, RandomNumbersDependOnTheirPlaceInTheScriptOnly) {
    const auto value = [](const std::string& text, const std::string& name) {
        const auto checked = check_text("domain { grid: 8, 8; seed: 3 }\n" + text);
        EXPECT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        ScriptRun run(*checked->program);
        run.start(0);
        return run.field(0, name).at(5, 2);
    };
    const std::string one = "stage one: turing_spots { beta: random(1, 0.5) }";
    const float beta = value(one, "beta");
    EXPECT_EQ(value("stage one: turing_spots { a: random(3, 1); beta: random(1, 0.5) }", "beta"),
              beta);
    EXPECT_NE(value("stage two: turing_spots { beta: random(1, 0.5) }", "beta"), beta);
    EXPECT_NE(value("stage one: turing_spots { ka: random(1, 0.5) }", "ka"), beta);
    EXPECT_NE(value("stage one: turing_spots { beta: 0 * random(1, 0.5) + random(1, 0.5) }",
                    "beta"),
              beta);
    EXPECT_EQ(value("stage one: turing_spots { beta: random(1, 0.5) + 0 * random(1, 0.5) }",
                    "beta"),
              beta);
}

TEST(Lower, NoiseInRatesIsNewInEveryStep) {
    const auto checked =
        check_text(small_grid +
                   "system s { u: 0; v: 0; noise = random(0, 1); u' = noise; v' = noise }\n"
                   "stage one: s {}\n");
    ASSERT_TRUE(checked->program);
    ScriptRun run(*checked->program);
    run.start(0);
    run.step(0);
    const float first = run.field(0, "u").at(3, 1);
    EXPECT_EQ(run.field(0, "v").at(3, 1), first) << "a definition is drawn once";
    run.step(0);
    EXPECT_NE(run.field(0, "u").at(3, 1) - first, first);
    EXPECT_NE(first, 0.0f);
}

TEST(Lower, StepsClampAndFreeze) {
    const auto checked = check_text(
        small_grid +
        "system s { u: sx; low: 0.2; rate: 3; u' = -rate; u >= low; u <= 0.6; speed: 0.125 }\n"
        "stage one: s { frozen: y > 0.25 }\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    ScriptRun run(*checked->program);
    run.start(0);
    run.step(0);
    for (int i = 0; i < 8; ++i) {
        const float start = (static_cast<float>(i) + 0.5f) / 8;
        EXPECT_EQ(run.field(0, "u").at(i, 0), std::clamp(start - 0.375f, 0.2f, 0.6f));
        EXPECT_EQ(run.field(0, "u").at(i, 3), start) << "frozen";
    }
    const BoundKernel step = only_pass(plan_step(*checked->program, 0));
    ASSERT_EQ(step.masks.size(), 1u);
    EXPECT_THAT(step.kernel.mask_names, ElementsAre("frozen"));
    EXPECT_THAT(step.kernel.field_names, ElementsAre("u"));
    EXPECT_THAT(step.kernel.uniform_names, ::testing::UnorderedElementsAre("rate", "speed", "low"));
    EXPECT_THAT(step.results, ElementsAre(ItemId(0)));
}

TEST(Lower, UniformFrozenIsNotInTheKernel) {
    const auto checked = check_text("system_name: turing_spots\nfrozen: 1\n");
    ASSERT_TRUE(checked->program);
    const BoundKernel step = only_pass(plan_step(*checked->program, 0));
    EXPECT_TRUE(step.masks.empty());
    EXPECT_THAT(step.kernel.uniform_names, ::testing::Not(::testing::Contains("frozen")));
}

TEST(Lower, TimeAndStep) {
    const auto checked = check_text(
        small_grid + "system s { u: 0; v: 0; u' = step; v' = t }\nstage one: s { speed: 0.5 }\n");
    ASSERT_TRUE(checked->program);
    ScriptRun run(*checked->program);
    run.start(0);
    run.step(0, 4);
    EXPECT_EQ(run.field(0, "u").at(2, 2), 0.5f * (0 + 1 + 2 + 3));
    EXPECT_EQ(run.field(0, "v").at(2, 2), 0.5f * 0.5f * (0 + 1 + 2 + 3));
}

TEST(Lower, RatesReadRates) {
    const auto checked =
        check_text(small_grid +
                   "system s { u: 1; v: 2; u' = 2 * v' + d; d = w'; v' = 3; w: 0; w' = v' + 1 }\n"
                   "stage one: s {}\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    ScriptRun run(*checked->program);
    run.start(0);
    const std::vector<Field> rates = run.rates(0);
    ASSERT_EQ(rates.size(), 3u);
    EXPECT_EQ(rates[0].at(0, 0), 10.0f);
    EXPECT_EQ(rates[1].at(0, 0), 3.0f);
    EXPECT_EQ(rates[2].at(0, 0), 4.0f);
}

TEST(Lower, StagesReadEarlierStages) {
    const auto checked =
        check_text(small_grid +
                   "system s { u: 0; p: 0; u' = 1 + 0 * p }\n"
                   "stage one: s { u: x; p: 7 }\n"
                   "stage two: s { frozen: u > 1.3; u: if([frozen], u, [p]); p: p + 1 }\n"
                   "stage three: s { u: one.u + two.frozen; p: frozen }\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    ScriptRun run(*checked->program);
    run.start(0);
    run.step(0);
    run.start(1);
    EXPECT_EQ(run.number(1, "p"), 8.0f);
    run.step(1);
    run.start(2);
    for (int i = 0; i < 8; ++i) {
        const float x = (static_cast<float>(i) + 0.5f) / 8;
        const bool frozen = x + 1 > 1.3f;
        EXPECT_EQ(run.field(0, "u").at(i, 1), x + 1);
        EXPECT_EQ(run.field(1, "u").at(i, 1), frozen ? x + 1 : 9.0f);
        EXPECT_EQ(run.field(2, "u").at(i, 1), x + 1 + (frozen ? 1.0f : 0.0f));
        EXPECT_EQ(run.field(2, "p").at(i, 1), frozen ? 1.0f : 0.0f);
    }
}

TEST(Lower, Files) {
    const auto checked = check_text(
        small_grid +
        "system s { u: 0; u' = 1 }\n"
        "stage one: s { u: 2 * field(\"a.npy\") + field(\"b.npy\") - field(\"a.npy\") }");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    EXPECT_EQ(only_pass(plan_start(*checked->program, 0)).fields.size(), 2u);
    ScriptRun run(*checked->program);
    for (const char* name : {"a.npy", "b.npy"}) {
        run.files.emplace(name, Field(PlaneLayout(checked->program->domain.grid)));
    }
    run.files["a.npy"].at(3, 2) = 5;
    run.files["b.npy"].at(3, 2) = 0.5;
    run.start(0);
    EXPECT_EQ(run.field(0, "u").at(3, 2), 5.5f);
    EXPECT_EQ(run.field(0, "u").at(2, 2), 0.0f);
}

TEST(Lower, Colours) {
    const auto colour_of = [](const std::string& formula) {
        const auto checked = check_text(small_grid +
                                        "system s { u: sx; v: 0; u' = 1; v' = 1 }\n"
                                        "stage one: s { show: " +
                                        formula + " }\n");
        EXPECT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        ScriptRun run(*checked->program);
        run.start(0);
        std::vector<float> channels;
        for (const Field& field : run.view(checked->program->stages[0].show, 0)) {
            channels.push_back(field.at(3, 0));
        }
        return channels;
    };
    EXPECT_THAT(colour_of("u"), ElementsAre(0.4375f));
    EXPECT_THAT(colour_of("rgb(1, 2 * u, -1)"), ElementsAre(1, 0.875f, -1));
    EXPECT_THAT(colour_of("if(u < 0.5, rgb(1, 2, 3), rgb(4, 5, 6))"), ElementsAre(1, 2, 3));
    EXPECT_THAT(colour_of("mix(rgb(0, 1, 2), rgb(4, 5, 10), 0.25)"), ElementsAre(1, 2, 4));
    EXPECT_THAT(colour_of("mix(10, 20, u)"), ElementsAre(14.375f));
    EXPECT_THAT(colour_of("palette(v / v, 0, 1, \"grey\")"), ElementsAre(1, 0, 1)) << "NaN";
}

TEST(Lower, PalettesAreThoseOfTheTable) {
    for (const Palette& palette : palettes()) {
        const auto checked =
            check_text(fmt::format("domain {{ grid: 97 }}\nsystem s {{ u: 4 * sx - 1; u' = 1 }}\n"
                                   "stage one: s {{ show: palette(u, 0, 2, \"{}\") }}\n",
                                   palette.name));
        ASSERT_TRUE(checked->program);
        ScriptRun run(*checked->program);
        run.start(0);
        const std::vector<Field> colour = run.view(checked->program->stages[0].show, 0);
        for (int i = 0; i < 97; ++i) {
            const double position = (4 * (i + 0.5) / 97 - 1) / 2;
            const Colour expected = colour_at(palette, position);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(colour[channel].at(i, 0), expected[channel], 2e-5)
                    << palette.name << " at " << position;
            }
        }
    }
}

TEST(Lower, UniformParametersAreSlotsAndNeverConstants) {
    const auto checked = check_text("system_name: turing_spots\n");
    ASSERT_TRUE(checked->program);
    const BoundKernel step = only_pass(plan_step(*checked->program, 0));
    EXPECT_THAT(step.kernel.uniform_names,
                ::testing::UnorderedElementsAre("speed", "ka", "diff_a", "diff_b"));
    EXPECT_THAT(step.kernel.field_names, ElementsAre("a", "b", "beta"));
    EXPECT_TRUE(step.kernel.reads_neighbours(FieldSlot(0)));
    EXPECT_FALSE(step.kernel.reads_neighbours(FieldSlot(2)));
    const BoundKernel view =
        only_pass(plan_view(*checked->program, checked->program->stages[0].show, 0));
    EXPECT_THAT(view.kernel.field_names, ElementsAre("b"));
}

TEST(Lower, LongFormulas) {
    std::string chain = "1";
    for (int i = 1; i < 1'000'000; ++i) chain += "+x";
    Values values(small_grid, chain);
    EXPECT_GT(values.at(4, 0), 1.0f);
    std::string deep;
    for (int i = 0; i < 100'000; ++i) deep += "1-(";
    EXPECT_EQ(Values(small_grid, deep + "x" + std::string(100'000, ')')).at(0, 0), 0.0625f);
    std::string definitions = "system s { u: 1; u' = d99999; d0 = u\n";
    for (int i = 1; i < 100'000; ++i) definitions += fmt::format("d{} = d{} + 1\n", i, i - 1);
    const auto checked = check_text(definitions + "}\nstage one: s {}\n");
    ASSERT_TRUE(checked->program);
    EXPECT_EQ(verify(only_pass(plan_step(*checked->program, 0)).kernel), "");
}

}  // namespace
}  // namespace cascade::testing
