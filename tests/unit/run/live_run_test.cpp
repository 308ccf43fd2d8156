// A run that is changed while it runs: which values it keeps, which changes are refused, and that
// playing its log gives the same bits.
#include "live_run_fixture.h"

#include "support/kernel_comparison.h"
#include "support/new_seed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cascade::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* coupled_stages =
    "domain { grid: 20, 16; boundary: noflux }\n"
    "system s { u: 1 + x; v: y; k: 1 + y; c: 0.1\n"
    "  u' = 0.1 * lap(u) - c * exp(k) * u + v\n"
    "  v' = 0.2 * lap(v) + c * (u - v) }\n"
    "stage one: s { iterations: 60; speed: 0.2 }\n"
    "stage two: s { iterations: 60; speed: 0.2; u: one.u; v: one.v; k: 2 - one.u }\n";

class LiveRunTest : public LiveRunFixture {
protected:
    std::string difference_of_values(const StageState& one, const StageState& other,
                                     bool) const override {
        return same_bits(one.species(), other.species());
    }
};

TEST_F(LiveRunTest, StepsGoFromStageToStage) {
    const auto run = begun(coupled_stages);
    std::vector<std::uint32_t> ended;
    const Watching watching{{}, 0, [&](std::uint32_t stage) { ended.push_back(stage); }};
    EXPECT_EQ(run->advance(60, control_, watching).value(), StageEnd::stopped);
    EXPECT_EQ(run->place(), (RunPlace{0, 60}));
    EXPECT_EQ(run->advance(1, control_, watching).value(), StageEnd::stopped);
    EXPECT_EQ(run->place(), (RunPlace{1, 1}));
    EXPECT_EQ(run->advance(1000, control_, watching).value(), StageEnd::finished);
    EXPECT_EQ(run->place(), (RunPlace{1, 60}));
    EXPECT_TRUE(run->is_over());
    EXPECT_EQ(ended, (std::vector<std::uint32_t>{0, 1}));
}

TEST_F(LiveRunTest, ANumberActsOnTheRunningState) {
    const auto run = begun(coupled_stages), other = begun(coupled_stages);
    advance(*run, 30);
    advance(*other, 30);
    apply(*run, SetNumber{"c", "0.2"});
    EXPECT_EQ(difference(*run, *other), "") << "the change alone moves nothing";
    advance(*run, 10);
    advance(*other, 10);
    EXPECT_EQ(run->simulation().state(0).t, other->simulation().state(0).t);
    EXPECT_NE(difference(*run, *other), "");
}

TEST_F(LiveRunTest, ANumberCompilesNothing) {
    if (!is_available("jit")) GTEST_SKIP() << "nothing is compiled by this build";
    SimulationOptions options;
    options.threads = 1;
    options.stepper = make_stepper(options).value();
    const auto run = LiveRun::begin(load_script("test", coupled_stages, "."), options, control_);
    ASSERT_TRUE(run);
    advance(**run, 30);
    const auto before = options.stepper->counts().compiled;
    EXPECT_GT(before, 0);
    apply(**run, SetNumber{"c", "0.2"});
    advance(**run, 10);
    EXPECT_EQ(options.stepper->counts().compiled, before);
}

TEST_F(LiveRunTest, TimeGoesOnWhereTheStepChanges) {
    const auto run = begun(coupled_stages);
    advance(*run, 30);
    apply(*run, SetNumber{"one.speed", "0.1"});
    EXPECT_FLOAT_EQ(static_cast<float>(run->simulation().state(0).t), 6);
    advance(*run, 10);
    EXPECT_FLOAT_EQ(static_cast<float>(run->simulation().state(0).t), 7);
}

