// Cells that are kept in files: reading gives the same cells, or a reason why this is impossible.
#include "core/file.h"
#include "core/hash.h"
#include "surface/cell_file.h"
#include "unit/surface/cell_checks.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

namespace cascade {
namespace {

using test::never;
constexpr std::uint64_t any_size = std::uint64_t{1} << 30;

class CellFile : public testing::Test {
protected:
    CellFile() {
        std::filesystem::create_directories(folder);
        options.count = 60;
        key = key_of(mesh, options);
    }
    ~CellFile() override { std::filesystem::remove_all(folder); }

    void write() {
        Team team(2);
        cells = *make_cells(mesh, options, team, never);
        ASSERT_TRUE(write_cells(path, cells, key));
        bytes = *read_file(path, any_size);
    }
    std::string reason() const {
        const auto read = read_cells(path, mesh, key);
        return read ? "" : read.error().message;
    }
    /// Writes a changed copy of the file, with a matching checksum if `is_clever`.
    void change(bool is_clever, const std::function<void(std::string&)>& how) const {
        std::string changed = bytes;
        how(changed);
        if (is_clever) {
            changed.resize(changed.size() - 8);
            const std::uint64_t sum = fnv1a(changed);
            changed.append(reinterpret_cast<const char*>(&sum), 8);
        }
        std::ofstream(path, std::ios::binary | std::ios::trunc) << changed;
    }

    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) /
        ("cascade_cells_" +
         std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    const std::filesystem::path path = folder / "some.cells";
    const SurfaceMesh mesh = test::box();
    CellOptions options;
    CellKey key;
    SurfaceCells cells;
    std::string bytes;
};

TEST_F(CellFile, GivesBackWhatWasWritten) {
    write();
    const auto read = read_cells(path, mesh, key);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->areas, cells.areas);
    EXPECT_EQ(read->ends, cells.ends);
    EXPECT_EQ(read->bare_area, cells.bare_area);
    ASSERT_EQ(read->places.size(), cells.places.size());
    for (std::size_t k = 0; k < cells.places.size(); ++k) {
        EXPECT_EQ(read->places[k].triangle, cells.places[k].triangle);
        EXPECT_EQ(read->places[k].weights, cells.places[k].weights);
    }
    ASSERT_EQ(read->edges.size(), cells.edges.size());
    for (std::size_t k = 0; k < cells.edges.size(); ++k) {
        EXPECT_EQ(read->edges[k].neighbour, cells.edges[k].neighbour);
        EXPECT_EQ(read->edges[k].length, cells.edges[k].length);
        EXPECT_EQ(read->edges[k].distance, cells.edges[k].distance);
    }
}

TEST_F(CellFile, KeyTellsApartAllThatMatters) {
    std::vector<CellKey> keys = {key};
    const auto other = [&](const std::function<void(SurfaceMesh&, CellOptions&)>& how) {
        SurfaceMesh changed_mesh = mesh;
        CellOptions changed = options;
        how(changed_mesh, changed);
        keys.push_back(key_of(changed_mesh, changed));
    };
    const std::size_t triangles = mesh.triangles.size();
    Anisotropy along_x = {std::vector<Vector3d>(triangles, {1, 0, 0}),
                          std::vector<double>(triangles, 2)};
    Anisotropy more = along_x;
    more.ratio[3] = 2.5;
    other([](auto&, CellOptions& o) { o.count = 61; });
    other([](auto&, CellOptions& o) { o.seed = 2; });
    other([](auto&, CellOptions& o) { o.rounds = 41; });
    other([](auto&, CellOptions& o) { o.kind = CellKind::faces; });
    other([](auto&, CellOptions& o) { o.kind = CellKind::vertices; });
    other([&](auto&, CellOptions& o) { o.anisotropy = &along_x; });
    other([&](auto&, CellOptions& o) { o.anisotropy = &more; });
    other([](SurfaceMesh& m, auto&) { m.points[5].y = std::nextafter(m.points[5].y, 2.0); });
    other([](SurfaceMesh& m, auto&) { std::swap(m.triangles[1], m.triangles[2]); });
    other([](SurfaceMesh& m, auto&) { m.across[4][1] = {}; });
    other([](SurfaceMesh& m, CellOptions& o) {
        o.kind = CellKind::faces;
        m.faces[0] = 77;
    });
    for (std::size_t a = 0; a < keys.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) EXPECT_NE(keys[a], keys[b]) << a << " " << b;
    }
    // Properties of a mesh that do not affect its cells do not change the key.
    SurfaceMesh named = mesh;
    named.attributes.push_back({"red", std::vector<float>(mesh.points.size(), 1)});
    EXPECT_EQ(key_of(named, options), key);
}

