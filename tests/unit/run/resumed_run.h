// Runs that are stopped, saved and resumed.
#pragma once

#include "run_fixture.h"

namespace cascade {

class ResumedRunTest : public RunTest {
protected:
    /// Runs a script from its start to its end, and saves the run in "whole".
    void run_whole(const std::string& text, const Overrides& overrides = {}) {
        Script script = load(text, overrides);
        RunRequest wanted = request();
        wanted.save = path("whole");
        run_well(script, wanted);
    }

    /// Stops at a step of a stage, resumes, and saves the completed run in "rest".
    void run_in_two_parts(const std::string& text, const std::string& stage, std::int64_t step,
                          const Overrides& overrides = {}) {
        Script part = load(text, overrides);
        RunRequest first = request();
        first.save = path("part");
        first.stop_at = StopAt{stage, step};
        run_well(part, first);
        auto rest = load_saved_script(path("part"), {});
        ASSERT_TRUE(rest) << text;
        RunRequest second = request();
        second.resume = path("part");
        second.save = path("rest");
        EXPECT_EQ(run_well(*rest, second).status, RunStatus::finished);
    }
};

}  // namespace cascade