TEST_F(LiveRunTest, AnEditKeepsWhatHasTheSameName) {
    const auto run = begun(coupled_stages);
    advance(*run, 30);
    const Field u = run->simulation().state(0).species()[0].clone();
    // Species change their order, one is added and one is removed.
    apply(*run, SetText{with(coupled_stages, "v: y;", "w: 7; w' = 0;  v: 3;")});
    EXPECT_EQ(run->place(), (RunPlace{0, 30}));
    const StageState& state = run->simulation().state(0);
    ASSERT_EQ(state.species().size(), 3u);
    EXPECT_EQ(state.species()[0].number_at(3, 5), u.number_at(3, 5));
    EXPECT_EQ(state.species()[1].number_at(3, 5), 7);
    EXPECT_NE(state.species()[2].number_at(3, 5), 3);
}

TEST_F(LiveRunTest, AWrongEditChangesNothing) {
    const auto run = begun(coupled_stages), other = begun(coupled_stages);
    advance(*run, 30);
    EXPECT_THAT(refused(*run, SetText{with(coupled_stages, "exp(k)", "exp(kk)")}),
                HasSubstr("test:3:"));
    EXPECT_THAT(refused(*run, SetText{"domain { grid: 20, 16 }"}), HasSubstr("no stage to run"));
    EXPECT_THAT(refused(*run, SetNumber{"nobody", "3"}), HasSubstr("nobody"));
    EXPECT_THAT(refused(*run, SetNumber{"one.speed", "-1"}), HasSubstr("above 0"));
    EXPECT_FALSE(run->can_undo());
    advance(*run, 10);
    advance(*other, 40);
    EXPECT_EQ(difference(*run, *other), "");
}

TEST_F(LiveRunTest, OtherCellsBeginAnew) {
    const auto run = begun(coupled_stages);
    advance(*run, 70);
    apply(*run, SetText{with(coupled_stages, "20, 16", "10, 12")});
    EXPECT_EQ(run->place(), RunPlace());
    EXPECT_TRUE(run->log().changes.empty()) << "a log begins where the run began";
    const auto undone = run->undo(control_);
    ASSERT_TRUE(undone) << undone.error().messages(false);
    EXPECT_EQ(run->place(), (RunPlace{1, 10}));
}

TEST_F(LiveRunTest, AModelThatTakesTooLongIsRefused) {
    const std::string still =
        "system still { u: x; u' = 0 }\nstage only: still { iterations: 4 }\n";
    const auto run = begun("domain { grid: 8, 8 }\n" + still);
    run->limit_models(1e-6);
    const std::string why =
        refused(*run, SetText{"domain { surface: creature; cells: 100000 }\n" + still});
    EXPECT_NE(why.find("the cells of the model were not finished after 1e-06 s"), std::string::npos)
        << why;
    EXPECT_NE(why.find("--simplify"), std::string::npos) << why;
    // Later commands are not cancelled.
    advance(*run, 2);
    EXPECT_EQ(run->place().steps, 2);
    run->limit_models(0);
    apply(*run, SetText{"domain { surface: sphere; cells: 300 }\n" + still});
    EXPECT_TRUE(run->simulation().domain().model);
}

TEST_F(LiveRunTest, SettingsThatLostTheirMeaningAreDropped) {
    const auto run = begun(coupled_stages);
    apply(*run, SetNumber{"c", "0.2"});
    apply(*run, SetNumber{"one.speed", "0.1"});
    std::string text = with(coupled_stages, "c: 0.1\n", "\n");
    text = with(with(text, "- c *", "-"), "+ c *", "+");
    apply(*run, SetText{text});
    EXPECT_EQ(run->script().overrides.sets, (std::vector<std::string>{"one.speed=0.1"}));
}