TEST_F(CellFile, SaysWhyItIsNotUsed) {
    EXPECT_NE(reason().find("is not there"), std::string::npos);
    write();
    EXPECT_EQ(reason(), "");
    CellOptions others = options;
    others.seed = 9;
    const auto stale = read_cells(path, mesh, key_of(mesh, others));
    ASSERT_FALSE(stale);
    EXPECT_NE(stale.error().message.find(
                  "of another surface, or cells that were made in another way"),
              std::string::npos);
    change(false, [](std::string& b) { b[0] = 'K'; });
    EXPECT_NE(reason().find("is not a file of cells"), std::string::npos);
    change(false, [](std::string& b) { b[8] = 99; });
    EXPECT_NE(reason().find("is of version 99, not 4"), std::string::npos);
    change(false, [](std::string& b) { std::swap(b[12], b[15]); });
    EXPECT_NE(reason().find("byte order"), std::string::npos);
    change(false, [](std::string& b) { b[100] ^= 1; });
    EXPECT_NE(reason().find("its checksum is wrong"), std::string::npos);
    ASSERT_TRUE(write_file(path, ""));
    EXPECT_NE(reason().find("is not a file of cells"), std::string::npos);
    std::filesystem::remove(path);
    std::filesystem::create_directory(path);
    EXPECT_NE(reason(), "");
}

TEST_F(CellFile, EveryBitAndEveryLengthCounts) {
    options.count = 4;
    key = key_of(mesh, options);
    write();
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        change(false, [&](std::string& b) { b[k] = static_cast<char>(b[k] ^ 1 << k % 8); });
        EXPECT_NE(reason(), "") << "byte " << k;
    }
    for (std::size_t size = 0; size < bytes.size(); size += size < 80 ? 1 : 37) {
        change(false, [&](std::string& b) { b.resize(size); });
        EXPECT_NE(reason(), "") << size << " bytes";
    }
    change(false, [](std::string& b) { b += "x"; });
    EXPECT_NE(reason(), "");
}

TEST_F(CellFile, RefusesHostileNumbersWithARightChecksum) {
    write();
    const auto put = [&](std::size_t at, const auto& value) {
        change(true, [&](std::string& b) { std::memcpy(b.data() + at, &value, sizeof value); });
        EXPECT_NE(reason(), "") << "at " << at;
    };
    // Numbers of cells and edges that are too large are refused.
    for (const std::uint64_t count :
         {std::uint64_t{0}, std::uint64_t{61}, ~std::uint64_t{0}, std::uint64_t{1} << 62,
          std::uint64_t{1} << 40, (~std::uint64_t{0} - 71) / 44 + 1}) {
        put(32, count);
        put(40, count);
    }
    const std::size_t cell = 64, edges = 64 + 60 * 44;
    put(48, -1.0);                                            // A negative area without cells.
    put(cell, std::uint32_t{12});                             // A triangle that is not there.
    put(cell + 4, std::numeric_limits<double>::quiet_NaN());  // A weight.
    put(cell + 4, 1.5);
    put(cell + 28, std::numeric_limits<double>::infinity());  // An area.
    // An end of a cell's edges beyond all edges.
    put(cell + 36, std::uint64_t{1} << 50);
    put(cell + 59 * 44 + 36, std::uint64_t{5});
    put(edges, std::uint32_t{0});   // An edge from a cell to itself.
    put(edges, std::uint32_t{60});  // An edge to no cell.
    put(edges + 4, 0.0);            // An edge without length.
    put(edges + 4, 0.25);           // The other cell has another length.
    put(edges + 12, -2.0);          // A negative distance.
}

TEST_F(CellFile, CellsAreMadeOnceAndThenKept) {
    Team team(2);
    const auto first = kept_cells(path, mesh, options, team, never);
    ASSERT_TRUE(first);
    EXPECT_FALSE(first->were_kept);
    EXPECT_EQ(first->not_kept, "");
    const auto second = kept_cells(path, mesh, options, team, never);
    EXPECT_TRUE(second->were_kept);
    EXPECT_EQ(second->cells.areas, first->cells.areas);
    options.seed = 3;
    const auto third = kept_cells(path, mesh, options, team, never);
    EXPECT_FALSE(third->were_kept);
    EXPECT_NE(third->cells.areas, first->cells.areas);
    const auto nowhere = kept_cells(folder / "no" / "folder", mesh, options, team, never);
    ASSERT_TRUE(nowhere);
    EXPECT_NE(nowhere->not_kept, "");
    options.count = 0;
    EXPECT_FALSE(kept_cells(path, mesh, options, team, never));
}

}  // namespace
}  // namespace cascade
