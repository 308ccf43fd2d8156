// Sweeps: the runs of many values, their table, pictures and film.
#include "run_fixture.h"

#include "measure/features.h"
#include "picture/grey_picture.h"
#include "core/csv.h"
#include "run/commands/sweep.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

namespace cascade {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* swept_spots = R"(
domain { grid: 32, 24 }   # a comment
stage s: turing_spots { iterations: 300; ka: 1/20 }
)";

/// A system that grows. At rates above 1 it blows up within the stage.
constexpr const char* growth = R"(
system growth { u: 1 + x; rate: 0.1; u' = rate * u^3 }
domain { grid: 8, 8 }
stage s: growth { iterations: 40; speed: 0.1 }
)";

class SweepTest : public RunTest {
protected:
    SweepRequest request(const std::vector<std::string>& varied) const {
        SweepRequest request;
        for (const std::string& text : varied) request.varied.push_back(*parse_variation(text));
        request.folder = path("sweep");
        request.simulation.backend = "interp";
        request.simulation.threads = 3;
        return request;
    }

    SweepReport sweep_well(const Script& script, const SweepRequest& request) {
        SweepControl control;
        auto report = sweep(script, request, control);
        EXPECT_TRUE(report) << (report ? "" : report.error().failure.message);
        return report ? *report : SweepReport{};
    }

    std::vector<std::string> table() const {
        std::ifstream file(path("sweep/features.csv"));
        std::vector<std::string> lines;
        for (std::string line; std::getline(file, line);) lines.push_back(line);
        return lines;
    }
};

/// The number of frames that an APNG states.
int frames_of(const std::string& apng) {
    const std::size_t place = apng.find("acTL");
    return place == std::string::npos ? 0 : static_cast<unsigned char>(apng.at(place + 7));
}

TEST_F(SweepTest, AFilmShowsTheEndsOfItsRuns) {
    SweepRequest wanted = request({"ka=1/20,1/10,1/30"});
    wanted.film = path("a.apng");
    wanted.picture.range = ValueRange{0, 8};
    const SweepReport report = sweep_well(load(swept_spots), wanted);
    EXPECT_EQ(report.written.back(), wanted.film);
    EXPECT_EQ(frames_of(bytes("a.apng")), 3);
    // Apart from its caption, the first frame is the picture of the first run, eight times as
    // large.
    Script alone = load(swept_spots);
    RunRequest run = RunTest::request();
    run.picture.range = wanted.picture.range;
    run.picture.scale = 8;
    run_well(alone, run);
    const auto frame = read_grey_picture(path("a.apng"));
    const auto picture = read_grey_picture(path("picture.png"));
    ASSERT_TRUE(frame && picture);
    ASSERT_EQ(frame->values.size(), picture->values.size());
    const std::size_t caption = 256 * (192 - 15);
    for (std::size_t k = 0; k < caption; ++k) {
        ASSERT_NEAR(frame->values[k], picture->values[k], 1e-6) << k;
    }
    EXPECT_NE(frame->values, picture->values);
}

TEST_F(SweepTest, AFilmLeavesOutRunsThatFail) {
    SweepRequest wanted = request({"rate=0.01,3"});
    wanted.film = path("a.apng");
    sweep_well(load(growth), wanted);
    EXPECT_EQ(frames_of(bytes("a.apng")), 1);
    wanted = request({"rate=3,4"});
    wanted.film = path("b.apng");
    SweepControl control;
    const auto failed = sweep(load(growth), wanted, control);
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().failure.message, HasSubstr("b.apng' has no frames"));
    EXPECT_TRUE(std::filesystem::exists(path("sweep/features.csv")));
}

