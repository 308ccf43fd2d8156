// Runs observed at moments of time, where values are interpolated between steps.
#include "run/commands/moments.h"

#include "run_fixture.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>

namespace cascade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class MomentsTest : public RunTest {
protected:
    RunRequest logged(const std::vector<std::string>& expressions) const {
        RunRequest wanted = request();
        wanted.log.expressions = expressions;
        wanted.log.file = path("log.csv");
        return wanted;
    }
    std::vector<std::string> lines() const {
        std::ifstream file(path("log.csv"));
        std::vector<std::string> found;
        for (std::string line; std::getline(file, line);) found.push_back(line);
        return found;
    }
    /// The last number of each line except the first line.
    std::vector<double> last_column() const {
        std::vector<double> numbers;
        for (const std::string& line : lines()) {
            if (!line.starts_with("stage,")) {
                numbers.push_back(std::stod(line.substr(line.rfind(',') + 1)));
            }
        }
        return numbers;
    }
};

TEST_F(MomentsTest, AreNotCountedTwice) {
    const Moments some{{1, 2.5}, 0}, all{{}, 0.1};
    EXPECT_EQ(next_moment(some, 0, 0), 1);
    EXPECT_EQ(next_moment(some, 0, 1), 2.5);
    EXPECT_EQ(next_moment(some, 2, 0), 0.5);
    EXPECT_EQ(next_moment(some, 0, 2.5), std::numeric_limits<double>::infinity());
    double t = 0;
    for (int k = 1; k <= 1000; ++k) {
        t = next_moment(all, 0.7, t);
        ASSERT_NEAR(t, 0.1 * k, 1e-9);
    }
}

TEST_F(MomentsTest, ReplaceIntervals) {
    Script script = load(
        "system s { u: 1; u' = 1 }\ndomain { grid: 2, 2 }\n"
        "stage one: s { iterations: 4; speed: 0.5; interval: 1 }\n"
        "stage two: s { u: u; duration: 2; speed: 0.75 }\n");
    RunRequest wanted = logged({"max(u over domain)"});
    wanted.moments.at = {0.75, 1, 2.5, 4, 9};
    wanted.series = path("grown.npy");
    run_well(script, wanted);
    EXPECT_THAT(lines(),
                ElementsAre("stage,step,t,max(u over domain)", "one,0,0,1", "one,2,0.75,1.75",
                            "one,2,1,2", "one,4,2,3", "two,0,0,3", "two,1,0.5,3.5", "two,3,2,5"));
    EXPECT_THAT(warnings_, ::testing::Contains("the run ends at t = 4, before the time 9 of --at"));
    std::vector<double> times;
    const auto about = nlohmann::json::parse(bytes("grown.json"), nullptr, false);
    for (const auto& moment : about["moments"]) times.push_back(moment["time"]);
    EXPECT_THAT(times, ElementsAre(0, 0.75, 1, 2, 2.5, 4));
}

// Frames, films, logs and series are made at the moments of `every` in a script, where steps end.
TEST_F(MomentsTest, OfAScriptAreEndsOfSteps) {
    Script script = load(
        "system s { u: 1; u' = 1; every: 1 }\ndomain { grid: 2, 2 }\n"
        "stage one: s { iterations: 4; speed: 0.75 }\n"
        "stage two: s { u: u; duration: 1.5; speed: 0.4; every: 0.5 }\n"
        "stage three: s { u: u; iterations: 2; speed: 0.25; interval: 1 }\n");
    RunRequest wanted = logged({"max(u over domain)"});
    wanted.series = path("grown.npy");
    wanted.frames = path("film");
    run_well(script, wanted);
    EXPECT_THAT(lines(),
                ElementsAre("stage,step,t,max(u over domain)", "one,0,0,1", "one,2,1,2",
                            "one,4,2,3", "two,0,0,3", "two,2,0.5,3.5", "two,4,1,4", "two,6,1.5,4.5",
                            "three,0,0,4.5", "three,1,0.25,4.75", "three,2,0.5,5"));
    std::vector<double> times;
    const auto about = nlohmann::json::parse(bytes("grown.json"), nullptr, false);
    for (const auto& moment : about["moments"]) times.push_back(moment["time"]);
    EXPECT_THAT(times, ElementsAre(0, 1, 2, 2.5, 3, 3.5, 3.75, 4));
    EXPECT_TRUE(std::filesystem::exists(path("film/0001-one-0000002.png")));
    EXPECT_TRUE(std::filesystem::exists(path("film/0005-two-0000006.png")));
}