TEST_F(LiveRunTest, PaintingReplacesValuesOfTheCells) {
    const auto run = begun(with(coupled_stages, "speed: 0.2 }", "speed: 0.2; frozen: x > 0.9 }"));
    advance(*run, 10);
    apply(*run, Paint{"u", "if(disc(0.3, 0.3, 0.2) > 0, 9, u)"});
    EXPECT_EQ(run->simulation().state(0).species()[0].number_at(5, 5), 9);
    apply(*run, Paint{"k", "0.5"});
    apply(*run, Paint{"frozen", "1"});
    const Field before = run->simulation().state(0).species()[0].clone();
    advance(*run, 5);
    EXPECT_EQ(run->simulation().state(0).species()[0].number_at(12, 12), before.number_at(12, 12))
        << "all cells are frozen";
    // A painted parameter keeps what was painted when another parameter changes.
    apply(*run, SetNumber{"c", "0.2"});
    const System& system = run->simulation().domain().program->system_of(0);
    for (const ItemId item : system.items()) {
        if (system.item_name(item) != "k") continue;
        EXPECT_EQ(run->simulation().state(0).field(item).number_at(3, 9), 0.5);
    }
}

TEST_F(LiveRunTest, WhatCannotBePaintedIsSaid) {
    const auto run = begun(coupled_stages);
    EXPECT_THAT(refused(*run, Paint{"w", "1"}), HasSubstr("nothing called 'w'"));
    EXPECT_THAT(refused(*run, Paint{"c", "1"}), HasSubstr("one number for all cells"));
    EXPECT_THAT(refused(*run, Paint{"u", "log(-1 - x)"}), HasSubstr("finite"));
    EXPECT_THAT(refused(*run, Paint{"u", "rgb(1, 1, 1)"}), HasSubstr("not a number"));
    EXPECT_THAT(refused(*run, Paint{"u", "uu + 1"}), HasSubstr("<paint>:1:1"));
}

TEST_F(LiveRunTest, AStageEndsWhereTheUserSays) {
    const auto run = begun(coupled_stages);
    advance(*run, 25);
    apply(*run, NextStage{});
    EXPECT_EQ(run->place(), (RunPlace{1, 0}));
    EXPECT_EQ(run->simulation().state(0).steps, 25);
    EXPECT_THAT(refused(*run, NextStage{}), HasSubstr("is the last one"));
    const auto undone = run->undo(control_);
    ASSERT_TRUE(undone);
    EXPECT_EQ(run->place(), (RunPlace{0, 25}));
    EXPECT_FALSE(run->simulation().state(0).done);
}

TEST_F(LiveRunTest, GoingBackKeepsNumbersAndDropsStrokes) {
    const auto run = begun(coupled_stages);
    advance(*run, 80);
    apply(*run, SetNumber{"c", "0.2"});
    apply(*run, Paint{"u", "5"});
    advance(*run, 10);
    ASSERT_TRUE(run->go_to(1, control_));
    EXPECT_EQ(run->place(), (RunPlace{1, 0}));
    EXPECT_EQ(difference(*run, *played(run->log())), "");
    const SessionLog log = run->log();
    ASSERT_EQ(log.changes.size(), 1u);
    EXPECT_EQ(*log.changes[0], (LoggedChange{{1, 0}, SetNumber{"c", "0.2"}}));
    ASSERT_TRUE(run->go_to(0, control_));
    EXPECT_EQ(run->place(), RunPlace());
    advance(*run, 20);
    EXPECT_EQ(difference(*run, *played(run->log())), "");
}

TEST_F(LiveRunTest, UndoGivesTheValuesBackToTheBit) {
    for (const std::size_t memory : {std::size_t{1} << 20, std::size_t{0}}) {
        const auto run = begun(coupled_stages), other = begun(coupled_stages);
        run->set_undo_memory(memory);
        advance(*run, 30);
        apply(*run, Paint{"u", "u + 1"});
        advance(*run, 50);
        apply(*run, SetNumber{"c", "0.2"});
        const auto changed = played(run->log());
        ASSERT_TRUE(run->undo(control_));
        ASSERT_TRUE(run->undo(control_));
        EXPECT_FALSE(run->undo(control_));
        advance(*other, 30);
        EXPECT_EQ(difference(*run, *other), "");
        ASSERT_TRUE(run->redo(control_));
        ASSERT_TRUE(run->redo(control_));
        EXPECT_FALSE(run->redo(control_));
        EXPECT_EQ(difference(*run, *changed), "");
    }
}