TEST_F(SweepTest, EveryRunIsTheSameAsAlone) {
    const Script script = load(swept_spots);
    SweepRequest wanted = request({"turing_spots.ka=1/20,1/10", "seed=1,2"});
    wanted.fields = true;
    const SweepReport report = sweep_well(script, wanted);
    EXPECT_EQ(report.runs, 4u);
    EXPECT_EQ(report.failed + report.missing + report.done_before, 0u);
    EXPECT_EQ(report.steps, 4 * 300);
    Overrides overrides;
    overrides.sets = {"turing_spots.ka=1/10"};
    overrides.seed = 2;
    Script alone = load(swept_spots, overrides);
    RunRequest single = RunTest::request();
    single.save = path("alone");
    single.features = true;
    const RunReport run = run_well(alone, single);
    const auto in_sweep = array("sweep/fields/turing_spots.ka=1_10,seed=2/s.b.npy");
    ASSERT_EQ(in_sweep.size(), 32u * 24u);
    EXPECT_EQ(in_sweep, array("alone/s.b.npy"));
    // This run of the sweep has the features of the single run, too.
    const auto lines = table();
    ASSERT_EQ(lines.size(), 5u);
    EXPECT_THAT(lines[0], StartsWith("turing_spots.ka,seed,wavelength,spots,"));
    EXPECT_THAT(lines[4], StartsWith("1/10,2,"));
    ASSERT_TRUE(run.features);
    EXPECT_THAT(lines[4], HasSubstr("," + csv_number(run.features->deviation) + ","));
}

TEST_F(SweepTest, GoesOnWhereItStopped) {
    const Script script = load(swept_spots);
    EXPECT_EQ(sweep_well(script, request({"ka=1/20,1/10"})).done_before, 0u);
    const std::string sheet = bytes("sweep/sheet.png");
    const auto first = table();
    // A second sweep runs nothing again, even if comments and blanks have changed.
    std::string text = swept_spots;
    text.replace(text.find("a comment"), 9, "another one");
    const Script commented = load("\n\n" + text);
    SweepReport again = sweep_well(commented, request({"ka=1/20,1/10"}));
    EXPECT_EQ(again.done_before, 2u);
    EXPECT_EQ(again.steps, 0);
    EXPECT_EQ(table(), first);
    EXPECT_FALSE(sheet.empty());
    // If a value is added, only its run is made. A changed number in the script, or --force,
    // repeats all runs.
    EXPECT_EQ(sweep_well(script, request({"ka=1/20,1/15,1/10"})).done_before, 2u);
    text.replace(text.find("300"), 3, "301");
    EXPECT_EQ(sweep_well(load(text), request({"ka=1/20,1/10"})).done_before, 0u);
    SweepRequest forced = request({"ka=1/20,1/10"});
    forced.force = true;
    EXPECT_EQ(sweep_well(script, forced).done_before, 0u);
    SweepRequest shown = request({"ka=1/20,1/10"});
    shown.picture.show = "a";
    EXPECT_EQ(sweep_well(script, shown).done_before, 0u);
    // A damaged result is ignored, and its run is repeated.
    for (const auto& entry : std::filesystem::directory_iterator(path("sweep/runs"))) {
        ASSERT_TRUE(write_file(entry.path(), "{}"));
    }
    EXPECT_EQ(sweep_well(script, request({"ka=1/20,1/10"})).done_before, 0u);
}

TEST_F(SweepTest, ABlowUpIsARowAndAnEmptyTile) {
    const Script script = load(growth);
    const SweepReport report = sweep_well(script, request({"rate=0.01,3"}));
    EXPECT_EQ(report.failed, 1u);
    EXPECT_THAT(report.first_failure, HasSubstr("u is not finite any more"));
    const auto lines = table();
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_THAT(lines[1], Not(HasSubstr("finite")));
    EXPECT_THAT(lines[2], StartsWith("3,,,,,,,,,,,"));
    EXPECT_THAT(lines[2], HasSubstr("u is not finite any more"));
    // A blow-up is kept as a result, so its run is not repeated.
    const SweepReport again = sweep_well(script, request({"rate=0.01,3"}));
    EXPECT_EQ(again.done_before, 2u);
    EXPECT_EQ(again.failed, 1u);
}

