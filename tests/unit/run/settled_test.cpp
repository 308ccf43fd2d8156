// A stage that runs until it has settled ends in the same way after it was resumed. When stages
// count as settled is tested in tests/scripts/steps.
#include "resumed_run.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <string>

namespace cascade {
namespace {

class SettledRun : public ResumedRunTest {};

TEST_F(SettledRun, ResumesBetweenTwoLooksWithTheSameEnd) {
    const std::string text =
        "domain { grid: 32, 32 }\nstage s: turing_spots { until: steady(0.2); ka: 0.2/16 }\n";
    run_whole(text);
    for (const std::int64_t stop : {50, 1250}) {
        run_in_two_parts(text, "s", stop);
        EXPECT_EQ(bytes("whole/s.b.npy"), bytes("rest/s.b.npy")) << stop;
        EXPECT_EQ(bytes("whole/run.json"), bytes("rest/run.json")) << stop;
    }
}

TEST_F(SettledRun, ASavedLookThatLacksSomethingIsRefused) {
    Script script = load("domain { grid: 16, 16 }\nstage s: turing_spots { until: steady(0.2) }\n");
    RunRequest wanted = request();
    wanted.save = path("saved");
    wanted.stop_at = StopAt{"s", 150};
    run_well(script, wanted);
    const auto saved = nlohmann::json::parse(bytes("saved/run.json"));
    const auto resume_with = [&](const auto& change) {
        nlohmann::json manifest = saved;
        change(manifest["stages"][0]["time"]["formations"]);
        EXPECT_TRUE(write_file(path("saved/run.json"), manifest.dump()));
        auto again = load_saved_script(path("saved"), {});
        EXPECT_TRUE(again);
        RunRequest rest = request();
        rest.resume = path("saved");
        return run_badly(*again, rest);
    };
    EXPECT_THAT(resume_with([](auto& formations) { formations.erase(0); }),
                ::testing::HasSubstr("it does not contain the history of a species"));
    EXPECT_THAT(resume_with([](auto& formations) { formations[1]["speed"] = -1; }),
                ::testing::HasSubstr("its time makes no sense"));
    EXPECT_THAT(resume_with([](auto& formations) { formations[1].erase("risen"); }),
                ::testing::HasSubstr("is damaged"));
}

}  // namespace
}  // namespace cascade