TEST_F(LiveRunTest, ForgetsMomentsWithOldTexts) {
    const auto run = begun(coupled_stages);
    const std::string text = run->script().text;
    run->set_undo_memory(std::size_t{1} << 20, 10 * text.size());
    for (int k = 0; k < 20; ++k) apply(*run, SetText{text + "\n# " + std::to_string(k)});
    int undone = 0;
    while (run->can_undo()) {
        ASSERT_TRUE(run->undo(control_));
        ++undone;
    }
    EXPECT_GT(undone, 1);
    EXPECT_LT(undone, 5);
}

TEST_F(LiveRunTest, PartsOfOneStrokeAreUndoneTogether) {
    const auto run = begun(coupled_stages);
    apply(*run, Paint{"u", "u + 1"});
    ASSERT_TRUE(run->apply(Paint{"u", "u + 2"}, control_, true));
    ASSERT_TRUE(run->undo(control_));
    EXPECT_EQ(difference(*run, *begun(coupled_stages)), "");
}

/// Values that the first of two changes removes do not come back with the second one.
TEST_F(LiveRunTest, ChangesAtOneStepAreLoggedWhereTheFirstLosesValues) {
    const std::string stage = "stage one: s { iterations: 60; speed: 0.2 }\n";
    const std::string with_v =
        "system s { u: 1 + x; v: y; u' = 0.1 * lap(u) - v; v' = 0.2 * lap(v) }\n" + stage;
    const auto run = begun(with_v);
    advance(*run, 30);
    apply(*run, SetText{"system s { u: 1 + x; u' = 0.1 * lap(u) }\n" + stage});
    apply(*run, SetText{with_v});
    EXPECT_EQ(difference(*run, *played(run->log())), "");

    const auto painted = begun(coupled_stages);
    advance(*painted, 30);
    apply(*painted, Paint{"k", "0.5"});
    apply(*painted, SetNumber{"one.k", "3"});
    apply(*painted, SetNumber{"one.k", "1 + y"});
    advance(*painted, 10);
    EXPECT_EQ(difference(*painted, *played(painted->log())), "");
}

TEST_F(LiveRunTest, ANumberThatIsMovedAtOneStepIsLoggedOnce) {
    const auto run = begun(coupled_stages);
    advance(*run, 30);
    for (const char* value : {"0.2", "0.3", "0.4"}) apply(*run, SetNumber{"c", value});
    const SessionLog log = run->log();
    ASSERT_EQ(log.changes.size(), 1u);
    EXPECT_EQ(*log.changes[0], (LoggedChange{{0, 30}, SetNumber{"c", "0.4"}}));
}

/// Whatever is done, playing the log gives the same bits, also after it was written as text and
/// read.
TEST_F(LiveRunTest, ALogThatIsPlayedAgainGivesTheSameBits) {
    const std::string scripts[] = {
        coupled_stages,
        with(coupled_stages, "iterations: 60; speed: 0.2 }",
             "duration: 12; speed: auto; solver: rkl2 }"),
        with(coupled_stages, "iterations: 60; speed: 0.2 }", "duration: 12; solver: rk45 }"),
        with(coupled_stages, "speed: 0.2 }", "speed: 0.2; until: steady(0.01) }"),
        with(coupled_stages, "boundary: noflux", "boundary: noflux; mask: disc(0.5, 0.4, 0.35)"),
        with(coupled_stages, "grid: 20, 16; boundary: noflux", "surface: torus; cells: 300"),
    };
    for (const std::string& script : scripts) {
        std::vector<double> values(script.find("cells: 300") == std::string::npos ? 20 * 16 : 300);
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<double>(k % 7) / 8;
        const std::vector<Change> changes = {
            SetValues{"u", values},
            SetValues{"k", values},
            SetNumber{"c", "0.15"},
            SetNumber{"c", "0.05 + 0.05"},
            SetNumber{"one.k", "1.2 + 0.1*x"},
            Paint{"u", "u + disc(0.5, 0.5, 0.4)"},
            Paint{"k", "mix(k, 0.7, x)"},
            Paint{"v", "v*(1 + 0.2*y)"},
            NextStage{},
            SetText{script},
            SetText{with(script, "0.2 * lap(v)", "0.3*lap(v)")},
        };
        for (int turn = 0; turn < 4; ++turn) {
            RandomStream random(new_seed() + static_cast<std::uint64_t>(turn));
            const auto run = begun(script);
            ASSERT_TRUE(run);
            change_at_random(*run, changes, 14, 25, random);
            expect_same_from_log(*run);
        }
    }
}

