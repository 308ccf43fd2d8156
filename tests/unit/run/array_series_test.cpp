// The series of states that a run writes as one array, into a .npy or a .csv file.
#include "run_fixture.h"

#include "picture/npy_header.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <cmath>
#include <cstring>

namespace cascade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ArraySeriesTest : public RunTest {
protected:
    /// Requests a run that writes a series of states to the file `name`.
    RunRequest of(const std::string& name, std::vector<std::string> fields = {}) const {
        RunRequest wanted = request();
        wanted.series = path(name);
        wanted.fields = std::move(fields);
        return wanted;
    }
    template <typename Number>
    std::vector<Number> numbers(const std::string& name) const {
        const std::string file = bytes(name);
        const std::size_t begin = header(name).data_begin;
        std::vector<Number> found((file.size() - begin) / sizeof(Number));
        std::memcpy(found.data(), file.data() + begin, file.size() - begin);
        return found;
    }
    NpyHeader header(const std::string& name) const {
        const auto read = parse_npy_header(bytes(name));
        EXPECT_TRUE(read) << name;
        return read ? *read : NpyHeader();
    }
    nlohmann::json json(const std::string& name) const {
        return nlohmann::json::parse(bytes(name), nullptr, false);
    }
};

constexpr const char* decay =
    "system s { u: x; v: 1; u' = -u; v' = -v }\n"
    "domain { grid: 4, 2; spacing: 0.5 }\n"
    "stage grow: s { iterations: 5; interval: 2; speed: 0.25 }\n";

TEST_F(ArraySeriesTest, IsOneArrayWithTimeFirst) {
    Script script = load(decay);
    const RunReport report = run_well(script, of("grown.npy"));
    EXPECT_THAT(report.written,
                ElementsAre(path("picture.png"), path("grown.npy"), path("grown.json")));
    EXPECT_EQ(header("grown.npy").type, "<f4");
    EXPECT_FALSE(header("grown.npy").fortran_order);
    EXPECT_THAT(header("grown.npy").shape, ElementsAre(4, 2, 4));
    const auto u = numbers<float>("grown.npy");
    ASSERT_EQ(u.size(), 4U * 8U);
    // The last step is the end of the run, but not of an interval.
    const std::vector<int> steps = {0, 2, 4, 5};
    for (std::size_t moment = 0; moment < 4; ++moment) {
        EXPECT_NEAR(u[moment * 8 + 7], 0.875 * std::pow(0.75, steps[moment]), 1e-6);
    }
    const nlohmann::json about = json("grown.json");
    EXPECT_EQ(about["array"], "grown.npy");
    EXPECT_EQ(about["axes"], nlohmann::json({"time", "row", "column"}));
    EXPECT_EQ(about["fields"], nlohmann::json({"u"}));
    EXPECT_EQ(about["spacing"], 0.5);
    EXPECT_EQ(about["moments"].size(), 4U);
    EXPECT_EQ(about["moments"][3],
              nlohmann::json({{"stage", "grow"}, {"step", 5}, {"t", 1.25}, {"time", 1.25}}));
}

TEST_F(ArraySeriesTest, HasTheFieldsThatAreNamed) {
    Overrides overrides;
    overrides.precision = Precision::binary64;
    Script script =
        load(std::string(decay) + "stage next: gray_scott { iterations: 1 }\n", overrides);
    run_well(script, of("grown.npy", {"u - 1", "v", "grow.u"}));
    EXPECT_EQ(header("grown.npy").type, "<f8");
    EXPECT_THAT(header("grown.npy").shape, ElementsAre(5, 3, 2, 4));
    const auto all = numbers<double>("grown.npy");
    EXPECT_EQ(all[0], 0.125 - 1);
    EXPECT_EQ(all[8], 1);
    EXPECT_EQ(all[3 * 24 + 16], 0.125 * std::pow(0.75, 5));
    // The second stage has read this value.
    EXPECT_EQ(all[4 * 24 + 16], 0.125 * std::pow(0.75, 5));
    const nlohmann::json about = json("grown.json");
    EXPECT_EQ(about["axes"], nlohmann::json({"time", "field", "row", "column"}));
    EXPECT_EQ(about["moments"][4]["stage"], "next");
    EXPECT_EQ(about["moments"][4]["time"], 2.25);
}

TEST_F(ArraySeriesTest, IsNotANumberWhereAStageHasNoSuchName) {
    Script script = load(std::string(decay) + "stage next: gray_scott { iterations: 1 }\n");
    run_well(script, of("grown.npy", {"feed"}));
    const auto feed = numbers<float>("grown.npy");
    ASSERT_EQ(feed.size(), 5U * 8U);
    EXPECT_TRUE(std::isnan(feed[0]) && std::isnan(feed[31]));
    EXPECT_GT(feed[32], 0);
}

