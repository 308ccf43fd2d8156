// The programs that the checker makes of correct texts.
#include "check_helpers.h"
#include "lang/syntax/picture_expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace cascade::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

ItemId item_named(const System& system, const std::string& name) {
    for (const ItemId item : system.items()) {
        if (system.item_name(item) == name) return item;
    }
    ADD_FAILURE() << "no item " << name;
    return {};
}

bool is_uniform(const Program& program, std::uint32_t stage, const std::string& name) {
    return program.stages[stage].uniform[item_named(program.system_of(stage), name)];
}

TEST(CheckProgram, StagesTakeDefaults) {
    const auto checked = check_text("stage one: turing_spots { ka: 3 }\nsystem_name: stripes\n");
    ASSERT_TRUE(checked->program);
    const Program& program = *checked->program;
    ASSERT_EQ(program.stages.size(), 2u);
    EXPECT_EQ(program.stages[0].name, "one");
    EXPECT_EQ(program.stages[1].name, "stage2");
    const System& turing = program.system_of(0);
    EXPECT_EQ(only_number(program.stages[0].items[item_named(turing, "ka")]), 3);
    EXPECT_EQ(only_number(program.stages[0].items[item_named(turing, "a")]), 4);
    EXPECT_EQ(only_number(program.stages[0].items[turing.frozen_item()]), 0);
    EXPECT_EQ(only_number(program.stages[0].items[turing.speed_item()]), 1);
    EXPECT_EQ(program.stages[0].iterations, turing.settings.iterations);
    EXPECT_EQ(program.stages[0].interval, *turing.settings.iterations / 10);
    EXPECT_EQ(program.domain.grid.width, 64);
    EXPECT_EQ(program.domain.seed, 1u);
}