// Rows of the log every few steps do not change the moments of the frames.
TEST_F(MomentsTest, OfAScriptStayWithRowsOfSteps) {
    Script script = load(
        "system s { u: 1; u' = 1 }\ndomain { grid: 2, 2 }\n"
        "stage one: s { iterations: 8; speed: 0.75; every: 1 }\n");
    RunRequest wanted = logged({"max(u over domain)"});
    wanted.log.every = 3;
    wanted.frames = path("film");
    run_well(script, wanted);
    EXPECT_THAT(lines(), ElementsAre("stage,step,t,max(u over domain)", "one,0,0,1",
                                     "one,3,1.75,2.75", "one,6,3,4", "one,8,4,5"));
    EXPECT_TRUE(std::filesystem::exists(path("film/0004-one-0000008.png")));
    EXPECT_FALSE(std::filesystem::exists(path("film/0005-one-0000008.png")));
}

TEST_F(MomentsTest, OfAScriptSurviveAStop) {
    for (const std::string stage :
         {"iterations: 60; speed: 0.7; every: 3", "duration: 30; speed: auto; every: 3.3",
          "duration: 30; solver: rk45; every: 3.3", "duration: 30; solver: rkl2; every: 3.3"}) {
        const std::string text =
            "stage s: turing_spots { ka: 1/20; " + stage + " }\ndomain { grid: 16, 16 }\n";
        Script whole = load(text), part = load(text), rest = load(text);
        RunRequest wanted = request();
        wanted.save = path("whole");
        run_well(whole, wanted);
        wanted.save = path("part");
        wanted.stop_at = StopAt{"s", 5};
        run_well(part, wanted);
        wanted.stop_at.reset();
        wanted.resume = path("part");
        wanted.save = path("rest");
        run_well(rest, wanted);
        for (const std::string name : {"a", "b", "beta"}) {
            const std::string file = "/s." + name + ".npy";
            EXPECT_FALSE(bytes("whole" + file).empty());
            EXPECT_TRUE(bytes("whole" + file) == bytes("rest" + file)) << stage << file;
        }
        for (const char* folder : {"whole", "part", "rest"})
            std::filesystem::remove_all(path(folder));
    }
}

// The classical Runge-Kutta method and the cubic between steps are both of fourth order. rk45 and
// its curve between steps are both of fifth order.
TEST_F(MomentsTest, AreReadAsExactlyAsTheSolverIs) {
    const auto error = [&](const std::string& stage, const std::string& more = "") {
        Overrides overrides;
        overrides.precision = Precision::binary64;
        Script script = load("system s { u: 1; v: 0; u' = v; v' = -u" + more +
                                 " }\ndomain { grid: 2, 2 }\n"
                                 "stage turn: s { " +
                                 stage + " }\n",
                             overrides);
        RunRequest wanted = logged({"max(u over domain) - cos(t)"});
        wanted.moments.every = {0.13};
        run_well(script, wanted);
        double most = 0;
        for (const double each : last_column()) most = std::max(most, std::abs(each));
        EXPECT_GT(last_column().size(), 20U);
        return most;
    };
    const double coarse = error("solver: rk4; speed: 0.4; iterations: 10");
    const double fine = error("solver: rk4; speed: 0.2; iterations: 20");
    EXPECT_LT(coarse, 2e-3);
    EXPECT_NEAR(coarse / fine, 16, 3);
    // All steps are as long as they may be. With the cubic alone the first error would be 7e-5.
    const std::string judged = "solver: rk45; duration: 4; tolerance: 0.1; ";
    const double long_steps = error(judged + "speed: 0.4; largest_step: 0.4");
    const double short_steps = error(judged + "speed: 0.2; largest_step: 0.2");
    EXPECT_LT(long_steps, 2e-5);
    EXPECT_NEAR(long_steps / short_steps, 32, 6);
    // Rates that read the number of the step cannot be used again as the first rates of the next
    // step.
    EXPECT_DOUBLE_EQ(error(judged + "speed: 0.4; largest_step: 0.4", " + 0 * step"), long_steps);
}

