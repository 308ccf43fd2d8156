// Blocks of cells through the front end: the tree, the standard form, the program, the equations.
#include "check_helpers.h"
#include "lang/service/known_names.h"
#include "lang/equations/equations.h"
#include "lang/format/format_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace cascade::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* scale =
    "cells body {\n"
    "  p' += push(0.5)\n"
    "}\n"
    "\n"
    "cells scale: body {\n"
    "  r: 0.02 in 0.005 .. 0.1 step 0.005  ## half as wide as a scale\n"
    "  ripe: 0 after divide\n"
    "  crowd = sum(contact over touching)\n"
    "  p' += -off * normal\n"
    "  turn' += toward(ey, normal)\n"
    "  ripe' = 2 * more(crowd, 2.6) - ripe\n"
    "  divide: ripe > 1\n"
    "  die: crowd > 5\n"
    "}\n"
    "domain { surface: sphere }\n"
    "stage cover: scale { founders: 6; duration: 40 }\n"
    "stage on: scale { ripe: ripe; remove: ripe > 0.5; until: steady(0.01) }\n";

TEST(CellsInTheTree, KeepBasesAndRestarts) {
    const auto script = check_text(
        "cells a { u: 1 in 0 .. 2 after divide }\n"
        "cells b { }\ncells c: a, b { }\n");
    const std::string tree = print_ast(script->tree, script->sources);
    EXPECT_THAT(tree, HasSubstr("cells a  # line 1\n    u: 1 in 0 .. 2 after divide\n"));
    EXPECT_THAT(tree, HasSubstr("cells c: a, b  # line 3\n"));
}

TEST(CellsInTheTree, BeginOnlyWhereABlockMay) {
    for (const char* text : {"system_name: s\ncells: 1\nq: 2 * cells\n",
                             "system s { cells: 1 in 0 .. 2; q = sum(\ncells over domain); "
                             "cells' = cells }\n",
                             "domain { cells: 100; surface: sphere }\n"}) {
        const auto script = check_text(text);
        for (const ast::Block& block : script->tree.blocks) EXPECT_FALSE(block.is_cells) << text;
        for (const std::string& fault : script->faults()) {
            EXPECT_THAT(fault, Not(HasSubstr("block"))) << text;
        }
    }
}

TEST(CellsInTheStandardForm, StayAsTheyAre) {
    Sources sources;
    Diagnostics diagnostics;
    const std::string text =
        "cells thorn:scale ,guide{\n r:0.02 in 0.005 .. 0.1   after   divide\n"
        "  divide :ripe>1\n p' +=stick( 1 )\n}\n";
    EXPECT_EQ(format_script(sources.add("a", text), sources, diagnostics),
              "cells thorn: scale, guide {\n  r: 0.02 in 0.005 .. 0.1 after divide\n"
              "  divide: ripe > 1\n  p' += stick(1)\n}\n");
}

TEST(CellsInTheProgram, HaveAPlaceAFrameARadiusAndAnAge) {
    const auto script = check_text(scale);
    ASSERT_THAT(script->faults(), IsEmpty());
    const System& system = system_named(*script->program, "scale");
    ASSERT_TRUE(system.cells);
    const CellRules& rules = *system.cells;
    const auto name = [&](ItemId first, std::size_t k) {
        return system.quantities[ItemId(first.index() + k)].name;
    };
    EXPECT_EQ(name(rules.place, 2), "p.z");
    EXPECT_EQ(name(rules.frame, 3), "frame.z");
    EXPECT_EQ(name(rules.radius, 0), "r");
    EXPECT_EQ(name(rules.age, 0), "age");
    EXPECT_EQ(system.species_count(), 10u);  // With ripe.
    EXPECT_EQ(only_number(system.rates[rules.age]), 1);
    EXPECT_EQ(only_number(system.rates[rules.radius]), 0);
    EXPECT_EQ(system.quantities[rules.radius].range->low, 0.005);
    // Conditions contain the definitions that they read.
    for (const Formula* rule : rules_of(rules)) {
        for (const Node& node : rule->nodes) EXPECT_FALSE(node.is<DefinitionId>());
    }
    EXPECT_TRUE(std::ranges::any_of(rules.die.nodes, [](const Node& node) {
        return node.calls(Function::touching_sum);
    }));
    const std::string text = print_program(*script->program);
    EXPECT_THAT(
        text,
        HasSubstr(
            "cells scale {\n  age: 0 after divide\n  ripe: 0 after divide\n  divide: ripe > 1\n"));
    EXPECT_THAT(text, HasSubstr("\n  reach: 1.2\n"));
    EXPECT_THAT(text, HasSubstr("\n  solver: rkl2\n"));
}