TEST_F(SweepTest, ACancelKeepsWhatIsDone) {
    Overrides longer;
    longer.sets = {"iterations=3000"};
    const Script script = load(swept_spots, longer);
    SweepRequest wanted = request({"ka=1/20..1/5:30"});
    wanted.simulation.threads = 1;
    SweepControl control;
    control.report = [&](const SweepProgress& progress) {
        EXPECT_EQ(progress.runs, 30u);
        EXPECT_GE(progress.share, 0);
        EXPECT_LE(progress.share, 1);
        if (progress.runs_done > 0) control.cancel = true;
    };
    const auto report = sweep(script, wanted, control);
    ASSERT_TRUE(report);
    EXPECT_GT(report->missing, 0u);
    EXPECT_LT(report->missing, 30u);
    EXPECT_THAT(table().back(), HasSubstr("not run"));
    EXPECT_EQ(sweep_well(script, wanted).done_before, 30 - report->missing);
    EXPECT_THAT(table().back(), Not(HasSubstr("not run")));
}

TEST_F(SweepTest, NothingRunsWhereAScriptIsWrong) {
    const Script script = load(swept_spots);
    SweepControl control;
    auto wrong = sweep(script, request({"kaa=1,2"}), control);
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().failure.message, "--vary kaa=1: no stage has a parameter 'kaa'");
    wrong = sweep(script, request({"ka=1,1/0"}), control);  // The second run's fault.
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().failure.message, HasSubstr("--vary ka=1/0: division by zero"));
    SweepRequest shown = request({"ka=1,2"});
    shown.picture.show = "q";
    wrong = sweep(script, shown, control);
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().script->messages(false), HasSubstr("'q'"));
    shown.picture.show.clear();
    shown.picture.palette = "gery";
    EXPECT_THAT(sweep(script, shown, control).error().failure.message, HasSubstr("palette"));
    EXPECT_THAT(sweep(script, request({"seed=1,x"}), control).error().failure.message,
                HasSubstr("'x' is not a seed"));
    EXPECT_THAT(
        sweep(load("domain { grid: 8, 8 }"), request({"seed=1"}), control).error().failure.message,
        HasSubstr("no stage to run"));
    EXPECT_FALSE(std::filesystem::exists(path("sweep")));
}

TEST_F(SweepTest, AMissingFileEndsTheSweep) {
    const Script script = load(
        "domain { grid: 8, 8 }\n"
        "stage s: turing_spots { iterations: 3; a: field(\"none.npy\") }");
    SweepControl control;
    const auto ended = sweep(script, request({"ka=1,2,3,4,5"}), control);
    ASSERT_FALSE(ended);
    ASSERT_TRUE(ended.error().script);
    EXPECT_THAT(ended.error().script->messages(false), HasSubstr("test.cascade:2:49: error: "));
    EXPECT_THAT(table().back(), HasSubstr("not run"));
}

TEST_F(SweepTest, ItIsKeyedByWhatFilesHold) {
    const auto write_array = [&](float value) {
        Grid grid;
        grid.width = grid.height = 8;
        Field field{PlaneLayout(grid)};
        field.at(3, 3) = value;
        ASSERT_TRUE(write_npy(path("a.npy"), field));
    };
    const char* text =
        "domain { grid: 8, 8 }\n"
        "stage s: turing_spots { iterations: 3; a: field(\"a.npy\") }";
    write_array(1);
    EXPECT_EQ(sweep_well(load(text), request({"ka=1/80"})).done_before, 0u);
    EXPECT_EQ(sweep_well(load(text), request({"ka=1/80"})).done_before, 1u);
    write_array(2);
    EXPECT_EQ(sweep_well(load(text), request({"ka=1/80"})).done_before, 0u);
}

TEST_F(SweepTest, LimitsAreKept) {
    const Script script = load(swept_spots);
    SweepControl control;
    SweepRequest small = request({"ka=1/20,1/10"});
    small.simulation.memory_limit = 1000;
    const auto refused = sweep(script, small, control);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().failure.message, HasSubstr("--limit-memory"));
    SweepRequest huge = request({"ka=1..2:9000"});
    huge.tile_side = 1024;
    EXPECT_THAT(sweep(script, huge, control).error().failure.message, HasSubstr("too large"));
}

