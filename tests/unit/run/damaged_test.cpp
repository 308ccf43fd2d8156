// Requests that do not fit their script, and damaged files of earlier runs: each gives a message,
// and none a crash.
#include "run/simulation/stage_record.h"
#include "run_fixture.h"

#include "run/script/embedded_script.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <limits>

namespace cascade {
namespace {

using testing::HasSubstr;

class DamagedTest : public RunTest {
protected:
    /// Saves a run that was stopped in its first stage.
    void save() {
        Script script = load(two_stages);
        RunRequest wanted = request();
        wanted.save = path("saved");
        wanted.stop_at = StopAt{"large", 70};
        run_well(script, wanted);
    }

    /// Changes the manifest of the saved run, tries to resume it, and returns the reason for the
    /// refusal.
    std::string resume_with(const std::function<void(nlohmann::json&)>& change) {
        save();
        auto manifest = nlohmann::json::parse(bytes("saved/run.json"));
        change(manifest);
        EXPECT_TRUE(write_file(path("saved/run.json"), manifest.dump()));
        return resume();
    }

    std::string resume() {
        auto script = load_saved_script(path("saved"), {});
        if (!script) return script.error().message;
        RunRequest wanted = request();
        wanted.resume = path("saved");
        return run_badly(*script, wanted);
    }

