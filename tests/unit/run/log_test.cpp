// Logs of a run: rows, expressions, limits of memory, and features.
#include "run/stage/memory.h"
#include "run_fixture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class LogTest : public RunTest {
protected:
    std::vector<std::string> lines(const std::string& name) const {
        std::ifstream file(path(name));
        std::vector<std::string> found;
        for (std::string line; std::getline(file, line);) found.push_back(line);
        return found;
    }
};

constexpr const char* two_logged_stages = R"(
domain { grid: 12, 8 }
stage large: turing_spots { iterations: 20; interval: 10; speed: 0.5; ka: 1/80 }
stage small: stripes { iterations: 6; interval: 3; speed: 0.25 }
)";

TEST_F(LogTest, ARowAtEachIntervalAndAtBothEnds) {
    Script script = load(two_logged_stages);
    RunRequest wanted = request();
    wanted.log.expressions = {"t*2", "ka", "small.speed"};
    const RunReport report = run_well(script, wanted);
    EXPECT_EQ(report.written.back(), path("picture.csv"));
    // Entries are empty where an expression has no value: the system stripes has no ka, and the
    // first stage cannot read the second stage.
    EXPECT_THAT(lines("picture.csv"),
                ElementsAre("stage,step,t,t*2,ka,small.speed", "large,0,0,0,0.0125,",
                            "large,10,5,10,0.0125,", "large,20,10,20,0.0125,", "small,0,0,0,,0.25",
                            "small,3,0.75,1.5,,0.25", "small,6,1.5,3,,0.25"));
}

TEST_F(LogTest, StepsOfItsOwnAndWithFrames) {
    for (const bool frames : {false, true}) {
        Script script = load(two_logged_stages);
        RunRequest wanted = request();
        wanted.log.expressions = {"step"};
        wanted.log.every = 7;
        wanted.log.file = path("log.csv");
        if (frames) wanted.frames = path("film");
        run_well(script, wanted);
        EXPECT_THAT(lines("log.csv"),
                    ElementsAre("stage,step,t,step", "large,0,0,0", "large,7,3.5,7",
                                "large,14,7,14", "large,20,10,20", "small,0,0,0", "small,6,1.5,6"));
        if (frames) {
            // Frames are drawn at the stage's intervals, whether or not there is a log.
            const auto begin = std::filesystem::directory_iterator(path("film"));
            EXPECT_EQ(std::distance(begin, std::filesystem::directory_iterator{}), 5);
        }
    }
}

// A stage with a duration and no interval is drawn after each tenth of it, however often it is
// logged.
TEST_F(LogTest, FramesOfADurationHaveAnIntervalOfTheirOwn) {
    Script script = load(
        "stage s: turing_spots { duration: 10; speed: 0.25 }\n"
        "domain { grid: 8, 4 }");
    RunRequest wanted = request();
    wanted.log.expressions = {"step"};
    wanted.log.every = 3;
    wanted.log.file = path("log.csv");
    wanted.frames = path("film");
    run_well(script, wanted);
    EXPECT_EQ(lines("log.csv").size(), 1u + 15u);  // Steps 0, 3, …, 39 and 40.
    std::vector<std::string> frames;
    for (const auto& entry : std::filesystem::directory_iterator(path("film"))) {
        frames.push_back(entry.path().filename().string());
    }
    std::sort(frames.begin(), frames.end());
    ASSERT_EQ(frames.size(), 11u);
    EXPECT_EQ(frames[1], "0001-s-0000004.png");
    EXPECT_EQ(frames[10], "0010-s-0000040.png");
}

TEST_F(LogTest, AggregatesOverTime) {
    // The mean decays by 1/64 a step, whatever diffusion does. It begins with 8 cells of 1 and 24
    // of 0.
    Script script = load(
        "system s { u: sx < 0.25; u' = lap(u) / 8 - u / 64 }\n"
        "domain { grid: 8, 4 }\n"
        "stage s: s { iterations: 64; interval: 16 }");
    RunRequest wanted = request();
    wanted.log.expressions = {"mean(u over domain)", "sum(u^2 over domain)",
                              "max(u over domain) - min(u over domain)"};
    run_well(script, wanted);
    const auto rows = lines("picture.csv");
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_EQ(rows[1], "s,0,0,0.25,8,1");
    const auto numbers = [&](std::size_t row) {
        std::vector<double> found;
        std::stringstream line(rows[row]);
        for (std::string cell; std::getline(line, cell, ',');) {
            found.push_back(std::atof(cell.c_str()));
        }
        return found;
    };
    for (std::size_t row = 2; row < 6; ++row) {
        const auto now = numbers(row), before = numbers(row - 1);
        EXPECT_NEAR(now[3], 0.25 * std::pow(1 - 1.0 / 64, now[1]), 1e-6);
        EXPECT_LT(now[4], before[4]);
        EXPECT_LT(now[5], before[5]);
    }
}

TEST_F(LogTest, ItNeverChangesAResult) {
    Script plain = load(two_logged_stages);
    run_well(plain, request());
    const std::string picture = bytes("picture.png");
    Script logged = load(two_logged_stages);
    RunRequest wanted = request();
    wanted.log.expressions = {"t"};
    wanted.log.every = 1;
    run_well(logged, wanted);
    EXPECT_EQ(bytes("picture.png"), picture);
    EXPECT_THAT(lines("picture.csv"), SizeIs(1 + 21 + 7));
}

TEST_F(LogTest, ABlowUpIsLogged) {
    Script script = load(
        "system s { u: 1; u' = u^3 }\ndomain { grid: 4, 4 }\n"
        "stage s: s { iterations: 1000; interval: 1 }");
    RunRequest wanted = request();
    wanted.log.expressions = {"step"};
    EXPECT_THAT(run_badly(script, wanted), HasSubstr("not finite"));
    EXPECT_THAT(lines("picture.csv").back(), HasSubstr("s,5,5,5"));
}

