// Runs whose state is saved while they run: saving changes no bit, and a run that is resumed from
// any saved state ends with the bits of an uninterrupted run.
#include "resumed_run.h"

#include <gmock/gmock.h>

#include <set>

namespace cascade {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

class CheckpointTest : public ResumedRunTest {
protected:
    /// Saves the state at every moment at which this is possible, in the folders kept0, kept1, ….
    /// Returns the number of folders.
    int keep_all(const std::string& text) {
        Script script = load(text);
        auto made = Simulation::create(script, request().simulation);
        EXPECT_TRUE(made);
        Simulation& simulation = **made;
        int count = 0;
        simulation.keep_with([] { return true; },
                             [&] {
                                 const auto saved = save_run(path("kept" + std::to_string(count++)),
                                                             script, simulation);
                                 EXPECT_TRUE(saved) << (saved ? "" : saved.error().message);
                             });
        RunControl control;
        for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
            EXPECT_TRUE(simulation.start_stage(k));
            const auto end =
                simulation.advance_stage(k, script.program->stages[k].iterations, control, {});
            EXPECT_TRUE(end) << (end ? "" : end.error().message);
        }
        EXPECT_TRUE(save_run(path("watched"), script, simulation));
        return count;
    }

    std::vector<std::string> arrays(const std::string& folder) const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(path(folder))) {
            if (entry.path().extension() == ".npy") names.push_back(entry.path().filename());
        }
        return names;
    }
    void expect_same(const std::string& folder, const std::string& expected) {
        EXPECT_EQ(arrays(folder).size(), arrays(expected).size());
        for (const std::string& name : arrays(expected)) {
            EXPECT_EQ(bytes(folder + "/" + name), bytes(expected + "/" + name))
                << folder << " " << name;
        }
    }

    /// Resumes from some of the saved states, and expects the bits of an uninterrupted run at the
    /// end.
    void expect_no_bit_to_change(const std::string& text) {
        run_whole(text);
        const int count = keep_all(text);
        ASSERT_GT(count, 3) << text;
        expect_same("watched", "whole");
        const int apart = std::max(1, count / 7);
        for (int number = 0; number < count; number += apart) {
            const std::string kept = "kept" + std::to_string(number);
            auto script = load_saved_script(path(kept), {});
            ASSERT_TRUE(script);
            RunRequest wanted = request();
            wanted.resume = path(kept);
            wanted.save = path("rest");
            run_well(*script, wanted);
            expect_same("rest", "whole");
        }
    }
};

TEST_F(CheckpointTest, StagesOneAfterTheOther) { expect_no_bit_to_change(two_stages); }

TEST_F(CheckpointTest, StepsThatAreChosen) {
    expect_no_bit_to_change(
        "domain { grid: 20, 16 }\n"
        "stage s: turing_spots { solver: rkl2; speed: auto; duration: 700 }");
}

TEST_F(CheckpointTest, AdaptiveSteps) {
    expect_no_bit_to_change(
        "domain { grid: 20, 16 }\n"
        "stage s: turing_spots { solver: rk23; duration: 80 }\n"
        "stage t: turing_spots { solver: rk45; duration: 30; a: a; b: b }");
}

TEST_F(CheckpointTest, StagesThatEndWhenTheyHaveSettled) {
    expect_no_bit_to_change(
        "domain { grid: 16, 12 }\n"
        "stage s: gray_scott { until: steady(0.01); iterations: 3000 }\n"
        "stage t: turing_spots { iterations: 100 }");
}

TEST_F(CheckpointTest, SemiImplicitStepsNoiseAndDoublePrecision) {
    expect_no_bit_to_change(
        "domain { grid: 16, 12; precision: double }\n"
        "system s { u: random(0.5, 0.1); u' = u - u^3 + lap(u) + 0.01 * random(0, 1) }\n"
        "stage s: s { solver: etdrk4; speed: 0.3; iterations: 300 }");
}

TEST_F(CheckpointTest, ARunIsKeptWhereItIsSavedWhenTheTimeHasCome) {
    run_whole(two_stages);
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.save = path("saved");
    wanted.checkpoint_seconds = 1e-9;
    RunControl control;
    std::set<std::string> seen;
    // When a run reports its progress, it has already saved the state before the report.
    control.report = [&](const Progress&) {
        if (fs::exists(path("saved/run.json"))) seen.insert(bytes("saved/run.json"));
    };
    ASSERT_TRUE(run(script, wanted, control));
    EXPECT_GE(seen.size(), 2u);
    expect_same("saved", "whole");
}

TEST_F(CheckpointTest, WhatCannotBeKeptDoesNotEndTheRun) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.save = path("saved");
    wanted.checkpoint_seconds = 1e-9;
    RunControl control;
    bool has_gone = false;
    control.report = [&](const Progress&) {
        // For a while, the folder has a run.json that another program wrote.
        if (!has_gone && fs::exists(path("saved"))) {
            fs::remove_all(path("saved"));
            fs::create_directory(path("saved"));
            ASSERT_TRUE(write_file(path("saved/run.json"), "mine"));
            has_gone = true;
        }
    };
    std::vector<std::string> warnings;
    control.warn = [&](const std::string& warning) {
        warnings.push_back(warning);
        fs::remove(path("saved/run.json"));
    };
    ASSERT_TRUE(run(script, wanted, control));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(
        warnings[0],
        HasSubstr(
            "the run continues, although its state could not be saved at stage 'large', step "));
    EXPECT_THAT(warnings[0], HasSubstr(": '"));
    EXPECT_TRUE(fs::exists(path("saved/small.b.npy")));
}

}  // namespace
}  // namespace cascade