TEST(SessionLogTest, TextsOfAllKindsSurvive) {
    SessionLog log;
    log.name = "folder/name with blanks.cascade";
    log.text = "one\n\ntwo\n";
    log.overrides.seed = 7;
    log.overrides.sets = {"a=b\nc"};
    const auto add = [&](RunPlace at, Change change) {
        log.changes.push_back(
            std::make_shared<const LoggedChange>(LoggedChange{at, std::move(change)}));
    };
    add({0, 5}, SetText{""});
    add({0, 5}, SetText{"at 1 3\nend 1 1"});
    add({1, 0}, SetNumber{"s.k", "a == b"});
    add({1, 7}, Paint{"u", "x=y"});
    add({1, 7}, NextStage{});
    add({2, 0}, SetValues{"u", {0.5, -0.0, 1e30, 1e-40}});
    add({2, 0}, SetValues{"u", {1.0 / 3, 1e300, 5e-324}});
    add({2, 0}, SetValues{"u", {}});
    log.end = {2, 0};
    const auto read = parse_session_log(print_session_log(log));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(print_session_log(*read), print_session_log(log));
    ASSERT_EQ(read->changes.size(), log.changes.size());
    for (std::size_t k = 0; k < log.changes.size(); ++k) {
        EXPECT_EQ(*read->changes[k], *log.changes[k]);
    }
    EXPECT_EQ(read->text, log.text);
    EXPECT_EQ(read->overrides, log.overrides);
    EXPECT_EQ(read->end, log.end);
}

TEST(SessionLogTest, WhatIsNoLogIsRefusedWithItsLine) {
    const std::string good = "cascade session 1\nname n\noptions {}\nscript 1\nx\n";
    const std::pair<std::string, std::string> wrong[] = {
        {"", "line 1"},
        {"cascade session 2\n", "line 1"},
        {"cascade session 1\nname n\noptions {]\n", "line 3"},
        {"cascade session 1\nname n\noptions {}\nscript 99999999999999999999\n", "line 4"},
        {"cascade session 1\nname n\noptions {}\nscript 3\nx\n", "line 5"},
        {good, "no end"},
        {good + "at 0 1\nend 1 1\n", "line 6"},
        {good + "at 1 -1\nend 1 1\n", "line 6"},
        {good + "at 1 1\nset k\nend 1 1\n", "line 7"},
        {good + "paint =1\nend 1 1\n", "line 6"},
        {good + "dance\nend 1 1\n", "line 6"},
        {good + "text 2\nend 1 1\n", "line 7"},
        {good + "values u\nend 1 1\n", "line 6"},
        {good + "values u=\nend 1 1\n", "line 6"},
        {good + "values u=f16 AAAA\nend 1 1\n", "line 6"},
        {good + "values u=f32 AA==\nend 1 1\n", "line 6"},
        {good + "values u=f64 AAAAAA==\nend 1 1\n", "line 6"},
        {good + "values u=f32 not base64\nend 1 1\n", "line 6"},
        {good + "end 1 1\nnext\n", "follows the end"},
    };
    for (const auto& [text, where] : wrong) {
        const auto read = parse_session_log(text);
        ASSERT_FALSE(read) << text;
        EXPECT_THAT(read.error().message, HasSubstr(where)) << text;
    }
}