TEST_F(ArraySeriesTest, OfOtherDomainsHasTheirAxes) {
    const auto axes = [&](const std::string& domain) {
        Script script = load("system s { u: 1; u' = 0 }\ndomain { " + domain +
                             " }\nstage grow: s { iterations: 1 }\n");
        RunRequest wanted = of("grown.npy");
        wanted.picture.size = PictureSize{8, 8};
        run_well(script, wanted);
        return std::pair(header("grown.npy").shape, json("grown.json")["axes"].dump());
    };
    EXPECT_EQ(axes("grid: 5, 4, 3"),
              std::pair(std::vector<std::uint64_t>({2, 3, 4, 5}),
                        std::string("[\"time\",\"slice\",\"row\",\"column\"]")));
    EXPECT_EQ(axes("grid: 5, 1"),
              std::pair(std::vector<std::uint64_t>({2, 5}), std::string("[\"time\",\"column\"]")));
    ASSERT_TRUE(write_file(path("t.off"),
                           "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                           "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"));
    EXPECT_EQ(axes("mesh: \"t.off\"; cells: faces"),
              std::pair(std::vector<std::uint64_t>({2, 4}), std::string("[\"time\",\"cell\"]")));
    EXPECT_EQ(numbers<float>("grown.npy"), std::vector<float>(8, 1.0F));
    EXPECT_EQ(axes("grid: 4, 2; mask: x < 0.5").first, std::vector<std::uint64_t>({2, 2, 4}));
    EXPECT_TRUE(std::isnan(numbers<float>("grown.npy")[2]));
}

// The run ends as if it were killed: nothing is written at the end.
TEST_F(ArraySeriesTest, CanBeReadIfTheRunFails) {
    Script script = load(
        "system s { u: 1; u' = u^3 }\ndomain { grid: 4, 4 }\n"
        "stage s: s { iterations: 1000; interval: 1 }");
    EXPECT_THAT(run_badly(script, of("grown.npy")), HasSubstr("not finite"));
    EXPECT_THAT(header("grown.npy").shape, ElementsAre(6, 4, 4));
    EXPECT_EQ(json("grown.json")["moments"].size(), 6U);
    EXPECT_EQ(numbers<float>("grown.npy").size(), 6U * 16U);
    run_badly(script, of("grown.csv"));
    EXPECT_THAT(script.messages(false), HasSubstr("a .csv series can hold only one row of cells"));
}

TEST_F(ArraySeriesTest, OfALineIsATable) {
    Script script = load(
        "system s { u: x; v: 1 - x; u' = -u; v' = 0 }\ndomain { grid: 2, 1; spacing: 0.5 }\n"
        "stage grow: s { iterations: 2; interval: 2; speed: 0.25 }\n"
        "stage next: gray_scott { iterations: 1 }\n");
    run_well(script, of("grown.csv", {"grow.u", "feed"}));
    EXPECT_EQ(bytes("grown.csv"),
              "stage,step,t,grow.u(0.25),grow.u(0.75),feed(0.25),feed(0.75)\n"
              "grow,0,0,0.25,0.75,,\n"
              "grow,2,0.5,0.140625,0.421875,,\n"
              "next,1,1,0.140625,0.421875,0.037,0.037\n");
}

TEST_F(ArraySeriesTest, IsRefusedBeforeTheFirstStep) {
    const auto refusal = [&](const RunRequest& wanted) {
        Script script = load(decay);
        const std::string why = run_badly(script, wanted);
        EXPECT_FALSE(std::filesystem::exists(path("picture.png")));
        return why + script.messages(false);
    };
    EXPECT_THAT(refusal(of("grown.csv")), HasSubstr("use --series NAME.npy for planes"));
    EXPECT_THAT(refusal(of("grown.pvd", {"u"})), HasSubstr("--field needs a series in an .npy, "
                                                           ".h5 or .csv file"));
    EXPECT_THAT(refusal(of("grown.npy", {"rgb(u, v, 0)"})), HasSubstr("--field takes numbers"));
    EXPECT_THAT(refusal(of("grown.npy", {"w"})), HasSubstr("'w' is not a parameter of s"));
    EXPECT_THAT(refusal(of("none/grown.npy")), HasSubstr("there is no folder"));
    std::filesystem::create_directory(path("grown.json"));
    EXPECT_THAT(refusal(of("grown.npy")), HasSubstr("Is a directory"));
    ASSERT_EQ(mkfifo(path("pipe.npy").c_str(), 0600), 0);
    EXPECT_THAT(refusal(of("pipe.npy")), HasSubstr("it is a pipe or a device"));
    EXPECT_FALSE(std::filesystem::exists(path("grown.npy")));
}

TEST_F(ArraySeriesTest, OfARunThatGoesOnIsAnotherFile) {
    Script script = load(decay);
    RunRequest wanted = of("grown.npy");
    wanted.save = path("saved");
    wanted.stop_at = StopAt{"grow", 3};
    run_well(script, wanted);
    const std::string first = bytes("grown.npy");
    wanted.stop_at.reset();
    wanted.resume = path("saved");
    EXPECT_THAT(run_badly(script, wanted), HasSubstr("holds moments of an earlier run"));
    EXPECT_EQ(bytes("grown.npy"), first);
    wanted.series = path("rest.npy");
    run_well(script, wanted);
    EXPECT_THAT(header("rest.npy").shape, ElementsAre(2, 2, 4));
    EXPECT_EQ(json("rest.json")["moments"][0]["step"], 4);
}

}  // namespace
}  // namespace cascade
