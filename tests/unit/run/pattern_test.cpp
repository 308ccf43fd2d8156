// The public library.

#include "cascade/cascade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace cascade {
namespace {

constexpr const char* spots_in_two_stages =
    "domain { grid: 20, 12 }\n"
    "stage one: turing_spots { iterations: 30 }\n"
    "stage two: turing_spots { iterations: 20; a: a; b: b; beta: beta }\n";

TEST(Pattern, StepsThroughTheStages) {
    Pattern pattern(spots_in_two_stages);
    ASSERT_TRUE(pattern.ok()) << pattern.messages() << pattern.error();
    EXPECT_EQ(pattern.width(), 20);
    EXPECT_EQ(pattern.height(), 12);
    EXPECT_EQ(pattern.stages(), (std::vector<std::string>{"one", "two"}));
    EXPECT_EQ(pattern.species("one"), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(pattern.current_stage(), "one");
    EXPECT_EQ(pattern.step(10), 10);
    EXPECT_EQ(pattern.steps(), 10);
    EXPECT_EQ(pattern.step(25), 25);
    EXPECT_EQ(pattern.current_stage(), "two");
    EXPECT_EQ(pattern.steps(), 5);
    EXPECT_EQ(pattern.step(1000), 15);
    EXPECT_TRUE(pattern.finished());
    EXPECT_EQ(pattern.step(1), 0);
}

TEST(Pattern, StepsDoNotDependOnHowTheyAreCounted) {
    Pattern at_once(spots_in_two_stages);
    at_once.step(50);
    Pattern one_by_one(spots_in_two_stages);
    while (one_by_one.step(1) == 1) {
    }
    EXPECT_EQ(at_once.values("b"), one_by_one.values("b"));
}

TEST(Pattern, IsChangedWhileItRuns) {
    Pattern pattern(spots_in_two_stages);
    pattern.step(10);
    EXPECT_TRUE(pattern.set("one.ka", "1/40")) << pattern.error();
    EXPECT_TRUE(pattern.paint("b", "if(disc(0.3, 0.3, 0.2) > 0, 8, b)")) << pattern.error();
    EXPECT_EQ(pattern.values("max(b over domain)")[0], 8);
    pattern.step(5);
    EXPECT_TRUE(pattern.begin_next_stage()) << pattern.error();
    EXPECT_EQ(pattern.current_stage(), "two");
    pattern.step(3);
    EXPECT_EQ(Pattern::play(pattern.session()).values("b"), pattern.values("b"));
    EXPECT_TRUE(pattern.undo());
    EXPECT_EQ(pattern.current_stage(), "one");
    EXPECT_EQ(pattern.steps(), 15);
    EXPECT_TRUE(pattern.redo());
    EXPECT_EQ(pattern.current_stage(), "two");
    EXPECT_FALSE(pattern.redo());
    EXPECT_TRUE(pattern.ok());
}

TEST(Pattern, AChangeThatIsRefusedSaysWhy) {
    Pattern pattern(spots_in_two_stages);
    pattern.step(10);
    const std::vector<float> before = pattern.values("b");
    EXPECT_FALSE(pattern.set("one.kaa", "1"));
    EXPECT_NE(pattern.error().find("kaa"), std::string::npos);
    EXPECT_FALSE(pattern.set_script("stage x: nobody {}"));
    EXPECT_NE(pattern.error().find("nobody"), std::string::npos);
    EXPECT_TRUE(pattern.ok());
    EXPECT_EQ(pattern.values("b"), before);
    EXPECT_FALSE(Pattern("nonsense").set("a", "1"));
    EXPECT_FALSE(Pattern::play("nonsense").ok());
}

/// The bits of an expression's values in all cells. Bits are compared because cells outside of a
/// mask are NaN, which equals no number.
std::vector<std::uint32_t> bits_of(Pattern& pattern, const std::string& expression) {
    std::vector<std::uint32_t> bits;
    for (const float value : pattern.values(expression)) {
        bits.push_back(std::bit_cast<std::uint32_t>(value));
    }
    return bits;
}

/// However many steps a call takes, results are the same. This holds for all ways to choose steps
/// and to end stages, for rates that change with time, and if values are read between the calls.
TEST(Pattern, NoResultDependsOnHowManyStepsAreTakenAtOnce) {
    const std::string system =
        "system s { u: 1 + 0.3 * sin(7 * x + 3 * y); v: 0.5 + 0.2 * cos(9 * y); k: 0.1 + 0.1 * x\n"
        "  u' = 0.2 * lap(u) + k * (v - u) + 0.01 * exp(k) * sin(t)\n"
        "  v' = 0.1 * lap(v) - 0.1 * (v - mean(u over domain)) }\n";
    const std::string grid = "domain { grid: 24, 18 }\n";
    const std::string sides =
        "domain { grid: 24, 18; boundary: noflux }\n"
        "system s { u: 1; u' = 0.2 * lap(u); u.left: fixed(sin(t) * y); u.right: slope(0.1 * t) }\n";
    std::vector<std::string> scripts;
    for (const char* how :
         {"iterations: 90", "iterations: 90; solver: symplectic", "iterations: 60; solver: rk4",
          "iterations: 40; speed: 2; solver: rkl1", "iterations: 40; speed: 2; solver: rkl2",
          "iterations: 40; solver: etdrk4", "iterations: 40; solver: gauss",
          "duration: 45.5; speed: 0.7", "duration: 40; solver: rk45", "duration: 40; solver: rk23",
          "duration: 40; speed: auto", "duration: 60; speed: auto; solver: rkl2",
          "duration: 60; speed: auto; solver: imex", "iterations: 400; until: steady(0.05)",
          "iterations: 400; until: mean(u over domain) < 0.9",
          "iterations: 60; speed: 0.5 + 0.2 * x", "iterations: 60; frozen: x > 0.6",
          "iterations: 20; frozen: 1 > 0"}) {
        scripts.push_back(grid + system + "stage one: s { " + how + " }\n");
    }
    for (const char* how : {"iterations: 70", "duration: 30; speed: auto; solver: rkl1"}) {
        scripts.push_back(sides + "stage one: s { " + how + " }\n");
    }
    scripts.push_back(
        "domain { grid: 24, 18; mask: x + y > 0.5 }\n" + system +
        "stage one: s { iterations: 50 }\nstage two: s { iterations: 30; u: one.u }\n");
    scripts.push_back(
        "domain { grid: 16, 16 }\nstage one: turing_spots { start: coarse(2)\n"
        "  iterations: 40; ka: 1/80 }\n");
    scripts.push_back(
        "domain { grid: 16, 16 }\nsystem s { u: random(0, 1)\n"
        "  u' = 0.1 * lap(u) + random(-0.1, 0.1) }\nstage one: s { iterations: 50 }\n");
    for (const std::string& script : scripts) {
        Pattern at_once(script), one_by_one(script), looked_at(script);
        ASSERT_TRUE(at_once.ok()) << script << at_once.messages() << at_once.error();
        const std::int64_t steps = at_once.step(100000);
        EXPECT_TRUE(at_once.finished()) << script << at_once.error();
        std::int64_t single = 0, few = 0;
        while (one_by_one.step(1) == 1) ++single;
        for (std::int64_t count = 1; !looked_at.finished() && looked_at.ok();
             count = count % 7 + 1) {
            few += looked_at.step(count);
            EXPECT_FALSE(looked_at.values("lap(u)").empty() && looked_at.values("lap(b)").empty());
        }
        EXPECT_EQ(single, steps) << script;
        EXPECT_EQ(few, steps) << script;
        const std::string name = at_once.species(at_once.current_stage()).front();
        EXPECT_EQ(bits_of(at_once, name), bits_of(one_by_one, name)) << script;
        EXPECT_EQ(bits_of(at_once, name), bits_of(looked_at, name)) << script;
    }
}

TEST(Pattern, GoesOnAfterACancellation) {
    Pattern whole(spots_in_two_stages), cancelled(spots_in_two_stages);
    whole.step(50);
    EXPECT_EQ(cancelled.step(7), 7);
    cancelled.cancel();
    EXPECT_EQ(cancelled.step(3), 3) << "step() begins anew";
    while (!cancelled.finished()) cancelled.step(11);
    EXPECT_EQ(whole.values("b"), cancelled.values("b"));
}

TEST(Pattern, ReadsExpressions) {
    Pattern pattern(spots_in_two_stages);
    pattern.step(40);
    const auto b = pattern.values("b");
    const auto twice = pattern.values("2 * b - one.b");
    const auto earlier = pattern.values("one.b");
    ASSERT_EQ(b.size(), 240u);
    ASSERT_EQ(twice.size(), 240u);
    for (std::size_t c = 0; c < b.size(); ++c) EXPECT_EQ(twice[c], 2 * b[c] - earlier[c]);
    EXPECT_TRUE(pattern.values("bb").empty());
    EXPECT_NE(pattern.error().find("bb"), std::string::npos);
    EXPECT_TRUE(pattern.ok());
}

TEST(Pattern, TellsWhereAScriptIsWrong) {
    Pattern pattern("stage one: turing_spots { kaa: 1 }\n");
    EXPECT_FALSE(pattern.ok());
    const auto messages = pattern.diagnostics();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_TRUE(messages[0].is_error);
    EXPECT_EQ(messages[0].line, 1);
    EXPECT_EQ(messages[0].column, 27);
    EXPECT_EQ(pattern.step(1), 0);
}

TEST(Pattern, TellsWhyARunFailed) {
    Pattern pattern(
        "system bomb { u: 1; u' = u * u * u }\n"
        "stage one: bomb { iterations: 1000 }\n");
    ASSERT_TRUE(pattern.ok());
    EXPECT_LT(pattern.step(1000), 1000);
    EXPECT_FALSE(pattern.ok());
    EXPECT_NE(pattern.error().find("not finite"), std::string::npos);
}

constexpr const char* bomb =
    "domain { grid: 16, 16 }\n"
    "system bomb { u: 1 + 0.1*x; u' = 0.02 * u * u * u }\n"
    "stage one: bomb { iterations: 1000 }\n";

TEST(Pattern, StepsOneByOneFailAsStepsAtOnceDo) {
    Pattern at_once(bomb), one_by_one(bomb);
    at_once.step(1000);
    EXPECT_FALSE(at_once.ok());
    int calls = 0;
    for (; one_by_one.ok(); ++calls) EXPECT_GE(one_by_one.step(1), 0);
    EXPECT_EQ(one_by_one.steps(), at_once.steps());
    EXPECT_EQ(one_by_one.error(), at_once.error());
    EXPECT_LE(calls, at_once.steps() + 64);
}

TEST(Pattern, ValuesAreOnlyReadWhereAllAreFinite) {
    Pattern at_once(bomb), one_by_one(bomb);
    at_once.step(1000);
    const std::int64_t last = at_once.steps();
    for (std::int64_t step = 0; step < last; ++step) one_by_one.step(1);
    EXPECT_FALSE(one_by_one.values("u").empty());
    EXPECT_TRUE(one_by_one.ok());
    EXPECT_EQ(one_by_one.step(1), 1);
    EXPECT_TRUE(one_by_one.values("u").empty());
    EXPECT_FALSE(one_by_one.ok());
    EXPECT_EQ(one_by_one.steps(), last);
    EXPECT_EQ(one_by_one.error(), at_once.error());
}

TEST(Pattern, APictureCarriesTheSession) {
    Pattern pattern(spots_in_two_stages);
    pattern.step(10);
    pattern.paint("b", "b + disc(0.3, 0.3, 0.2)");
    pattern.step(5);
    const std::string picture = pattern.picture();
    Pattern again = Pattern::play(picture);
    ASSERT_TRUE(again.ok()) << again.error();
    EXPECT_EQ(again.steps(), 15);
    EXPECT_EQ(again.values("b"), pattern.values("b"));
    EXPECT_EQ(again.picture(), picture);
    EXPECT_NE(again.picture("a"), picture);
    EXPECT_EQ(again.picture("nobody"), "");
    EXPECT_NE(again.error().find("nobody"), std::string::npos);
    EXPECT_TRUE(again.ok());
    EXPECT_FALSE(Pattern::play(picture.substr(0, 100)).ok());
}

TEST(Pattern, IsTheSameInterpretedAndCompiled) {
    PatternOptions interpreted;
    interpreted.native_code = false;
    Pattern first(spots_in_two_stages, interpreted);
    Pattern second(spots_in_two_stages);
    first.step(50);
    second.step(50);
    EXPECT_EQ(first.values("a"), second.values("a"));
}

TEST(Pattern, AViewLiesInThePatternsMemoryAndKeepsItsMoment) {
    Pattern pattern(spots_in_two_stages);
    pattern.step(10);
    const PatternView first = pattern.view("b"), second = pattern.view("b");
    ASSERT_NE(first.data, nullptr) << pattern.error();
    EXPECT_EQ(first.data, second.data);
    EXPECT_FALSE(first.is_computed);
    EXPECT_EQ(first.moment, pattern.moment());
    EXPECT_TRUE(pattern.view("2 * b").is_computed);
    EXPECT_TRUE(pattern.view("ka").is_computed);
    const std::vector<float> before = pattern.values("b");
    pattern.step(1);
    EXPECT_NE(first.moment, pattern.moment());
    EXPECT_NE(pattern.values("b"), before);
    pattern.paint("b", "0");
    pattern.step(100);
    pattern = Pattern("nonsense");
    const auto at = [&](std::int64_t column, std::int64_t row) {
        return reinterpret_cast<const float*>(static_cast<const char*>(first.data) +
                                              row * first.row_bytes)[column];
    };
    for (std::int64_t row = 0; row < 12; ++row) {
        for (std::int64_t i = 0; i < 20; ++i) {
            EXPECT_EQ(at(i, row), before[static_cast<std::size_t>(20 * row + i)]);
        }
    }
}

/// Views that a caller keeps during later steps change no result.
TEST(Pattern, NoResultDependsOnViewsThatAreKept) {
    for (const char* how : {"iterations: 90", "iterations: 40; solver: rk4",
                            "duration: 30; solver: rk45", "iterations: 400; until: steady(0.05)",
                            "iterations: 30; solver: etdrk4", "iterations: 40; frozen: x > 0.6"}) {
        const std::string script =
            "domain { grid: 24, 18 }\n"
            "system s { u: 1 + 0.3 * sin(7 * x + 3 * y); u' = 0.2 * lap(u) - 0.1 * u * u }\n"
            "stage one: s { " +
            std::string(how) + " }\n";
        Pattern alone(script), looked_at(script);
        alone.run();
        std::vector<PatternView> kept;
        std::vector<std::vector<float>> values;
        while (looked_at.step(7) > 0) {
            kept.push_back(looked_at.view("u"));
            values.push_back(looked_at.values("u"));
        }
        EXPECT_EQ(bits_of(alone, "u"), bits_of(looked_at, "u")) << how;
        ASSERT_FALSE(kept.empty());
        for (std::size_t k = 0; k < kept.size(); ++k) {
            EXPECT_EQ(*static_cast<const float*>(kept[k].data), values[k].front()) << how;
        }
    }
}

TEST(Pattern, NumbersAreNotRounded) {
    Pattern pattern(
        "domain { grid: 8, 8; precision: double }\n"
        "system s { u: 1/3; u' = lap(u) }\nstage one: s { iterations: 3 }\n");
    EXPECT_EQ(pattern.numbers("u").front(), 1.0 / 3);
    EXPECT_EQ(pattern.values("u").front(), 1.0F / 3);
    EXPECT_EQ(pattern.view("u").number, PatternView::Number::binary64);
}

/// With a mask or on a model, a view is computed, in the order of values().
TEST(Pattern, AViewHasTheOrderAndTheGapsOfValues) {
    for (const char* domain : {"domain { grid: 20, 12; mask: x + y > 0.5 }\n",
                               "domain { surface: sphere; cells: 300 }\n"}) {
        Pattern pattern(std::string(domain) + "stage one: turing_spots { iterations: 5 }\n");
        pattern.step(5);
        const PatternView view = pattern.view("b");
        ASSERT_NE(view.data, nullptr) << pattern.messages() << pattern.error();
        EXPECT_TRUE(view.is_computed);
        EXPECT_EQ(view.width, pattern.width());
        const std::vector<float> values = pattern.values("b");
        const auto* const row = static_cast<const float*>(view.data);
        for (std::int64_t i = 0; i < view.width; ++i) {
            const float value = values[static_cast<std::size_t>(i)];
            EXPECT_TRUE(row[i] == value || (row[i] != row[i] && value != value));
        }
    }
}

TEST(Pattern, TellsItsParametersAndTakesNumbers) {
    Pattern pattern(
        "system s { ## Speed.\n rate: 0.1 in 0 .. 1 step 0.05\n u: x\n u' = rate * lap(u) }\n"
        "stage one: s { iterations: 3 }\nstage two: s { iterations: 3 }\n");
    const auto parameters = pattern.parameters();
    ASSERT_EQ(parameters.size(), 2u) << pattern.messages();
    EXPECT_EQ(parameters[0].stage + "." + parameters[0].name, "one.rate");
    EXPECT_EQ(parameters[0].range->step, 0.05);
    EXPECT_EQ(parameters[0].value, 0.1F);
    EXPECT_TRUE(std::isnan(parameters[1].value)) << "its stage has not begun";
    EXPECT_TRUE(pattern.set("one.rate", 1.0 / 3)) << pattern.error();
    EXPECT_EQ(pattern.parameters()[0].value, 1.0F / 3);
    EXPECT_FALSE(pattern.set("one.rate", std::numeric_limits<double>::infinity()));
    EXPECT_NE(pattern.error().find("inf"), std::string::npos);
    EXPECT_FALSE(pattern.set("rote", 1));
    EXPECT_EQ(pattern.problem().line, 1);
    EXPECT_TRUE(pattern.ok());
    PatternOptions options;
    options.sets = {"rate=0.25"};
    EXPECT_EQ(Pattern("stage one: turing_spots { }", options).problem().file, "<--set>");
}

TEST(Pattern, ARunIsWatchedAndEnds) {
    Pattern pattern(spots_in_two_stages);
    EXPECT_FALSE(pattern.run([](const PatternProgress& progress) {
        EXPECT_EQ(progress.stage_count, 2);
        return false;
    }));
    EXPECT_TRUE(pattern.ok());
    EXPECT_TRUE(pattern.run());
    EXPECT_TRUE(pattern.finished());
    EXPECT_FALSE(pattern.features("b").empty());
}

}  // namespace
}  // namespace cascade