TEST_F(SweepTest, CellsThatCrawlHavePicturesAndNumbers) {
    const Script script = load(R"(
cells dot: covering, solid { r: 0.1; glow: random(0.5, 0.4) after divide }
domain { grid: 16, 16; boundary: noflux }
stage s: dot { founders: 3; duration: 12; show: glow }
)");
    SweepRequest wanted = request({"s.r=0.3,0.1", "dot.full=2,4"});
    wanted.tile_side = 40;
    const SweepReport report = sweep_well(script, wanted);
    EXPECT_EQ(report.runs, 4u);
    EXPECT_EQ(report.failed, 0u);
    const auto lines = table();
    ASSERT_EQ(lines.size(), 5u);
    EXPECT_THAT(lines[0], HasSubstr(",mean,deviation,smallest,largest,cells,births,deaths,steps,"));
    std::vector<double> counts;
    for (std::size_t k = 1; k < lines.size(); ++k) {
        std::vector<std::string> row(1);
        for (const char c : lines[k]) {
            if (c == ',') row.emplace_back();
            else row.back() += c;
        }
        EXPECT_EQ(row[2], "") << "a wavelength takes rows and columns";
        const auto number = [&](std::size_t column) { return std::stod(row[column]); };
        EXPECT_GT(number(10), 0.1);                          // The least glow,
        EXPECT_LT(number(8), number(11));                    // the mean, and the largest.
        EXPECT_EQ(number(12), 3 + number(13) - number(14));  // Cells are born and die.
        counts.push_back(number(12));
    }
    EXPECT_GT(counts[1], 2 * counts[0]) << "smaller cells are more";
    const auto read = [&](const std::filesystem::directory_entry& entry) {
        return read_result(path("sweep/runs"), entry.path().stem().string());
    };
    std::size_t tiles = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path("sweep/runs"))) {
        if (entry.path().extension() != ".json") continue;
        const auto kept = read(entry);
        ASSERT_TRUE(kept && kept->cells);
        ASSERT_TRUE(kept->tile.is_colour());
        EXPECT_EQ(kept->tile.fields[0].layout().width, 40);
        EXPECT_FALSE(spread_of(kept->tile.fields[0]).is_uniform()) << "something is drawn";
        ++tiles;
    }
    EXPECT_EQ(tiles, 4u);
    EXPECT_EQ(sweep_well(script, wanted).done_before, 4u);
    wanted.picture.view.azimuth += 90;
    EXPECT_EQ(sweep_well(script, wanted).done_before, 0u) << "the tiles are other pictures";
}

TEST_F(SweepTest, ModelsHavePictures) {
    const Script script = load(R"(
domain { surface: sphere; cells: 300 }
stage s: turing_spots { iterations: 20; ka: 1/20 }
)");
    SweepRequest wanted = request({"ka=1/20,1/10"});
    wanted.tile_side = 32;
    EXPECT_EQ(sweep_well(script, wanted).failed, 0u);
    const auto lines = table();
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_THAT(lines[0], Not(HasSubstr("births")));
    EXPECT_THAT(lines[1], StartsWith("1/20,,,,,,,"));
}

TEST_F(SweepTest, LargePicturesAreAveraged) {
    Grid grid;
    grid.width = 5;
    grid.height = 3;
    Canvas canvas;
    Field field{PlaneLayout(grid)};
    for (std::int64_t j = 0; j < 3; ++j) {
        for (std::int64_t i = 0; i < 5; ++i) field.at(i, j) = static_cast<float>(10 * j + i);
    }
    field.at(4, 2) = NAN;  // Outside of the domain.
    canvas.fields.push_back(std::move(field));
    const Canvas small = shrink(canvas, 3);
    ASSERT_EQ(small.fields[0].layout().width, 3);
    ASSERT_EQ(small.fields[0].layout().height, 2);
    EXPECT_EQ(small.fields[0].at(0, 0), 5.5F);
    EXPECT_EQ(small.fields[0].at(2, 0), 9.0F);
    EXPECT_EQ(small.fields[0].at(0, 1), 20.5F);
    EXPECT_TRUE(std::isnan(small.fields[0].at(2, 1)));
}

