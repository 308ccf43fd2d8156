// A running stage keeps its memory between calls that take steps, and notices changes of the state.
#include "run/simulation/end_remarks.h"
#include "run/simulation/simulation.h"

#include "run/script/script.h"
#include "run/simulation/environment.h"
#include "run/simulation/stage_record.h"
#include "run/simulation/stage_run.h"
#include "run/simulation/stage_start.h"
#include "run/simulation/stage_view.h"
#include "support/kernel_comparison.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cascade::test {
namespace {

constexpr const char* stages_with_rk2 =
    "domain { grid: 20, 16; boundary: noflux }\n"
    "system s { u: 1 + x; k: 1 + y; u' = 0.1 * lap(u) - 0.1 * exp(k) * u + sin(t) * k }\n"
    "stage one: s { iterations: 60; speed: 0.2; solver: rk2 }\n"
    "stage two: s { iterations: 60; speed: 0.2; u: one.u; k: 2 - one.u }\n";

class RunningStage : public ::testing::Test {
protected:
    RunningStage() : script_(load_script("test", stages_with_rk2, ".")) {}

    std::unique_ptr<Simulation> made() {
        return Simulation::create(script_, {"interp", 0, 1}).value();
    }
    void advance(Simulation& simulation, std::uint32_t stage, std::int64_t last) {
        ASSERT_TRUE(simulation.advance_stage(stage, last, control_, {}));
    }

    Script script_;
    RunControl control_;
};

TEST_F(RunningStage, StatesThatAreReplacedAreGoneOnFrom) {
    auto first = made(), second = made();
    ASSERT_TRUE(first->start_stage(0));
    ASSERT_TRUE(second->start_stage(0));
    advance(*first, 0, 20);
    StageRecord record = record_of(first->state(0), *first->domain().program, 0);
    advance(*first, 0, 45);
    // Goes back to step 20 while the stage is running.
    restore(*first, 0, std::move(record));
    advance(*first, 0, 60);
    advance(*second, 0, 60);
    EXPECT_EQ(same_bits(first->state(0).species(), second->state(0).species()), "");
}

TEST_F(RunningStage, StagesMayTakeTurns) {
    auto first = made(), second = made();
    for (Simulation* simulation : {first.get(), second.get()}) {
        ASSERT_TRUE(simulation->start_stage(0));
        advance(*simulation, 0, 30);
        ASSERT_TRUE(simulation->start_stage(1));
    }
    for (const std::int64_t last : {10, 25, 60}) {
        advance(*first, 1, last);
        advance(*first, 0, 30 + last / 2);
    }
    advance(*second, 0, 60);
    advance(*second, 1, 60);
    for (const std::uint32_t stage : {0u, 1u}) {
        EXPECT_EQ(same_bits(first->state(stage).species(), second->state(stage).species()), "");
    }
}

TEST_F(RunningStage, AStageMayStartAgainInTheMiddle) {
    auto first = made(), second = made();
    ASSERT_TRUE(first->start_stage(0));
    advance(*first, 0, 33);
    ASSERT_TRUE(first->start_stage(0));
    ASSERT_TRUE(second->start_stage(0));
    advance(*first, 0, 41);
    advance(*second, 0, 41);
    EXPECT_EQ(same_bits(first->state(0).species(), second->state(0).species()), "");
}

TEST_F(RunningStage, RemarksChangeNoBits) {
    RunControl listening;
    listening.warn = [](const std::string&) {};
    auto first = made(), second = made();
    ASSERT_TRUE(first->start_stage(0));
    ASSERT_TRUE(second->start_stage(0));
    for (std::int64_t last = 1; last <= 60; ++last) {
        ASSERT_TRUE(first->advance_stage(0, last, last % 2 == 0 ? listening : control_, {}));
    }
    advance(*second, 0, 60);
    EXPECT_EQ(same_bits(first->state(0).species(), second->state(0).species()), "");
    EXPECT_EQ(remark_on(*first, 0), remark_on(*second, 0));
}

// Values at sides that vary along the side, change with time, or do both.
constexpr const char* held_at_sides =
    "domain { grid: 20, 16; boundary: noflux }\n"
    "system s { u: 1 + x; u' = 0.1 * lap(u)\n"
    "  u.left: fixed(1 + y); u.right: fixed(sin(t) * y); u.top: slope(cos(t)) }\n"
    "stage one: s { iterations: 60; speed: 0.2; solver: rk2 }\n";

class CopiedState : public ::testing::Test {
protected:
    CopiedState() : script_(load_script("test", held_at_sides, ".")) {
        environment_ = make_environment(script_, {"interp", 0, 1}).value();
    }
    std::vector<StageState> started() {
        std::vector<StageState> states(1);
        EXPECT_TRUE(start_stage(*environment_, states, 0));
        return states;
    }
    void advance(std::span<StageState> states, std::int64_t last) {
        EXPECT_TRUE(StageRun(*environment_, states, 0, never_).advance(last, control_, {}));
    }
    std::vector<Field> rates(std::span<const StageState> states) {
        return StageView(*environment_, states, 0).rates();
    }

    Script script_;
    RunControl control_;
    const Keeping never_;
    std::unique_ptr<Environment> environment_;
};

TEST_F(CopiedState, IsAdvancedAsTheOriginal) {
    std::vector<StageState> states = started();
    advance(states, 20);
    std::vector<StageState> copies(states);
    advance(states, 60);
    EXPECT_EQ(copies[0].steps, 20);
    advance(copies, 60);
    EXPECT_EQ(same_bits(states[0].species(), copies[0].species()), "");
}

TEST_F(CopiedState, KeepsItsSides) {
    std::vector<StageState> states = started();
    advance(states, 20);
    const std::vector<Field> then = rates(states);
    const std::vector<StageState> copies(states);
    advance(states, 45);
    EXPECT_NE(same_bits(rates(states), then), "");
    EXPECT_EQ(same_bits(rates(copies), then), "");
}

}  // namespace
}  // namespace cascade::test