// Diffusion never leaves the range of the values at its start, however long a step is.
TEST_F(MomentsTest, StayInRangeWithinLongSteps) {
    for (const std::string solver : {"imex", "gauss", "etdrk4", "rkl1", "rkl2"}) {
        Script script = load(
            "system heat { u: (abs(x - 0.5) < 0.2); u' = lap(u) }\ndomain { grid: 64, 4 }\n"
            "stage s: heat { solver: " +
            solver + "; speed: 20; iterations: 5 }\n");
        RunRequest wanted = logged({"max(abs(u - 0.5) over domain)"});
        wanted.moments.every = {3};
        run_well(script, wanted);
        for (const double each : last_column()) EXPECT_LT(each, 0.52) << solver;
    }
}

// The two cells after a division are visible from the end of the step in which the cell divides.
TEST_F(MomentsTest, OfCellsThatCrawlAreWithinTheirSteps) {
    Script script = load(
        "cells drift { p' = vector(0.1, 0, 0); s: 1 after divide; s' = cos(t); divide: s > 1.5 }\n"
        "domain { grid: 10, 10 }\n"
        "stage s: drift { founders: keys(0.2, 0.5, 0); r: 0.05; duration: 1; tolerance: 1e-5 }");
    RunRequest wanted = logged({"t", "mean(x over domain) - 0.2 - 0.1 * t", "sum(1 over domain)",
                                "if(t < 0.52, max(s over domain) - 1 - sin(t), 0)"});
    wanted.moments.every = {0.01};
    run_well(script, wanted);
    ASSERT_EQ(lines().size(), 102U);
    double before = 1;
    for (std::size_t k = 1; k < lines().size(); ++k) {
        double t = 0, place = 0, cells = 0, value = 0;
        ASSERT_EQ(std::sscanf(lines()[k].c_str(), "s,%*d,%*[^,],%lf,%lf,%lf,%lf", &t, &place,
                              &cells, &value),
                  4);
        EXPECT_NEAR(t, 0.01 * static_cast<double>(k - 1), 1e-6);
        EXPECT_NEAR(place, 0, 1e-5);
        EXPECT_NEAR(value, 0, 2e-4);
        EXPECT_GE(cells, before);
        EXPECT_LE(cells, t < 0.5235 ? 1 : 2);
        before = cells;
    }
    EXPECT_EQ(before, 2);
}