class SetsTest : public SweepTest {
protected:
    Result<ParameterSets> read(const std::string& text) const {
        EXPECT_TRUE(write_file(path("sets.csv"), text));
        return read_parameter_sets(path("sets.csv"));
    }
    /// The message about a fault of a text, without the file name at its beginning.
    std::string fault_of(const std::string& text) const {
        const auto sets = read(text);
        EXPECT_FALSE(sets) << text;
        return sets ? "" : sets.error().message.substr(path("sets.csv").string().size());
    }
};

TEST_F(SetsTest, ARowIsARun) {
    const Script script = load(growth);
    SweepRequest wanted = request({"seed=5,6"});
    wanted.sets = *read("rate,u\r\n0.1,1/2\r\n2e-1, \"0.25\"\r\n");
    wanted.varied.insert(wanted.varied.begin(), wanted.sets->variation);
    EXPECT_EQ(sweep_well(script, wanted).runs, 4U);
    const auto rows = table();
    ASSERT_EQ(rows.size(), 5U);
    EXPECT_THAT(rows[0], StartsWith("rate,u,seed,wavelength"));
    EXPECT_THAT(rows[1], StartsWith("0.1,1/2,5,"));
    EXPECT_THAT(rows[4], StartsWith("2e-1,0.25,6,"));
    // A sweep of the script that the sheet carries gives the same results.
    const auto sheet = load_script_file(path("sweep/sheet.png"));
    ASSERT_TRUE(sheet);
    ASSERT_EQ(sheet->varied.size(), 2U);
    EXPECT_EQ(*parse_variation(sheet->varied[0]), wanted.sets->variation);
}

TEST_F(SetsTest, SayWhereTheyAreWrong) {
    EXPECT_EQ(fault_of("a,b\n1,x\n"), ":2:3: 'x' is not a number");
    EXPECT_EQ(fault_of("a,b\n1,1/0\n"), ":2:3: '1/0' is not a number");
    EXPECT_EQ(fault_of("a,b\n1,\n"), ":2:3: 'b' has no value here");
    EXPECT_EQ(fault_of("a,b\n1,2\n\n3\n"), ":4:1: this row has 1 cell, but the first line has 2");
    EXPECT_EQ(fault_of("a,b\n1,2,3\n"), ":2:5: this row has 3 cells, but the first line has 2");
    EXPECT_EQ(fault_of("a,b\n1,2\n1, 2\n"), ":3:1: this row repeats line 2");
    EXPECT_EQ(fault_of("a,a\n"), ":1:3: 'a' already has a column");
    EXPECT_EQ(fault_of("a,,b\n"), ":1:3: there is no name");
    EXPECT_EQ(fault_of("0.1,0.2\n"), ":1:1: '0.1' is not a name");
    EXPECT_EQ(fault_of("a;b\n1;2\n"), ":1:1: the cells of a table must be separated by commas");
    EXPECT_EQ(fault_of("seed\n-1\n"), ":2:1: '-1' is not a seed");
    EXPECT_EQ(fault_of("a,\"b\n"), ":1:3: this quoted cell has no end");
    EXPECT_EQ(fault_of("a,b\n"), " has names but no row of values");
    EXPECT_EQ(fault_of("\n"), " has no names in its first line");
}

TEST_F(SetsTest, TheCheckersMessagesHaveAPlaceInTheTable) {
    const Script script = load(growth);
    const auto fault = [&](const std::string& text) {
        SweepRequest wanted = request({});
        wanted.sets = *read(text);
        wanted.varied = {wanted.sets->variation};
        SweepControl control;
        const auto report = sweep(script, wanted, control);
        EXPECT_FALSE(report);
        EXPECT_TRUE(report.error().is_in_sets);
        EXPECT_FALSE(std::filesystem::exists(path("sweep")));
        return report.error().failure.message.substr(path("sets.csv").string().size());
    };
    EXPECT_EQ(fault("rate,raet\n1,2\n"), ":1:6: no stage has a parameter 'raet'");
    EXPECT_THAT(fault("rate,extent\n1,2\n1,-4\n"), StartsWith(":3:3: the length of a side"));
}

}  // namespace
}  // namespace cascade