TEST(CheckProgram, SettingsOfSystemsAndStages) {
    const auto checked = check_text(
        "system s { a: 1; k: 2; a' = k * a; iterations: 5; interval: 2; speed: 1/4\n"
        "           frozen: x > 0.5; show: 2 * a }\n"
        "system plain { q: 1; k: 2; u: 1; u' = q + k }\n"
        "stage one: s {}\n"
        "stage two: s { iterations: 2^3; interval: 30; speed: 0.5; show: [k] }\n"
        "stage three: plain { iterations: 7 }\n"
        "stage four: plain {}\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const auto& stages = checked->program->stages;
    EXPECT_EQ(stages[0].iterations, 5);
    EXPECT_EQ(stages[0].interval, 2);
    EXPECT_EQ(stages[0].show.nodes.size(), 3u);
    EXPECT_FALSE(is_uniform(*checked->program, 0, "frozen"));
    EXPECT_TRUE(is_uniform(*checked->program, 0, "speed"));
    EXPECT_EQ(stages[1].iterations, 8);
    EXPECT_EQ(stages[1].interval, 30);
    EXPECT_EQ(only_number(stages[1].items[ItemId(3)]), 0.5);
    ASSERT_EQ(stages[1].show.nodes.size(), 1u);
    EXPECT_TRUE(stages[1].show.nodes.front().is(ItemId(1)));
    EXPECT_EQ(stages[2].iterations, 7);
    EXPECT_EQ(stages[2].interval, 1);
    EXPECT_EQ(stages[3].iterations, 1000);
    EXPECT_EQ(stages[3].interval, 100);
    EXPECT_TRUE(stages[3].show.nodes.front().is(ItemId(2))) << "the first species";
}

TEST(CheckProgram, OrderOfItems) {
    const auto checked = check_text(
        "system_name: autocatalysis\na: [b]\nb: [ai] + [frozen]\nfrozen: [s] > 1\ns: [speed]\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const Stage& stage = checked->program->stages[0];
    const System& system = checked->program->system_of(0);
    ASSERT_EQ(stage.order.size(), system.item_count());
    const auto place = [&](const char* name) {
        return std::find(stage.order.begin(), stage.order.end(), item_named(system, name)) -
               stage.order.begin();
    };
    EXPECT_LT(place("b"), place("a"));
    EXPECT_LT(place("ai"), place("b"));
    EXPECT_LT(place("frozen"), place("b"));
    EXPECT_LT(place("s"), place("frozen"));
    EXPECT_LT(place("speed"), place("s"));
}

TEST(CheckProgram, OrderOfDefinitionsAndRates) {
    const auto checked = check_text(
        "system s { u: 1; v: 2; w: 3\n"
        "  u' = second\n"
        "  second = 2 * first + v'\n"
        "  first = w\n"
        "  v' = w' - first\n"
        "  w' = -w }\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const System& system = system_named(*checked->program, "s");
    ASSERT_EQ(system.definitions.size(), 2u);
    EXPECT_EQ(system.definitions.front().name, "first");
    EXPECT_EQ(system.definitions.back().name, "second");
    EXPECT_THAT(system.rate_order, ElementsAre(ItemId(2), ItemId(1), ItemId(0)));
    EXPECT_TRUE(system.rates.front().nodes.back().is(DefinitionId(1)))
        << "renumbered with the definitions";
}

TEST(CheckProgram, RatesSuperpose) {
    const auto checked =
        check_text("system s { a: 1; a' += 2 * a; a' = a - 3; a' += lap(a) }\nstage one: s {}\n");
    ASSERT_TRUE(checked->program);
    EXPECT_THAT(print_program(*checked->program), HasSubstr("a' = a - 3 + 2 * a + lap(a)\n"));
}

TEST(CheckProgram, UniformAndVarying) {
    const auto checked = check_text(
        "system s { a: 1; a' = a + k1 + k2 + k3 + k4 + k5 + k6 + k7\n"
        "  k1: 1 / 3; k2: k1 + 2; k3: x; k4: k3 * 0; k5: random(1, 0); k6: a; k7: disc(0, 0, 1) }\n"
        "stage one: s {}\n"
        "stage two: s { k1: k1; k2: k3; k3: one.speed; k4: 0; k5: [k4]; k6: one.a; k7: k5 }\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const Program& program = *checked->program;
    const auto uniform = [&](std::uint32_t stage) {
        std::string names;
        for (const ItemId item : program.system_of(stage).items()) {
            if (!program.stages[stage].uniform[item]) continue;
            names += std::string(program.system_of(stage).item_name(item)) + " ";
        }
        return names;
    };
    EXPECT_EQ(uniform(0), "k1 k2 frozen speed ");
    EXPECT_EQ(uniform(1), "k1 k3 k4 k5 frozen speed ");
}

TEST(CheckProgram, WhereNamesGetTheirValues) {
    const auto checked = check_text(
        "stage one: turing_spots {}\n"
        "stage two: turing_spots { frozen: frozen or b < 4; speed: speed }\n"
        "stage three: turing_spots { a: b; b: [a]; ka: one.ka; beta: two.frozen }\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const std::string text = print_program(*checked->program);
    EXPECT_THAT(text, HasSubstr("frozen: one.frozen or one.b < 4  # varies"));
    EXPECT_THAT(text, HasSubstr("speed: one.speed  # uniform"));
    EXPECT_THAT(text, HasSubstr("a: two.b  # species"));
    EXPECT_THAT(text, HasSubstr("b: [a]  # species"));
    EXPECT_THAT(text, HasSubstr("ka: one.ka  # uniform"));
    EXPECT_THAT(text, HasSubstr("beta: two.frozen  # varies"));
}

TEST(CheckProgram, FormulasArePrintedWithTheBracketsTheyNeed) {
    const auto checked = check_text(
        "system_name: turing_spots\n"
        "ka: -(1 - (2 - 3)) * (4 + 5) ^ 2 ^ -1\n"
        "beta: not (1 < 2 and 3 < 4) or (not 1) < 2\n"
        "a: (-x)^2 - -x^2 + 8/(4/2) + if((1 < 2) < 3, min(1, 2), (6))\n");
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const std::string text = print_program(*checked->program);
    EXPECT_THAT(text, HasSubstr("ka: -(1 - (2 - 3)) * (4 + 5) ^ 2 ^ -1  #"));
    EXPECT_THAT(text, HasSubstr("beta: not (1 < 2 and 3 < 4) or (not 1) < 2  #"));
    EXPECT_THAT(text,
                HasSubstr("a: (-x) ^ 2 - -x ^ 2 + 8 / (4 / 2) + if((1 < 2) < 3, min(1, 2), 6)"));
}

TEST(CheckProgram, Overrides) {
    const auto checked = check_text(
        "stage large: turing_spots { ka: 1 }\nstage small: turing_spots { ka: 2; b: b }\n",
        {"small.ka=1/400", "iterations=17", "small.beta=beta + ka", "large.beta=5",
         "large.beta=6"});
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const std::string text = print_program(*checked->program);
    EXPECT_THAT(text, HasSubstr("ka: 1  # uniform"));
    EXPECT_THAT(text, HasSubstr("ka: 1 / 400  # uniform"));
    EXPECT_THAT(text, HasSubstr("beta: 6  # uniform"));
    EXPECT_THAT(text, HasSubstr("beta: large.beta + large.ka  # uniform"));
    EXPECT_EQ(checked->program->stages[0].iterations, 17);
    EXPECT_EQ(checked->program->stages[1].iterations, 17);
}

TEST(CheckProgram, OverridesOfASystem) {
    // A stage has precedence over a system of the same name. The name of a system means all its
    // stages.
    const auto checked =
        check_text("stage one: turing_spots { ka: 1 }\nstage stripes: turing_spots { ka: 2 }\n",
                   {"turing_spots.ka=3", "stripes.beta=4"});
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const std::string text = print_program(*checked->program);
    EXPECT_THAT(text, Not(HasSubstr("ka: 1  #")));
    EXPECT_THAT(text, Not(HasSubstr("ka: 2  #")));
    EXPECT_THAT(text, HasSubstr("ka: 3  # uniform"));
    EXPECT_THAT(text, HasSubstr("beta: 4  # uniform"));
    // The name of a system that no stage uses is refused.
    EXPECT_THAT(check_text("stage one: turing_spots {}", {"autocatalysis.a=1"})->faults(),
                ElementsAre("1:1: there is no stage 'autocatalysis' | write one.a"));
}

TEST(CheckProgram, Domain) {
    const auto checked = check_text("domain { grid: 2*30; boundary: noflux; seed: 7 }");
    ASSERT_TRUE(checked->program);
    EXPECT_EQ(checked->program->domain.grid, (Grid{60, 1, Boundary::no_flux}));
    EXPECT_EQ(checked->program->domain.seed, 7u);
}

TEST(CheckProgram, Views) {
    const auto checked = check_text(
        "stage one: turing_spots {}\nstage two: stripes {}\n"
        "picture { color: palette(one.b, 0, 8, \"grey\") }\n");
    ASSERT_TRUE(checked->program);
    const auto view = [&](const std::string& text, std::uint32_t stage, std::uint32_t last) {
        Diagnostics diagnostics;
        const SourceId id = checked->sources.add("<show>", text);
        const auto expression = parse_expression(id, checked->sources, checked->tree, diagnostics);
        std::string kinds;
        if (!expression) return std::string("unreadable");
        const auto formula = check_view(checked->tree, *expression, stage, last, *checked->program,
                                        checked->sources, diagnostics);
        if (!formula) return diagnostics.sorted().at(0).message;
        for (const Node& node : formula->nodes) {
            const auto* earlier = node.as<StageItem>();
            kinds += node.is<ItemId>() ? fmt::format("own{} ", node.as<ItemId>()->index())
                     : earlier != nullptr
                         ? fmt::format("{}:{} ", earlier->stage, earlier->item.index())
                         : "other ";
        }
        return kinds;
    };
    EXPECT_EQ(view("b - [a] + one.ka + two.c + t", 1, 1),
              "own4 own3 other 0:5 other own5 other other other ");
    EXPECT_EQ(view("two.a", 0, 1), "1:3 ");
    EXPECT_EQ(view("two.a", 0, 0), "stage 'two' has not run yet");
    EXPECT_EQ(view("q", 0, 0), "'q' is not a parameter of turing_spots");
    EXPECT_TRUE(picture_expression(checked->tree).has_value());
    EXPECT_FALSE(picture_expression(ast::Script{}).has_value());
}

TEST(CheckProgram, CheckingAgainAddsNoSources) {
    const auto checked = check_text("system_name: stripes\n");
    const std::size_t sources = checked->sources.size();
    Diagnostics diagnostics;
    ASSERT_TRUE(check(checked->tree, checked->sources, diagnostics));
    EXPECT_EQ(checked->sources.size(), sources);
}

}  // namespace
}  // namespace cascade::test