TEST_F(MomentsTest, ChangeNoBitOfTheRun) {
    const std::string spots = "turing_spots { ka: 1/20; ";
    const std::vector<std::string> stages = {
        "stage s: " + spots + "iterations: 60; speed: 0.7 }",
        "stage s: " + spots + "duration: 30; speed: 0.7 }",
        "stage s: " + spots + "duration: 30; speed: auto }",
        "stage s: " + spots + "duration: 30; speed: auto; solver: rkl2 }",
        "stage s: " + spots + "duration: 30; solver: rk45 }",
        "stage s: " + spots + "duration: 30; solver: imex }",
        "stage s: " + spots + "iterations: 50; until: steady(0.001); check: 7 }",
        "stage s: " + spots + "iterations: 40; frozen: x < 0.3 }",
        "system noisy { u: 1; u' = lap(u) / 8 + 0.1 * random(0, 1) }\n"
        "stage s: noisy { iterations: 40; speed: 0.5 }",
        "system tied { u: x; u' = phi - u; 0 = lap(phi) - phi + u }\n"
        "stage s: tied { iterations: 20; speed: 0.3 }",
        "stage s: " + spots + "iterations: 40; grid: coarse(2) }",
        "cells c { p' += push(5); a: 0 after divide; a' = 1 + step / 100; divide: a > 2 }\n"
        "stage s: c { founders: 5; r: 0.07; duration: 2.2 }",
        "cells c { p' += push(5) + vector(step, 0, 0) / 1000 }\n"
        "stage s: c { founders: 20; r: 0.07; duration: 2.2 }",
        "domain { surface: sphere }\nstage s: scales { founders: 5; r: 0.1; duration: 2.2 }"};
    for (const std::string& stage : stages) {
        const auto saved = [&](const MomentsRequest& moments) {
            const bool has_domain = stage.starts_with("domain");
            Script script = load((has_domain ? "" : "domain { grid: 24, 16 }\n") + stage);
            RunRequest wanted = logged({"t"});
            wanted.moments = moments;
            wanted.save = path("saved");
            run_well(script, wanted);
            std::map<std::string, std::string> all;
            for (const auto& entry : std::filesystem::directory_iterator(path("saved"))) {
                const std::string name = entry.path().filename().string();
                if (name != "run.json") all[name] = bytes("saved/" + name);
            }
            std::filesystem::remove_all(path("saved"));
            return all;
        };
        const bool crawls = stage.find("founders") != std::string::npos;
        const auto plain = saved({});
        ASSERT_FALSE(plain.empty()) << stage;
        EXPECT_TRUE(saved({{}, {crawls ? 0.1 : 0.3}}) == plain) << stage;
        EXPECT_GT(lines().size(), 20U) << stage;
        EXPECT_TRUE(saved({{0.1, 7, 7.01}, {}}) == plain) << stage;
    }
}

TEST_F(MomentsTest, LeaveFrozenCellsAsTheyAre) {
    Script script = load(
        "system s { u: 1; u' = 1 }\ndomain { grid: 4, 2 }\n"
        "stage one: s { iterations: 4; frozen: x < 0.5 }\n");
    RunRequest wanted = logged({"min(u over domain)", "max(u over domain)"});
    wanted.moments.at = {2.5};
    run_well(script, wanted);
    EXPECT_EQ(lines()[2], "one,3,2.5,1,3.5");
}

TEST_F(MomentsTest, AreRefusedWhereNothingHasATime) {
    const auto refusal = [&](const std::string& text, bool is_logged = true) {
        Script script = load("domain { grid: 10, 10 }\n" + text);
        RunRequest wanted = is_logged ? logged({"step"}) : request();
        wanted.moments.every = {1};
        run_badly(script, wanted);
        EXPECT_FALSE(std::filesystem::exists(path("picture.png")));
        return script.messages(false);
    };
    const std::string grown = "stage s: gray_scott { iterations: 2 }";
    EXPECT_THAT(refusal(grown, false), HasSubstr("this option needs an output over time, but "
                                                 "none is requested"));
    EXPECT_THAT(refusal("stage s: gray_scott { iterations: 2; speed: x + 0.1 }"),
                HasSubstr("has no time, because its speed differs from cell to cell"));
}

TEST_F(MomentsTest, OfALogMayHaveNamesAndFeatures) {
    Script script = load(
        "domain { grid: 40, 20 }\nsystem s { u: (x < 0.5); spots: 7; u' = 0 * u }\n"
        "stage s: s { iterations: 1 }");
    run_well(script, logged({"half = mean(u over domain)", "wavelength", "A=area", "spots",
                             "same=max(u over domain) == 1"}));
    EXPECT_THAT(lines(), ElementsAre("stage,step,t,half,wavelength,A,spots,same",
                                     "s,0,0,0.5,40,0.5,7,1", "s,1,1,0.5,40,0.5,7,1"));
    Script wrong = load("stage s: gray_scott { iterations: 1 }");
    run_badly(wrong, logged({"L=q"}));
    EXPECT_THAT(wrong.messages(false), StartsWith("<--log>:1:1: error: 'q' is not a parameter"));
}

}  // namespace
}  // namespace cascade
