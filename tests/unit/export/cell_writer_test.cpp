// Files of cells, read by NumPy and by a reader of XML.
#include "export/cell_writer.h"
#include "export/placed_cells.h"
#include "export/glb.h"
#include "export/model_writer.h"
#include "export/painted_cells.h"
#include "export/point_values.h"
#include "export/zip.h"
#include "unit/export/example_surfaces.h"
#include "unit/surface/even_cells.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace cascade {
namespace {

using ::testing::HasSubstr;

/// Cells of a square with two channels: x, and one with a NaN.
struct CellsOfSquare {
    SurfaceMesh mesh = test::flat_square(4);
    SurfaceCells cells = test::cells_of(mesh, 60);
    std::vector<Channel> channels{{"u", {}}, {"areas", std::vector<float>(60, 2)}};
    std::vector<Colour> colours{60, Colour{0.25F, 0.5F, 1}};
    CellsOfSquare() {
        for (const SurfacePlace& place : cells.places) {
            channels[0].values.push_back(static_cast<float>(position_of(mesh, place).x));
        }
        channels[1].values[7] = -std::numeric_limits<float>::quiet_NaN();
    }
    CellResults results() const { return {colours, channels}; }
};

/// A folder in which a Python script checks files.
class PythonFolder {
public:
    PythonFolder() { std::filesystem::create_directories(folder_); }
    ~PythonFolder() { std::filesystem::remove_all(folder_); }
    std::filesystem::path operator/(const char* name) const { return folder_ / name; }
    static bool has_numpy() { return !python().empty(); }
    bool runs(const std::string& script) const {
        std::ofstream(folder_ / "script.py") << script;
        return std::system(
                   ("cd '" + folder_.string() + "' && " + python() + " script.py").c_str()) == 0;
    }

private:
    /// A Python with NumPy: the first in PATH, or the system's.
    static std::string python() {
        for (const std::string name : {"python3", "/usr/bin/python3"}) {
            if (std::system((name + " -c 'import numpy' 2>/dev/null").c_str()) == 0) return name;
        }
        return "";
    }
    std::filesystem::path folder_ =
        std::filesystem::path(::testing::TempDir()) / "cascade_cell_writer";
};

TEST(CellWriter, NumPyReadsTheArchive) {
    if (!PythonFolder::has_numpy()) GTEST_SKIP() << "there is no NumPy";
    const CellsOfSquare square;
    const PythonFolder folder;
    ASSERT_TRUE(
        write_cells(folder / "cells.npz", square.mesh, square.cells, square.results()).has_value());
    EXPECT_TRUE(folder.runs(R"(
import numpy, zipfile
assert zipfile.ZipFile("cells.npz").testzip() is None
d = numpy.load("cells.npz", allow_pickle=False)
n = 60
assert sorted(d.files) == ["areas", "areas_", "colors", "links", "normals", "points", "u", "weights"], d.files
assert d["points"].shape == (n, 3) and d["points"].dtype == numpy.dtype("<f8")
assert d["normals"].shape == (n, 3) and numpy.allclose(d["normals"], [0, 0, 1])
assert d["areas"].shape == (n,) and abs(d["areas"].sum() - 1) < 1e-9
assert d["u"].dtype == numpy.dtype("<f4") and numpy.allclose(d["u"], d["points"][:, 0])
assert numpy.isnan(d["areas_"][7]) and numpy.nansum(d["areas_"]) == 2 * (n - 1)
assert d["areas_"].view("<u4")[7] == 0x7fc00000
assert d["colors"].shape == (n, 3) and (d["colors"][5] == [0.25, 0.5, 1]).all()
i, j = d["links"].T
assert d["links"].dtype == numpy.dtype("<u4") and (i < j).all() and j.max() < n
assert d["weights"].shape == i.shape and (d["weights"] > 0).all()
# A step of diffusion keeps what there is and lowers the peaks.
u = d["points"][:, 0].copy(); before = (u * d["areas"]).sum()
flow = d["weights"] * (u[j] - u[i])
numpy.add.at(u, i, 1e-3 * flow / d["areas"][i]); numpy.add.at(u, j, -1e-3 * flow / d["areas"][j])
assert abs((u * d["areas"]).sum() - before) < 1e-12 and u.max() < d["points"][:, 0].max()
)"));
}

TEST(CellWriter, XmlSaysWhereArraysAre) {
    if (!PythonFolder::has_numpy()) GTEST_SKIP() << "there is no NumPy";
    const CellsOfSquare square;
    const PythonFolder folder;
    ASSERT_TRUE(
        write_cells(folder / "cells.vtp", square.mesh, square.cells, square.results()).has_value());
    const Channel points[] = {{"a<b", std::vector<float>(square.mesh.points.size(), 3)}};
    ASSERT_TRUE(write_model(folder / "model.vtp", square.mesh, {{}, points}).has_value());
    EXPECT_TRUE(folder.runs(R"(
import numpy, struct, xml.etree.ElementTree as tree
def read(name):
    data = open(name, "rb").read()
    start = data.index(b"<AppendedData")
    block = data.index(b"_", data.index(b">", start)) + 1
    root = tree.fromstring(data[:start] + b"</VTKFile>")
    assert root.get("type") == "PolyData" and root.get("header_type") == "UInt64"
    piece = root.find("PolyData").find("Piece")
    arrays = {}
    types = {"Float32": "<f4", "Float64": "<f8", "Int64": "<i8", "UInt8": "<u1"}
    end = 0
    for section in piece:
        for array in section:
            offset = block + int(array.get("offset"))
            size = struct.unpack_from("<Q", data, offset)[0]
            kind = numpy.dtype(types[array.get("type")])
            values = numpy.frombuffer(data, kind, size // kind.itemsize, offset + 8)
            arrays[section.tag, array.get("Name")] = values.reshape(
                -1, int(array.get("NumberOfComponents")))
            end = max(end, offset + 8 + size)
    assert data[end:] == b"\n  </AppendedData>\n</VTKFile>\n"
    return piece, arrays
piece, a = read("cells.vtp")
assert piece.get("NumberOfPoints") == piece.get("NumberOfVerts") == "60"
assert piece.get("NumberOfPolys") == "0"
points = a["Points", "Points"]
assert points.shape == (60, 3) and points.dtype == "<f8"
assert numpy.allclose(a["PointData", "u"][:, 0], points[:, 0])
assert (a["PointData", "color"] == [64, 128, 255]).all()
assert abs(a["PointData", "area"].sum() - 1) < 1e-9
assert numpy.isnan(a["PointData", "areas"][7, 0])
assert (a["Verts", "connectivity"][:, 0] == range(60)).all()
assert (a["Verts", "offsets"][:, 0] == range(1, 61)).all()
piece, a = read("model.vtp")
assert piece.get("NumberOfPoints") == "25" and piece.get("NumberOfPolys") == "32"
assert a["Points", "Points"].dtype == "<f4" and (a["PointData", "a<b"] == 3).all()
corners = a["Polys", "connectivity"].reshape(-1, 3)
assert corners.shape == (32, 3) and set(corners.flat) == set(range(25))
p = a["Points", "Points"].astype(float)[corners]
normals = numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
assert abs(normals[:, 2].sum() / 2 - 1) < 1e-6
assert (a["Polys", "offsets"][:, 0] == range(3, 99, 3)).all()
)"));
}

TEST(PlacedCells, AreReadWithTheirFrames) {
    if (!PythonFolder::has_numpy()) GTEST_SKIP() << "there is no NumPy";
    const double half = std::sqrt(0.5);
    const std::vector<Vector3d> places = {{1.0 / 3, 2, 3}, {4, 5, 6}};
    const std::vector<Quaternion> frames = {{}, {half, half, 0, 0}};  // A quarter turn about x.
    const std::vector<double> radii = {0.5, 0.25};
    const std::vector<Colour> colours(2, Colour{1, 0.5F, 0});
    const Channel channels[] = {{"ripe", {3, 4}}, {"frame", {5, 6}}, {"points", {7, 8}}};
    const PlacedCells cells{places, frames, radii, colours, channels};
    const PythonFolder folder;
    ASSERT_TRUE(write_cells(folder / "thorns.cells.npz", cells));
    ASSERT_TRUE(write_cells(folder / "thorns.cells.vtp", cells));
    EXPECT_FALSE(write_cells(folder / "thorns.csv", cells));
    EXPECT_TRUE(folder.runs(R"(
import numpy, re, struct
cells = numpy.load("thorns.cells.npz")
assert (cells["points"] == [[1 / 3, 2, 3], [4, 5, 6]]).all()
assert (cells["frames"] == [[1, 0, 0, 0], [.5 ** .5, .5 ** .5, 0, 0]]).all()
assert (cells["radii"] == [.5, .25]).all() and (cells["colors"] == [1, .5, 0]).all()
assert (cells["ripe"] == [3, 4]).all() and (cells["frame"] == [5, 6]).all()
assert (cells["points_"] == [7, 8]).all()
data = open("thorns.cells.vtp", "rb").read()
block = data.index(b"_", data.index(b"<AppendedData")) + 1
def array(name, kind):
    offset = block + int(re.search(rb'Name="%s"[^>]*offset="(\d+)' % name, data)[1])
    size = struct.unpack_from("<Q", data, offset)[0]
    return numpy.frombuffer(data[offset + 8:offset + 8 + size], kind)
assert (array(b"frame", "<f8").reshape(2, 4) == cells["frames"]).all()
assert (array(b"radius", "<f8") == [.5, .25]).all()
assert (array(b"frame_", "<f4") == [5, 6]).all() and (array(b"points", "<f4") == [7, 8]).all()
assert numpy.allclose(array(b"Normals", "<f4").reshape(2, 3), [[0, 1, 0], [0, 0, 1]])
)"));
}

TEST(CellWriter, RefusesOtherEndings) {
    const CellsOfSquare square;
    const Result<void> refused = write_cells("cells.csv", square.mesh, square.cells, {});
    ASSERT_FALSE(refused.has_value());
    EXPECT_THAT(refused.error().message, HasSubstr("ends in .npz or .vtp"));
}

TEST(CellWriter, ArchivesWithoutEntriesAreArchives) {
    const Result<std::string> bytes = encode_zip({});
    ASSERT_TRUE(bytes.has_value());
    EXPECT_EQ(bytes->size(), 22u);
}

TEST(CellWriter, FilesAreTheSameOnAnyNumberOfThreads) {
    const SurfaceMesh mesh = test::sphere_with_texture(8);
    std::vector<std::string> first;
    for (const int threads : {1, 3}) {
        Team team(threads);
        const SurfaceCells cells = test::cells_of(mesh, 200, threads);
        const CellFilter filter(mesh, cells, team);
        std::vector<Channel> channels{
            {"u", std::vector<float>(cells.areas.begin(), cells.areas.end())}};
        const PaintedCells look{1,
                                channels[0].values,
                                [](std::span<const float> values, const SurfacePlace&) -> Colour {
                                    return {10 * values[0], 0.5F, 0};
                                },
                                {}};
        const std::vector<SurfacePlace> places = places_of_points(mesh);
        const std::vector<Colour> colours = colours_at(places, filter, look, team);
        const std::vector<Channel> points = values_at(places, filter, channels, team);
        GlbLook glb;
        glb.colours = colours;
        const std::vector<std::string> files = {
            encode_ply(mesh, {colours, points}),      encode_obj(mesh, {colours, points}),
            encode_vtp(mesh, {colours, points}),      *encode_glb(mesh, glb),
            *encode_npz(mesh, cells, {{}, channels}), encode_vtp(mesh, cells, {{}, channels})};
        if (first.empty()) first = files;
        for (std::size_t k = 0; k < files.size(); ++k) EXPECT_TRUE(files[k] == first[k]) << k;
    }
}

TEST(PaintedCells, PointsHaveTheColourOfTheFilteredValues) {
    const CellsOfSquare square;
    Team team(2);
    const CellFilter filter(square.mesh, square.cells, team);
    const PaintedCells look{1,
                            square.channels[0].values,
                            [](std::span<const float> values, const SurfacePlace&) -> Colour {
                                return {values[0], 0.5F, 1 - values[0]};
                            },
                            {}};
    const std::vector<Colour> colours =
        colours_at(places_of_points(square.mesh), filter, look, team);
    const std::vector<Channel> values =
        values_at(places_of_points(square.mesh), filter, square.channels, team);
    for (std::size_t p = 0; p < colours.size(); ++p) {
        EXPECT_EQ(colours[p], (Colour{values[0].values[p], 0.5F, 1 - values[0].values[p]}));
    }
}

TEST(PointValues, AreThoseOfTheCellsAround) {
    const CellsOfSquare square;
    Team one(1), two(2);
    const CellFilter filter(square.mesh, square.cells, one);
    const std::vector<SurfacePlace> places = places_of_points(square.mesh);
    const std::vector<Channel> values = values_at(places, filter, square.channels, one);
    ASSERT_EQ(values.size(), 2u);
    EXPECT_EQ(values[0].name, "u");
    ASSERT_EQ(values[0].values.size(), square.mesh.points.size());
    for (std::size_t p = 0; p < square.mesh.points.size(); ++p) {
        const double x = square.mesh.points[p].x;
        // Points at the sides are outside of the outermost cells' centres.
        const double tolerance = x > 0.3 && x < 0.7 ? 0.1 : 0.25;
        EXPECT_NEAR(values[0].values[p], x, tolerance);
    }
    EXPECT_EQ(values_at(places, filter, square.channels, two)[0].values, values[0].values);
}

}  // namespace
}  // namespace cascade
