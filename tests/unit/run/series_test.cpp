// Series of a run for ParaView: a file for each moment, and their list.
#include "run_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

namespace cascade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SeriesTest : public RunTest {
protected:
    void run_series(const std::string& text, std::int64_t interval) {
        Overrides overrides;
        overrides.sets = {"grow.interval=" + std::to_string(interval)};
        Script script = load(text, overrides);
        RunRequest wanted = request();
        wanted.series = path("grown.pvd");
        run_well(script, wanted);
    }
    std::string list() const { return read_file(path("grown.pvd"), 1 << 20).value_or(""); }
    std::vector<std::string> pieces() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path("grown"))) {
            names.push_back(entry.path().filename().string());
        }
        std::sort(names.begin(), names.end());
        return names;
    }
};

constexpr const char* decay =
    "system s { u: x; v: 1; u' = -u; v' = -v }\n"
    "domain { grid: 6, 4, 2; spacing: 0.5 }\n"
    "stage grow: s { iterations: 8; speed: 0.25 }\n";

TEST_F(SeriesTest, HasAFileForEachMomentWithItsTime) {
    run_series(decay, 4);
    EXPECT_THAT(pieces(), ElementsAre("000001.vti", "000002.vti", "000003.vti"));
    EXPECT_THAT(list(),
                HasSubstr("<DataSet timestep=\"0\" part=\"0\" file=\"grown/000001.vti\"/>"));
    EXPECT_THAT(list(),
                HasSubstr("<DataSet timestep=\"1\" part=\"0\" file=\"grown/000002.vti\"/>"));
    EXPECT_THAT(list(),
                HasSubstr("<DataSet timestep=\"2\" part=\"0\" file=\"grown/000003.vti\"/>"));
    const std::string piece = read_file(path("grown") / "000002.vti", 1 << 20).value_or("");
    EXPECT_THAT(piece, HasSubstr("WholeExtent=\"0 6 0 4 0 2\""));
    EXPECT_THAT(piece, HasSubstr("Name=\"u\""));
    EXPECT_THAT(piece, HasSubstr("Name=\"v\""));
    // v is the last array, with 0.75⁴ in all cells.
    const auto end = piece.rfind("\n  </AppendedData>");
    float value = 0;
    std::memcpy(&value, piece.data() + end - sizeof value, sizeof value);
    EXPECT_EQ(value, 0.75F * 0.75F * 0.75F * 0.75F);
}

TEST_F(SeriesTest, HasTheEndThatIsNoInterval) {
    run_series(decay, 3);
    EXPECT_THAT(pieces(), ElementsAre("000001.vti", "000002.vti", "000003.vti", "000004.vti"));
    EXPECT_THAT(list(), HasSubstr("timestep=\"1.5\" part=\"0\" file=\"grown/000003.vti\""));
    EXPECT_THAT(list(), HasSubstr("timestep=\"2\" part=\"0\" file=\"grown/000004.vti\""));
    EXPECT_FALSE(list().find("000005") != std::string::npos);
}

TEST_F(SeriesTest, HasTheEndOfEachStageOnce) {
    run_series(std::string(decay) +
                   "stage next: s { u: grow.u; v: grow.v; iterations: 5; "
                   "interval: 4; speed: 0.25 }\n",
               20);
    // Steps 0 and 2 of the first stage, and 2, 3 and 3.25 of the second, whose start is also a
    // moment.
    EXPECT_THAT(pieces(), ElementsAre("000001.vti", "000002.vti", "000003.vti", "000004.vti"));
    EXPECT_THAT(list(), HasSubstr("timestep=\"3.25\" part=\"0\" file=\"grown/000004.vti\""));
}

TEST_F(SeriesTest, RemovesWhatAnEarlierRunHasLeft) {
    run_series(decay, 1);
    EXPECT_EQ(pieces().size(), 9U);
    EXPECT_TRUE(write_file(path("grown") / "mine.vti", "of somebody else"));
    run_series(decay, 4);
    EXPECT_THAT(pieces(), ElementsAre("000001.vti", "000002.vti", "000003.vti", "mine.vti"));
}

TEST_F(SeriesTest, OfAModelHasItsSurface) {
    run_series(
        "system s { u: x; u' = 0 }\ndomain { surface: sphere; cells: 300 }\n"
        "stage grow: s { iterations: 2; speed: 1 }\n",
        2);
    EXPECT_THAT(pieces(), ElementsAre("000001.vtp", "000002.vtp"));
    const std::string piece = read_file(path("grown") / "000002.vtp", 1 << 24).value_or("");
    EXPECT_THAT(piece, HasSubstr("<PolyData>"));
    EXPECT_THAT(piece, HasSubstr("Name=\"u\""));
}

TEST_F(SeriesTest, IsRefusedForCellsThatCrawl) {
    Script script = load(
        "domain { grid: 10, 10 }\ncells still { p' = vector(0, 0, 0) }\n"
        "stage grow: still { founders: keys(0.5, 0.5, 0); r: 0.05; iterations: 1 }\n");
    RunRequest wanted = request();
    wanted.series = path("grown.pvd");
    run_badly(script, wanted);
    EXPECT_THAT(script.messages(false), HasSubstr("cells that crawl have no rows and columns"));
    EXPECT_FALSE(std::filesystem::exists(path("grown")));
}

}  // namespace
}  // namespace cascade
