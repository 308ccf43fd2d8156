// Cells that crawl while their run is changed: which values they keep, which values start anew at
// their places, and that playing the log gives the same bits.
#include "live_run_fixture.h"

#include "run/pictures/drawn_cells.h"
#include "support/new_seed.h"
#include "tissue/tissue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace cascade::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Le;

/// Cells that divide for a while. Daughters inherit the parameter `tone`, and `mood` starts again.
constexpr const char* growing =
    "cells spot {\n"
    "  r: 0.05\n"
    "  ripe: random(0.5, 0.4) after divide\n"
    "  tone: spread * random(0.5, 0.4) + side\n"
    "  mood: random(0.5, 0.4) after divide\n"
    "  side: 0\n"
    "  hold: 0.5\n"
    "  spread: 1 in 0 .. 4\n"
    "  c: 0\n"
    "  p' += push(hold)\n"
    "  ripe' = more(sum(contact over touching), 2)\n"
    "  c' = tone + lap(c) - c\n"
    "  divide: ripe > 1\n"
    "}\n"
    "domain { grid: 32, 32; boundary: noflux }\n"
    "stage one: spot { founders: 5; duration: 3 }\n"
    "stage two: spot { c: c; tone: tone; ripe: ripe; mood: mood; duration: 2 }\n";

class LiveTissueTest : public LiveRunFixture {
protected:
    /// Advances until some cells have divided.
    void grow(LiveRun& run) {
        while (count(run) < 11) advance(run, 1);
        EXPECT_EQ(run.place().stage, 0u);
    }
    /// The values of an item in the cells of the present stage, in the order of the cells' numbers.
    static std::vector<double> values(const LiveRun& run, const std::string& name) {
        const std::uint32_t stage = run.place().stage;
        const StageState& state = run.simulation().state(stage);
        const auto item = find_item(run.simulation().domain().program->system_of(stage), name);
        return number_order(state.field(*item), *state.tissue());
    }
    static std::size_t count(const LiveRun& run) {
        return run.simulation().state(run.place().stage).tissue()->count();
    }
    std::string difference_of_values(const StageState& one, const StageState& other,
                                     bool goes_on) const override {
        const TissueRecord a = one.tissue()->record(), b = other.tissue()->record();
        if (a.numbers != b.numbers) return "other cells";
        if (a.species != b.species) return "other species";
        if (a.kept != b.kept) return "other parameters";
        if (goes_on && a.time.control.step != b.time.control.step) return "other steps";
        return "";
    }
};

TEST_F(LiveTissueTest, CellsGrowFromStageToStage) {
    const auto run = begun(growing);
    EXPECT_EQ(count(*run), 5u);
    EXPECT_EQ(run->advance(100000, control_).value(), StageEnd::finished);
    EXPECT_EQ(run->place().stage, 1u);
    EXPECT_GT(count(*run), 20u);
}

TEST_F(LiveTissueTest, ANumberActsOnTheRunningCells) {
    const auto run = begun(growing);
    grow(*run);
    const auto places = values(*run, "p.x"), tones = values(*run, "tone"),
               moods = values(*run, "mood");
    ASSERT_GT(places.size(), 5u);
    apply(*run, SetNumber{"one.hold", "0.4"});
    EXPECT_EQ(values(*run, "tone"), tones) << "what a change does not concern is inherited";
    EXPECT_EQ(values(*run, "p.x"), places);
    apply(*run, SetNumber{"one.side", "10"});
    EXPECT_NE(values(*run, "tone"), tones) << "its start reads what was changed";
    EXPECT_THAT(values(*run, "tone"), Each(::testing::Ge(10)));
    EXPECT_EQ(values(*run, "mood"), moods) << "divisions give this one";
    EXPECT_EQ(values(*run, "p.x"), places);
}

TEST_F(LiveTissueTest, AnEditKeepsWhatHasTheSameName) {
    const auto run = begun(growing);
    grow(*run);
    const auto c = values(*run, "c"), tones = values(*run, "tone");
    // A parameter and a species are added before the others, and another one is removed.
    std::string text = with(growing, "  r: 0.05\n", "  wide: 2 * x\n  d: 3\n  r: 0.05\n  d' = 0\n");
    text = with(with(text, "  mood: random(0.5, 0.4) after divide\n", ""), "mood: mood; ", "");
    text = with(text, "tone: tone; ", "tone: tone; d: d; ");
    apply(*run, SetText{text});
    EXPECT_EQ(values(*run, "c"), c);
    EXPECT_EQ(values(*run, "tone"), tones);
    EXPECT_THAT(values(*run, "d"), Each(3));
    const auto wide = values(*run, "wide"), x = values(*run, "p.x");
    for (std::size_t k = 0; k < x.size(); ++k) {
        EXPECT_EQ(wide[k], static_cast<double>(2 * static_cast<float>(x[k])));
    }
    advance(*run, 20);
    EXPECT_EQ(difference(*run, *played(run->log())), "");
}

