// Options of the command line are statements: they are checked like those of the script, and
// override them.
#include "run/script/script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* lone_stage = "stage one: turing_spots { iterations: 50 }\n";

Script load(const std::string& text, const Overrides& overrides) {
    return load_script("test", text, ".", overrides);
}

std::string messages(const std::string& text, const Overrides& overrides) {
    return load(text, overrides).messages(false);
}

TEST(OptionStatements, AreShownAsTheyWereTyped) {
    Overrides overrides;
    overrides.grid = GridSize{64, 0};
    EXPECT_THAT(messages(lone_stage, overrides),
                HasSubstr(
                    "<--grid>:1:4: error: a side of the grid must be a whole number of at least 1\n"
                    "    1 | 64x0\n"));
    overrides = {};
    overrides.model = "sphere";
    overrides.cells = "many";
    EXPECT_THAT(messages(lone_stage, overrides),
                HasSubstr(
                    "<--cells>:1:1: error: 'cells' must be a number, faces or vertices\n    1 | "
                    "many\n"));
    overrides = {};
    overrides.solver = "rk5";
    EXPECT_THAT(messages(lone_stage, overrides),
                HasSubstr("<--solver>:1:1: error: there is no solver 'rk5'"));
    overrides = {};
    overrides.cells = "100";
    EXPECT_THAT(messages(lone_stage, overrides),
                HasSubstr("<--cells>:1:1: error: this setting needs a domain with a model"));
}

TEST(OptionStatements, HaveTheLastWord) {
    Overrides overrides;
    overrides.grid = GridSize{40, 30};
    overrides.seed = 7;
    overrides.precision = Precision::binary64;
    overrides.solver = "rk4";
    overrides.steps = 20;
    const Script script =
        load(std::string("domain { grid: 8, 8; boundary: noflux; seed: 3; precision: single }\n") +
                 lone_stage,
             overrides);
    ASSERT_TRUE(script.program) << script.messages(false);
    const DomainSettings& domain = script.program->domain;
    EXPECT_EQ(domain.grid, (Grid{40, 30, Boundary::no_flux}));
    EXPECT_EQ(domain.seed, 7u);
    EXPECT_EQ(domain.precision, Precision::binary64);
    EXPECT_EQ(script.program->stages[0].time.solver, Solver::rk4);
    EXPECT_EQ(script.program->stages[0].iterations, 20);
    EXPECT_EQ(script.program->stages[0].interval, 5);  // A tenth of the script's interval.
}

TEST(OptionStatements, MendWhatTheScriptCannotHaveItself) {
    const std::string varying = "stage one: turing_spots { solver: rk4; speed: 0.5 + x }\n";
    EXPECT_FALSE(load(varying, {}).program);
    Overrides overrides;
    overrides.solver = "euler";
    EXPECT_THAT(messages(varying, overrides), IsEmpty());

    const std::string lone = std::string("domain { cells: 300 }\n") + lone_stage;
    EXPECT_FALSE(load(lone, {}).program);
    overrides = {};
    overrides.model = "sphere";
    const Script on_model = load(lone, overrides);
    ASSERT_TRUE(on_model.program) << on_model.messages(false);
    EXPECT_EQ(on_model.program->domain.model->count, 300);
}

TEST(OptionStatements, ALimitOfChosenStepsGoesWithThem) {
    const std::string text =
        "stage one: turing_spots { solver: rk45; largest_step: 2; duration: 9 }\n";
    Overrides overrides;
    overrides.solver = "euler";
    const Script script = load(text, overrides);
    ASSERT_TRUE(script.program) << script.messages(false);
    EXPECT_EQ(script.messages(false), "");
    EXPECT_FALSE(script.program->stages[0].time.largest_step);
}

TEST(OptionStatements, LeaveTheBordersOfThePlaneAside) {
    Overrides overrides;
    overrides.model = "torus";
    const std::string said = messages(
        "domain { grid: 9, 9; boundary: noflux; left: fixed(1) }\n"
        "stage one: turing_spots { a.right: slope(1); a.top: noflux }\n",
        overrides);
    EXPECT_THAT(said, HasSubstr("test:1:40: warning: this side is ignored, because a model has "
                                "no sides"));
    EXPECT_THAT(said, HasSubstr("test:2:27: warning: this side is ignored, because a model has "
                                "no sides"));
    EXPECT_THAT(said, ::testing::Not(HasSubstr("error")));
}

TEST(OptionStatements, OfAModelGiveWayWithIt) {
    Overrides overrides;
    overrides.grid = GridSize{9, 9};
    const std::string ball =
        std::string("domain { surface: sphere; cells: 50; up: z; unit: 0.1; seed: 4 }\n") +
        lone_stage;
    const Script script = load(ball, overrides);
    ASSERT_TRUE(script.program) << script.messages(false);
    EXPECT_EQ(script.program->domain.grid, (Grid{9, 9}));
    EXPECT_EQ(script.program->domain.seed, 4u);
    overrides.up = Axis::x;
    EXPECT_THAT(messages(ball, overrides),
                HasSubstr("<--up>:1:1: error: this setting needs a domain with a model"));
}

}  // namespace
}  // namespace cascade
