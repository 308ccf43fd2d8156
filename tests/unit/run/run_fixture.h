// What tests of run/ share: a new folder for each test, scripts, runs.
#pragma once

#include "core/file.h"
#include "picture/npy.h"
#include "run/commands/run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

/// Two stages on a small grid: the second freezes cells and reads the first.
inline constexpr const char* two_stages = R"(
domain { grid: 24, 18; seed: 5 }
stage large: turing_spots { iterations: 300; interval: 100; ka: 1/80 }
stage small: turing_spots {
  iterations: 200
  interval: 50
  frozen: b < 4
  a: if([frozen], 4, a)
  b: if([frozen], 4, b)
  beta: beta
  ka: 0.2/16
}
)";

class RunTest : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(::testing::TempDir()) /
                  (std::string("cascade_") + info->name() + "_" + std::to_string(getpid()));
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }

    Script load(const std::string& text, const Overrides& overrides = {}) const {
        return load_script("test.cascade", text, folder_, overrides);
    }

    /// A request that writes into the test's folder.
    RunRequest request() const {
        RunRequest request;
        request.simulation.backend = "interp";
        request.simulation.threads = 1;
        request.outputs = {path("picture.png")};
        return request;
    }

    /// Runs, and fails the test with the reason if the run fails.
    RunReport run_well(Script& script, const RunRequest& request) {
        RunControl control;
        control.warn = [&](const std::string& warning) { warnings_.push_back(warning); };
        auto report = run(script, request, control);
        EXPECT_TRUE(report) << (report ? "" : report.error().message) << script.messages(false);
        return report ? *report : RunReport{};
    }

    /// Runs a script that must fail, and returns the reason and the hint.
    std::string run_badly(Script& script, const RunRequest& request) {
        RunControl control;
        auto report = run(script, request, control);
        EXPECT_FALSE(report);
        return report ? "" : report.error().message + "\n" + report.error().hint;
    }

    /// The numbers of an .npy file, in the precision of `Number`.
    template <typename Number = float>
    std::vector<Number> array(const std::string& name) const {
        const auto read = read_npy(path(name), precision_of<Number>);
        EXPECT_TRUE(read) << name;
        if (!read) return {};
        return {read->values.begin(), read->values.end()};
    }

    std::string bytes(const std::string& name) const {
        return read_file(path(name), 1u << 30).value_or("");
    }

    std::filesystem::path folder_;
    std::vector<std::string> warnings_;
};

}  // namespace cascade
