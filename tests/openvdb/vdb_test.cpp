// .vdb files, read by OpenVDB itself and compared with the .vti files of the same runs.
#include "picture/vdb.h"
#include "unit/run/run_fixture.h"

#include <gmock/gmock.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cstring>

namespace cascade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* ball = R"(
let size = 0.5
domain { grid: 12, 10, 9; spacing: size; boundary: noflux; MORE }
system heat {
  u: disc(0.5, 0.5, 0.3) * (z < 0.5)
  v: x
  u' = 0.1 * lap(u)
  v' = 0
}
stage early: heat { iterations: 3 }
stage s: heat { u: u; v: v; iterations: 20; speed: 0.1 }
)";

std::string with(std::string text) {
    return std::string(ball).replace(std::string(ball).find("MORE"), 4, text);
}

class Vdb : public RunTest {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }

    void write(const std::string& script, const std::string& name) {
        Script loaded = load(script);
        for (const char* ending : {".vti", ".vdb"}) {
            RunRequest wanted = request();
            wanted.volume = path(name + ending);
            run_well(loaded, wanted);
        }
    }

    template <typename Grid>
    typename Grid::Ptr read(const std::string& file, const std::string& name) {
        openvdb::io::File reader(path(file).string());
        reader.open();
        const auto grid = openvdb::gridPtrCast<Grid>(reader.readGrid(name));
        EXPECT_TRUE(grid) << name << " has another precision";
        return grid;
    }

    /// Reads the array at index `number` of a .vti file.
    template <typename Number>
    std::vector<Number> vti_array(const std::string& file, std::size_t number, std::size_t count) {
        const std::string data = read_file(path(file), 1 << 24).value_or("");
        const std::size_t begin = data.find("\n_") + 2 + 8;
        const std::size_t size = count * sizeof(Number);
        std::vector<Number> values(count);
        EXPECT_LE(begin + number * (size + 8) + size, data.size());
        std::memcpy(values.data(), data.data() + begin + number * (size + 8), size);
        return values;
    }

    /// Checks that the grid has the values of the array at the same positions, and no voxel where
    /// the array has NaN.
    template <typename Grid>
    void expect_same(const std::string& name, const std::string& species, std::size_t number) {
        using Number = typename Grid::ValueType;
        const auto grid = read<Grid>(name + ".vdb", species);
        ASSERT_TRUE(grid);
        const auto values = vti_array<Number>(name + ".vti", number, 12 * 10 * 9);
        const auto voxels = grid->getConstAccessor();
        std::size_t inside = 0;
        for (int k = 0; k < 9; ++k) {
            for (int j = 0; j < 10; ++j) {
                for (int i = 0; i < 12; ++i) {
                    const Number expected = values[static_cast<std::size_t>((k * 10 + j) * 12 + i)];
                    // The centre of the cell in the image data of VTK.
                    const openvdb::Vec3d centre((i + 0.5) * 0.5, (j + 0.5) * 0.5, (k + 0.5) * 0.5);
                    const openvdb::Coord voxel = grid->transform().worldToIndexCellCentered(centre);
                    ASSERT_EQ(voxel, openvdb::Coord(i, j, k));
                    ASSERT_EQ(grid->indexToWorld(voxel), centre);
                    ASSERT_EQ(voxels.isValueOn(voxel), !std::isnan(expected));
                    if (std::isnan(expected)) continue;
                    ++inside;
                    ASSERT_EQ(voxels.getValue(voxel), expected) << i << ' ' << j << ' ' << k;
                }
            }
        }
        EXPECT_EQ(grid->activeVoxelCount(), inside);
        EXPECT_EQ(grid->voxelSize(), openvdb::Vec3d(0.5));
        EXPECT_EQ(grid->getGridClass(), openvdb::GRID_FOG_VOLUME);
    }
};

TEST_F(Vdb, HoldsWhatImageDataHold) {
    write(with("seed: 1"), "ball");
    expect_same<openvdb::FloatGrid>("ball", "u", 0);
    expect_same<openvdb::FloatGrid>("ball", "v", 1);
    openvdb::io::File file(path("ball.vdb").string());
    file.open();
    EXPECT_TRUE(file.getMetadata()->metaValue<std::string>("Cascade script") == with("seed: 1"));
    EXPECT_EQ(file.getMetadata()->metaValue<std::string>("stage"), "s");
    EXPECT_EQ(file.getMetadata()->metaValue<std::int64_t>("step"), 20);
    EXPECT_NEAR(file.getMetadata()->metaValue<double>("t"), 2, 1e-6);
    std::vector<std::string> names;
    for (auto name = file.beginName(); name != file.endName(); ++name) names.push_back(*name);
    EXPECT_THAT(names, ElementsAre("u", "v"));
    EXPECT_TRUE(file.hasGrid("u"));
}

TEST_F(Vdb, HasThePrecisionOfTheRun) {
    write(with("precision: double"), "fine");
    expect_same<openvdb::DoubleGrid>("fine", "u", 0);
}

TEST_F(Vdb, LeavesOutWhatLiesOutside) {
    write(with("mask: x + y + z < 1.2"), "part");
    expect_same<openvdb::FloatGrid>("part", "u", 0);
    EXPECT_LT(read<openvdb::FloatGrid>("part.vdb", "u")->activeVoxelCount(), 1000u);
}

TEST_F(Vdb, IsTheSameFileAgain) {
    write(with("seed: 1"), "ball");
    write(with("seed: 1"), "again");
    const std::string first = read_file(path("ball.vdb"), 1 << 24).value_or("");
    EXPECT_EQ(first, read_file(path("again.vdb"), 1 << 24).value_or(""));
    write(with("seed: 2"), "other");
    const std::string other = read_file(path("other.vdb"), 1 << 24).value_or("");
    EXPECT_NE(first.substr(21, 36), other.substr(21, 36)) << "files have identifiers of their own";
}

TEST_F(Vdb, HasOneNan) {
    Field field{PlaneLayout(Grid{2, 1, {}, 2})};
    field.at(1, 0, 1) = -std::nanf("7");
    const VolumeArray arrays[] = {{"u", &field}};
    ASSERT_TRUE(write_vdb(path("nan.vdb"), {arrays, {1, 1, 1}, nullptr, {}, "s", 0, 0}));
    const float voxel = read<openvdb::FloatGrid>("nan.vdb", "u")->getAccessor().getValue({1, 0, 1});
    std::uint32_t bits = 0;
    std::memcpy(&bits, &voxel, 4);
    EXPECT_EQ(bits, 0x7fc00000u);
}

TEST_F(Vdb, SaysWhyItCannotBeWritten) {
    Script script = load(with("seed: 1"));
    RunRequest wanted = request();
    wanted.volume = path("missing/ball.vdb");
    EXPECT_THAT(run_badly(script, wanted), HasSubstr("ball.vdb"));
    Script plane =
        load("domain { grid: 3, 2 }\nsystem s { u: 1; u' = 0 }\nstage only: s { iterations: 1 }");
    wanted.volume = path("plane.vdb");
    run_badly(plane, wanted);
    EXPECT_THAT(plane.messages(false), HasSubstr("a .vdb file can hold only a volume"));
    EXPECT_FALSE(std::filesystem::exists(path("plane.vdb")));
}

}  // namespace
}  // namespace cascade