TEST(CellsInTheProgram, GoOnByName) {
    const auto script = check_text(scale);
    ASSERT_TRUE(script->program);
    const Program& program = *script->program;
    const CellRules& rules = *program.system_of(1).cells;
    const auto is_taken = [&](ItemId item) {
        const Formula& start = program.stages[1].items[item];
        return start.nodes.size() == 1 && start.nodes.front().is(NodeKind(StageItem{0, item}));
    };
    for (const ItemId item : ids_below<ItemId>(rules.age.index() + 1)) {
        EXPECT_TRUE(is_taken(item)) << program.system_of(1).item_name(item);
    }
    EXPECT_EQ(program.stages[0].founders->count, 6);
    EXPECT_FALSE(program.stages[1].founders);
    EXPECT_FALSE(program.stages[1].remove.nodes.empty());
    EXPECT_FALSE(program.stages[0].uniform[rules.radius]);
    EXPECT_TRUE(program.stages[0].time.automatic_speed);
    EXPECT_EQ(program.stages[0].time.duration, 40);
    EXPECT_TRUE(program.stages[1].time.open_end);
}

TEST(CellsInTheProgram, KeepTheirRadiusUnlessTheStageSaysAnother) {
    const auto script = check_text(scale, {"on.r=0.05"});
    ASSERT_TRUE(script->program);
    const ItemId radius = script->program->system_of(1).cells->radius;
    EXPECT_EQ(only_number(script->program->stages[1].items[radius]), 0.05);
}

TEST(CellsInTheProgram, JoinTheTermsOfTheirBasesOnce) {
    const auto script = check_text(
        "cells body { k: 1; p' += push(k) }\ncells a: body { p' += stick(1) }\n"
        "cells b: body { p' += cling(1); k: 2 }\ncells c: a, b { p' += ex; k: 3 }\n"
        "domain { surface: sphere }\nstage s: c { founders: 1; duration: 1 }\n");
    ASSERT_THAT(script->faults(), IsEmpty());
    const System& system = system_named(*script->program, "c");
    const Formula& velocity = system.definitions[system.cells->velocity].formula;
    EXPECT_EQ(std::ranges::count_if(velocity.nodes,
                                    [](const Node& node) {
                                        return node.calls(Function::add) &&
                                               node.type == ValueType::vector;
                                    }),
              3);
    EXPECT_EQ(std::ranges::count_if(velocity.nodes,
                                    [](const Node& node) {
                                        return node.calls(Function::touching_sum);
                                    }),
              2);
}

TEST(CellsInTheProgram, RestartAloneIsTheStartToo) {
    const auto script =
        check_text("cells c { a: 2 after divide; b: 3; b: b / 2 after divide; a' = b; b' = a }\n");
    ASSERT_THAT(script->faults(), IsEmpty());
    const System& system = system_named(*script->program, "c");
    const CellRules& rules = *system.cells;
    const ItemId a(rules.age.index() + 1), b(rules.age.index() + 2);
    EXPECT_EQ(only_number(system.quantities[a].start), 2);
    EXPECT_EQ(only_number(rules.restarts[a]), 2);
    EXPECT_EQ(only_number(system.quantities[b].start), 3);
    EXPECT_THAT(rules.restarts[b].nodes.size(), 3u);
}

TEST(CellsInTheProgram, MayHaveFunctionsOfTheirOwn) {
    const auto script = check_text("fn push(k) = k * ex\ncells c { p' += push(7) }\n");
    ASSERT_THAT(script->faults(), IsEmpty());
    const System& system = system_named(*script->program, "c");
    const Formula& velocity = system.definitions[system.cells->velocity].formula;
    EXPECT_TRUE(std::ranges::none_of(velocity.nodes, [](const Node& node) {
        return node.calls(Function::touching_sum);
    }));
}

TEST(CellsInTheProgram, KnowNoFunctionsOfCellsInScriptsWithoutCells) {
    const auto script = check_text("system s { u: 1; u' = more(u, 1) }\n");
    EXPECT_THAT(script->faults(), ElementsAre(HasSubstr("there is no function 'more'")));
}

TEST(CellsInEquations, TurnDivideAndStartAgain) {
    const auto script = check_text(scale);
    const std::string text = print_equations(script->tree, script->sources, "scale",
                                             Notation::unicode, EquationParts::all);
    EXPECT_THAT(text, HasSubstr("  ω = "));
    EXPECT_THAT(text, HasSubstr("∂p/∂t = "));
    EXPECT_THAT(text, HasSubstr("  a cell   divides if ripe > 1\n           dies if crowd > 5\n"));
    EXPECT_THAT(text, HasSubstr("  divided  ripe = 0\n"));
}

TEST(CellsInCompletions, AreKnown) {
    const auto script = check_text(scale);
    std::vector<std::string> names;
    const std::string_view text = "cells more: scale {\n  di";
    for (const KnownName& each : completions(text, text.size(), *script->program)) {
        names.push_back(each.name);
    }
    for (const char* word : {"divide", "die", "ripe", "r", "p"}) EXPECT_THAT(names, Contains(word));
    EXPECT_THAT(names, Not(Contains("p.x")));
    EXPECT_THAT(names, Not(Contains("founders")));
}

}  // namespace
}  // namespace cascade::test
