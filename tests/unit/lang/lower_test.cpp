// Lowering, tested by the values that the interpreter computes.
#include "lower_helpers.h"

#include "core/palette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace cascade::test {
namespace {

using ::testing::ElementsAre;

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
    for (const auto& [text, value] : cases)
        EXPECT_EQ(FormulaValues("", text).number(), value) << text;
    EXPECT_NEAR(FormulaValues("", "exp(1)").number(), std::exp(1.0), 1e-6);
    EXPECT_NEAR(FormulaValues("", "log(10)").number(), std::log(10.0), 1e-6);
    EXPECT_NEAR(FormulaValues("", "sin(1) + 10 * cos(1)").number(),
                std::sin(1.0) + 10 * std::cos(1.0), 1e-5);
    EXPECT_NEAR(FormulaValues("", "tanh(0.5)").number(), std::tanh(0.5), 1e-6);
    EXPECT_NEAR(FormulaValues("", "2^0.5").number(), std::sqrt(2.0), 1e-6);
    EXPECT_EQ(FormulaValues("", "pi").number(), 3.14159265f);
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
    EXPECT_THAT(step.kernel->mask_names, ElementsAre("frozen"));
    EXPECT_THAT(step.kernel->field_names, ElementsAre("u"));
    EXPECT_THAT(step.kernel->uniform_names,
                ::testing::UnorderedElementsAre("rate", "speed", "low"));
    EXPECT_THAT(step.results, ElementsAre(ItemId(0)));
}

TEST(Lower, UniformFrozenIsNotInTheKernel) {
    const auto checked = check_text("system_name: turing_spots\nfrozen: 1\n");
    ASSERT_TRUE(checked->program);
    const BoundKernel step = only_pass(plan_step(*checked->program, 0));
    EXPECT_TRUE(step.masks.empty());
    EXPECT_THAT(step.kernel->uniform_names, ::testing::Not(::testing::Contains("frozen")));
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
    EXPECT_THAT(step.kernel->uniform_names,
                ::testing::UnorderedElementsAre("speed", "ka", "diff_a", "diff_b"));
    EXPECT_THAT(step.kernel->field_names, ElementsAre("a", "b", "beta"));
    EXPECT_TRUE(step.kernel->reads_neighbours(FieldSlot(0)));
    EXPECT_FALSE(step.kernel->reads_neighbours(FieldSlot(2)));
    const BoundKernel view =
        only_pass(plan_view(*checked->program, checked->program->stages[0].show, 0));
    EXPECT_THAT(view.kernel->field_names, ElementsAre("b"));
}

TEST(Lower, LongFormulas) {
    std::string chain = "1";
    for (int i = 1; i < 1'000'000; ++i) chain += "+x";
    FormulaValues values(small_grid, chain);
    EXPECT_GT(values.at(4, 0), 1.0f);
    std::string deep;
    for (int i = 0; i < 100'000; ++i) deep += "1-(";
    EXPECT_EQ(FormulaValues(small_grid, deep + "x" + std::string(100'000, ')')).at(0, 0), 0.0625f);
    std::string definitions = "system s { u: 1; u' = d99999; d0 = u\n";
    for (int i = 1; i < 100'000; ++i) definitions += fmt::format("d{} = d{} + 1\n", i, i - 1);
    const auto checked = check_text(definitions + "}\nstage one: s {}\n");
    ASSERT_TRUE(checked->program);
    EXPECT_EQ(verify(*only_pass(plan_step(*checked->program, 0)).kernel), "");
}

}  // namespace
}  // namespace cascade::test