TEST_F(LogTest, WrongExpressions) {
    const auto message_of = [&](const std::string& expression) {
        Script script = load(two_logged_stages);
        RunRequest wanted = request();
        wanted.log.expressions = {"t", expression};
        run_badly(script, wanted);
        return script.messages(false);
    };
    EXPECT_THAT(message_of("a + 1"),
                HasSubstr("<--log>:1:1: error: this value differs from cell to cell"));
    EXPECT_THAT(message_of("x"), HasSubstr("differs from cell to cell"));
    EXPECT_THAT(message_of("q"), HasSubstr("<--log>:1:1: error: "));
    EXPECT_THAT(message_of("1 +"), HasSubstr("<--log>:1:"));
    EXPECT_THAT(message_of("rgb(1, 0, 0)"), HasSubstr("--log takes numbers"));
}

TEST_F(LogTest, TooManyRows) {
    Script script = load("stage s: turing_spots { iterations: 100000000; interval: 1 }");
    RunRequest wanted = request();
    wanted.log.expressions = {"t"};
    EXPECT_THAT(run_badly(script, wanted), HasSubstr("--log-every"));
    EXPECT_FALSE(std::filesystem::exists(path("picture.csv")));
}

TEST_F(LogTest, RowsOfADurationAreNotKnownBefore) {
    Script script = load(
        "domain { grid: 8, 8 }\n"
        "stage s: turing_spots { solver: rk23; duration: 3; interval: 1 }");
    RunRequest wanted = request();
    wanted.log.expressions = {"t"};
    wanted.log.every = 1;
    EXPECT_THAT(run_well(script, wanted).where, HasSubstr("t = 3 of 3"));
}

TEST_F(RunTest, LimitedMemoryIsKept) {
    for (const auto& [limit, scale] : {std::pair{20000ULL, 1}, {200000ULL, 16}}) {
        Script script = load(two_stages);
        RunRequest wanted = request();
        wanted.simulation.memory_limit = limit;
        wanted.picture.scale = scale;
        EXPECT_THAT(run_badly(script, wanted), HasSubstr("--limit-memory"));
        EXPECT_FALSE(std::filesystem::exists(path("picture.png")));
    }
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.simulation.memory_limit = 200000;
    run_well(script, wanted);
}

TEST_F(RunTest, MemoryCountsWhatSolversAndSurfacesKeep) {
    const auto planes = [&](const std::string& domain, const std::string& solver) {
        const Script script = load("domain { grid: 32, 32; " + domain + " }\n" +
                                   "stage s: turing_spots { iterations: 10; " + solver + " }");
        EXPECT_TRUE(script.program) << script.messages(false);
        const PlaneLayout layout(script.program->domain.grid);
        return memory_of(*script.program) / (4.0 * static_cast<double>(layout.size()));
    };
    const double plain = planes("", "");
    EXPECT_GE(planes("", "solver: rk45"), plain + 2 * 6);  // At least six rates of two species.
    // The stages of two species, and the rates of the old step.
    EXPECT_GE(planes("", "solver: rkl1"), plain + 2 + 2);
    EXPECT_EQ(planes("", "solver: rkl2"), planes("", "solver: rkl1") + 2);
    EXPECT_LE(planes("", "solver: rkl2"), plain + 10);
    EXPECT_EQ(planes("surface: sx, sy, sx * sy", ""), plain + 7);
}

TEST_F(RunTest, FeaturesOfWhatIsShown) {
    Script script = load(
        "domain { grid: 40, 20 }\nsystem s { u: (x < 0.5); u' = 0 * u }\n"
        "stage s: s { iterations: 1 }");
    RunRequest wanted = request();
    wanted.features = true;
    wanted.picture.show = "u + 1";
    const RunReport report = run_well(script, wanted);
    ASSERT_TRUE(report.features);
    EXPECT_EQ(report.features->mean, 1.5);
    EXPECT_EQ(report.features->area, 0.5);
    EXPECT_EQ(report.features->spots, 1);
    EXPECT_NEAR(report.features->wavelength, 40, 1e-9);
    EXPECT_NEAR(report.features->angle, 90, 1e-9);
}

TEST_F(RunTest, FeaturesOfAVolume) {
    // Two balls in a periodic box, one of them across its far side. The slice that pictures show
    // cuts only one ball.
    Script script = load(
        "domain { grid: 16, 16, 32; spacing: 0.5 }\n"
        "system s { u: ((x - 0.25)^2 + (y - 0.25)^2 + (z - 0.5)^2 < 0.02) +\n"
        "  ((x - 0.25)^2 + (y - 0.25)^2 + min(z, 1 - z)^2 < 0.02); u' = 0 * u }\n"
        "stage s: s { iterations: 1 }");
    RunRequest wanted = request();
    wanted.features = true;
    const RunReport report = run_well(script, wanted);
    ASSERT_TRUE(report.features);
    EXPECT_EQ(report.features->spots, 2);
    EXPECT_EQ(report.features->holes, 1);
    EXPECT_NEAR(report.features->area, 2 * 4.18879 * std::pow(0.02, 1.5) * 4, 0.01);
    Script waves = load(
        "domain { grid: 16, 8, 32; spacing: 0.5 }\n"
        "system s { u: sin(8 * pi * z); u' = 0 * u }\n"
        "stage s: s { iterations: 1 }");
    EXPECT_NEAR(run_well(waves, wanted).features->wavelength, 4, 1e-6);
}

}  // namespace
}  // namespace cascade