    /// The messages about the faults of a request that does not fit its script.
    std::string faults(const RunRequest& request, const Overrides& overrides = {}) {
        Script script = load(two_stages, overrides);
        run_badly(script, request);
        return script.messages(false);
    }
};

TEST_F(DamagedTest, ManifestsAreCheckedBeforeTheyAreBelieved) {
    EXPECT_THAT(resume_with([](auto& run) { run.erase("stages"); }), HasSubstr("is damaged"));
    EXPECT_THAT(resume_with([](auto& run) { run["stages"] = nullptr; }),
                HasSubstr("its stages are not a list"));
    EXPECT_THAT(resume_with([](auto& run) { run["stages"][0]["steps"] = 1.5; }),
                HasSubstr("stage 1 is not right"));
    EXPECT_THAT(resume_with([](auto& run) { run["stages"][0]["steps"] = -1; }),
                HasSubstr("negative"));
    EXPECT_THAT(resume_with([](auto& run) { run["stages"][0]["name"] = "other"; }),
                HasSubstr("stage 1 is not right"));
    EXPECT_THAT(resume_with([](auto& run) { run["script"] = 5; }), HasSubstr("is damaged"));
    EXPECT_THAT(resume_with([](auto& run) {
                    run["overrides"] = {{"seed", -1}};
                }),
                HasSubstr("the stored overrides cannot be read"));
    EXPECT_THAT(resume_with([](auto& run) { run = nlohmann::json::array(); }),
                HasSubstr("not a manifest"));
}

TEST_F(DamagedTest, WhatAManifestRepeatsOfItsScriptMustAgreeWithIt) {
    EXPECT_THAT(resume_with([](auto& run) { run["seed"] = 77; }),
                HasSubstr("its seed differs from"));
    EXPECT_THAT(resume_with([](auto& run) { run["grid"][0] = 4096; }),
                HasSubstr("its grid differs from"));
    EXPECT_THAT(resume_with(
                    [](auto& run) { run["stages"][0]["steps"] = 1'000'000'000'000'000'000; }),
                HasSubstr("stage 1 has too many steps"));
    EXPECT_THAT(resume_with([](auto& run) { run["more"] = std::vector<int>(300'000, 1); }),
                HasSubstr("run.json holds too much"));
}

TEST_F(DamagedTest, ArraysWithValuesThatAreNotFiniteAreRefused) {
    // Saved runs of earlier versions have no checksums.
    EXPECT_THAT(resume_with([this](auto& run) {
                    run.erase("files");
                    std::string array = bytes("saved/large.b.npy");
                    const float nan = std::numeric_limits<float>::quiet_NaN();
                    std::memcpy(array.data() + array.size() - sizeof nan, &nan, sizeof nan);
                    ASSERT_TRUE(write_file(path("saved/large.b.npy"), array));
                }),
                HasSubstr("large.b.npy has a value that is not finite"));
}

TEST_F(DamagedTest, AStartThatIsNotFiniteIsToldAtAnyStep) {
    save();
    auto script = load_saved_script(path("saved"), {});
    ASSERT_TRUE(script);
    SimulationOptions options;
    options.backend = "interp";
    auto simulation = Simulation::create(*script, options);
    ASSERT_TRUE(simulation);
    ASSERT_TRUE((*simulation)->start_stage(0));
    StageRecord record = record_of((*simulation)->state(0), *(*simulation)->domain().program, 0);
    std::get<RecordedFields>(record.values).at("b").at(3, 2) = INFINITY;
    record.steps = 70;
    record.t = 70;
    restore(**simulation, 0, std::move(record));
    RunControl control;
    const auto end = (*simulation)->advance_stage(0, 300, control, {});
    ASSERT_FALSE(end);
    EXPECT_THAT(end.error().message, HasSubstr("value of b is not finite at column 3, row 2"));
}

TEST_F(DamagedTest, StoredOptionsMakeSense) {
    for (const char* json : {"{\"steps\":\"x\"}", "[1]", "{\"seed\":-1}", "{\"seed\":4294967296}",
                             "{\"steps\":1.5}", "{\"grid\":[3]}", "{\"grid\":[-1,3]}", "{"}) {
        EXPECT_FALSE(overrides_from_json(json)) << json;
    }
    for (const char* json : {"[]", "{\"scale\":0}", "{\"depth\":9}", "{\"range\":[5,5]}",
                             "{\"palette\":\"nope\"}", "{\"range\":[1]}", ""}) {
        EXPECT_FALSE(picture_request_from_json(json)) << json;
    }
}

TEST_F(DamagedTest, APlaceToStopAtIsOnTheWay) {
    RunRequest wanted = request();
    wanted.stop_at = StopAt{"lrge", 10};
    EXPECT_EQ(faults(wanted),
              "<--stop-at>:1:1: error: no stage is called 'lrge'\n"
              "    1 | lrge:10\n"
              "      | ^~~~ did you mean 'large'?\n"
              "note: the stages are large, small\n");
    wanted.stop_at = StopAt{"large", 301};
    EXPECT_EQ(faults(wanted),
              "<--stop-at>:1:7: error: stage 'large' has only 300 steps\n"
              "    1 | large:301\n"
              "      |       ^~~\n");
    wanted.stop_at = StopAt{"small", 10};
    Overrides overrides;
    overrides.until_stage = "large";
    EXPECT_THAT(faults(wanted, overrides), HasSubstr("stage 'small' does not run"));
}

TEST_F(DamagedTest, TheLastStepOfAStageIsAPlaceToStopAt) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.stop_at = StopAt{"large", 300};
    const RunReport report = run_well(script, wanted);
    EXPECT_EQ(report.status, RunStatus::stopped);
    EXPECT_EQ(report.where, "stage 'large', step 300 of 300");
}

TEST_F(DamagedTest, ASpaceTimePictureNeedsOneRow) {
    RunRequest wanted = request();
    wanted.picture.space_time = true;
    EXPECT_THAT(faults(wanted),
                HasSubstr("<--space-time>:1:1: error: a space-time picture needs a grid of one "
                          "row, not of 18"));
}

TEST_F(DamagedTest, ARefusedRunLeavesNoFolder) {
    Script script = load(
        "stage s: turing_spots { a: field(\"no.npy\") + field(\"no.npy\")\n"
        "b: field(\"/dev/zero\") }");
    script.overrides.reads.everything = true;
    RunRequest wanted = request();
    wanted.frames = path("frames");
    wanted.save = path("saved");
    run_badly(script, wanted);
    EXPECT_FALSE(std::filesystem::exists(wanted.frames));
    EXPECT_FALSE(std::filesystem::exists(wanted.save));
    // A missing file that two places name is reported once, and a device is refused.
    const std::string messages = script.messages(false);
    EXPECT_THAT(messages, HasSubstr("test.cascade:1:34: error: cannot read"));
    EXPECT_THAT(messages, HasSubstr("test.cascade:2:10: error: '/dev/zero' is a pipe or a device"));
    EXPECT_EQ(script.diagnostics.error_count(), 2U);
}

}  // namespace
}  // namespace cascade