TEST_F(LiveTissueTest, WhatStartsFromTheStageBeforeMustBeThereAtItsStart) {
    const auto run = begun(growing);
    const std::string text = with(with(growing, "  c: 0\n", "  c: 0\n  d: 0\n  d' = 0\n"),
                                  "{ c: c;", "{ c: c; d: one.c;");
    while (run->place().stage == 0) advance(*run, 50);
    advance(*run, 10);
    EXPECT_THAT(refused(*run, SetText{text}), HasSubstr("'d' cannot be added now"));
    ASSERT_TRUE(run->go_to(1, control_));
    apply(*run, SetText{text});
    EXPECT_EQ(values(*run, "d"), values(*run, "c"));
}

TEST_F(LiveTissueTest, StrokesChangeAndRemoveCells) {
    const auto run = begun(with(growing, "duration: 3 }", "duration: 9; frozen: x > 2 }"));
    grow(*run);
    const std::size_t before = count(*run);
    apply(*run, Paint{"c", "if(x < 0.5, 7, c)"});
    const auto c = values(*run, "c"), x = values(*run, "p.x");
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_EQ(c[k] == 7, x[k] < 0.5);
    apply(*run, Paint{"tone", "2"});
    apply(*run, SetNumber{"one.side", "10"});
    EXPECT_THAT(values(*run, "tone"), Each(2)) << "what was painted stays";
    apply(*run, Paint{"remove", "x > 0.5"});
    EXPECT_LT(count(*run), before);
    EXPECT_THAT(values(*run, "p.x"), Each(Le(0.5)));
    const auto now = values(*run, "p.x");
    apply(*run, Paint{"frozen", "1"});
    advance(*run, 1);
    EXPECT_EQ(values(*run, "p.x"), now) << "all cells are frozen";
    EXPECT_EQ(difference(*run, *played(run->log())), "");
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(run->undo(control_));
    EXPECT_EQ(count(*run), before);
    EXPECT_EQ(values(*run, "p.x"), x);
}

TEST_F(LiveTissueTest, StrokesBeforeTheFirstStepAreKept) {
    const auto run = begun(growing);
    const auto x = values(*run, "p.x");
    apply(*run, Paint{"c", "5"});
    apply(*run, SetNumber{"one.side", "1"});
    EXPECT_THAT(values(*run, "c"), Each(5));
    apply(*run, SetText{with(growing, "founders: 5", "founders: 9")});
    EXPECT_EQ(values(*run, "p.x"), x);
    ASSERT_TRUE(run->go_to(0, control_));
    EXPECT_EQ(count(*run), 9u) << "the stage begins again";
    EXPECT_THAT(values(*run, "c"), Each(0));
}

TEST_F(LiveTissueTest, WhatCannotBePaintedIsSaid) {
    const auto run = begun(growing);
    EXPECT_THAT(refused(*run, Paint{"p.x", "0"}), HasSubstr("nothing called 'p.x'"));
    EXPECT_THAT(refused(*run, Paint{"side", "0"}), HasSubstr("one number for all cells"));
    EXPECT_THAT(refused(*run, Paint{"remove", "1"}), HasSubstr("remove all cells"));
    EXPECT_THAT(refused(*run, Paint{"c", "log(-1 - x)"}), HasSubstr("finite"));
    EXPECT_THAT(refused(*run, Paint{"c", "normal"}), HasSubstr("not a number"));
}

TEST_F(LiveTissueTest, FieldsAndCellsDoNotGoOnAsEachOther) {
    const auto run = begun(growing);
    advance(*run, 20);
    apply(*run, SetText{"system s { c: 1; c' = -c }\ndomain { grid: 32, 32; boundary: noflux }\n"
                        "stage one: s { iterations: 10; speed: 0.1 }\n"});
    EXPECT_EQ(run->place(), RunPlace());
    advance(*run, 3);
    apply(*run, SetText{growing});
    EXPECT_EQ(run->place(), RunPlace());
    EXPECT_EQ(count(*run), 5u);
}

/// Whatever is done, playing the log gives the same bits, also after it was written as text and
/// read.
TEST_F(LiveTissueTest, ALogThatIsPlayedAgainGivesTheSameBits) {
    const std::string on_sphere =
        with(with(growing, "grid: 32, 32; boundary: noflux", "surface: sphere; cells: 100"),
             "  p' += push(hold)\n",
             "  p' += push(hold) + cling(1)\n  turn' += stand(1) + comb(1)\n");
    for (const std::string& script : {std::string(growing), on_sphere}) {
        const std::vector<Change> changes = {
            SetNumber{"one.side", "0.3"},
            SetNumber{"one.side", "x"},
            SetNumber{"spread", "2"},
            Paint{"c", "c + disc(0.5, 0.5, 0.4)"},
            Paint{"tone", "mix(tone, 0.7, x)"},
            Paint{"remove", "age > 0.9 and x > 0.7"},
            NextStage{},
            SetText{script},
            SetText{with(script, "c' = tone", "c' = 2 * tone")},
        };
        for (int turn = 0; turn < 2; ++turn) {
            RandomStream random(new_seed() + static_cast<std::uint64_t>(turn));
            const auto run = begun(script);
            ASSERT_TRUE(run);
            change_at_random(*run, changes, 6, 15, random);
            expect_same_from_log(*run);
        }
    }
}

}  // namespace
}  // namespace cascade::test