/// A log may come from a stranger, so no text may cause a crash.
TEST(SessionLogTest, NoTextIsTooStrange) {
    SessionLog log;
    log.text = "stage s: turing_spots { }\n";
    log.changes.push_back(std::make_shared<const LoggedChange>(
        LoggedChange{{0, 5}, SetText{"stage s: gray_scott { }"}}));
    log.changes.push_back(
        std::make_shared<const LoggedChange>(LoggedChange{{0, 9}, Paint{"u", "x"}}));
    log.changes.push_back(
        std::make_shared<const LoggedChange>(LoggedChange{{0, 9}, SetValues{"u", {1, 0.1}}}));
    log.end = {0, 12};
    const std::string good = print_session_log(log);
    RandomStream random(new_seed());
    for (int turn = 0; turn < 5000; ++turn) {
        std::string text = good;
        for (std::uint32_t k = 0; k <= random.below(4); ++k) {
            const std::size_t place = random.below(text.size());
            if (random.chance(40)) {
                text[place] = static_cast<char>(random.below(256));
            } else if (random.chance(50)) {
                text.erase(place, random.below(30));
            } else {
                text.insert(place, good.substr(random.below(good.size()), random.below(30)));
            }
            if (text.empty()) break;
        }
        const auto read = parse_session_log(text);
        if (read) {
            EXPECT_TRUE(parse_session_log(print_session_log(*read))) << text;
        } else {
            EXPECT_THAT(read.error().message, HasSubstr("of the session")) << text;
        }
    }
}

TEST_F(LiveRunTest, PlayingTellsHowFarItIsAndStops) {
    const auto run = begun(coupled_stages);
    SessionLog log = run->log();
    log.changes.assign(200, std::make_shared<const LoggedChange>(
                                LoggedChange{{0, 0}, Paint{"u", "u + 0.01"}}));
    std::vector<std::int64_t> told;
    control_.report = [&](const Progress& progress) {
        EXPECT_EQ(progress.doing, "playing the session: " + std::to_string(progress.step / 2) +
                                      " % of its changes");
        EXPECT_EQ(progress.steps, 200);
        told.push_back(progress.step);
        control_.cancel = progress.step >= 50;
    };
    const auto refused = LiveRun::play(log, ".", interpreted(), control_);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().messages(false), "stopped\n");
    EXPECT_EQ(told.size(), 25u);
    EXPECT_EQ(told.back(), 50);
}

TEST_F(LiveRunTest, AnEndBeyondTheIterationsIsRefusedBeforeAnyStep) {
    SessionLog log = begun(coupled_stages)->log();
    log.end = {0, 999'999'999'999};
    bool has_taken_steps = false;
    control_.report = [&](const Progress&) { has_taken_steps = true; };
    const auto refused = LiveRun::play(log, ".", interpreted(), control_);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().messages(false), HasSubstr("does not reach"));
    EXPECT_FALSE(has_taken_steps);
}

TEST_F(LiveRunTest, ALogThatDoesNotFitItsScriptIsRefused) {
    const auto run = begun(coupled_stages);
    advance(*run, 70);
    SessionLog log = run->log();
    log.text = with(log.text, "iterations: 60", "iterations: 20");
    const auto played = LiveRun::play(log, ".", interpreted(), control_);
    EXPECT_TRUE(played) << "the second stage is reached earlier, which nothing contradicts";
    log.end = {0, 70};
    const auto refused = LiveRun::play(log, ".", interpreted(), control_);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().messages(false), HasSubstr("does not reach"));
}

}  // namespace
}  // namespace cascade::test
