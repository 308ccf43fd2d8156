// The faces or the points of models as cells, compared with known results.
#include "mesh/intrinsic_delaunay.h"
#include "surface/make_cells.h"
#include "unit/surface/cell_checks.h"

#include <gtest/gtest.h>

#include <numbers>

namespace cascade {
namespace {

/// A torus of n × m squares, each cut into two triangles. Every point was moved by its own random
/// shift.
SurfaceMesh rough_torus(int n, int m, double shift) {
    PolygonSoup soup;
    std::uint32_t word = 1;
    const auto moved = [&] {
        word = word * 1664525u + 1013904223u;
        return shift * (word / 4294967296.0 - 0.5);
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const double u = 2 * std::numbers::pi * (i + moved()) / n;
            const double v = 2 * std::numbers::pi * (j + moved()) / m;
            soup.points.push_back(
                {(2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)});
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i % n * m + j % m); };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            for (const std::uint32_t corner : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j),
                                               at(i + 1, j + 1), at(i, j + 1)}) {
                soup.corners.push_back(corner);
            }
            soup.ends.push_back(soup.corners.size() - 3);
            soup.ends.push_back(soup.corners.size());
        }
    }
    return make_mesh(std::move(soup))->mesh;
}

void expect_cells(const SurfaceMesh& mesh, const SurfaceCells& cells, std::size_t count) {
    ASSERT_EQ(cells.places.size(), count);
    test::expect_areas_sum_to(mesh, cells);
    test::expect_symmetric_edges(cells);
    EXPECT_EQ(test::parts_of(cells), facts_of(mesh).components);
    EXPECT_EQ(cells.bare_area, 0);
}

TEST(FaceCells, AreWhatTheModelHas) {
    const SurfaceMesh box = test::box();
    const SurfaceCells cells = face_cells(box);
    expect_cells(box, cells, 6);
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(cells.areas[k], 1, 1e-12);
        EXPECT_EQ(cells.edges_of(k).size(), 4u);
        for (const VoronoiEdge& edge : cells.edges_of(k)) {
            EXPECT_NEAR(edge.length, 1, 1e-12);
            EXPECT_NEAR(edge.distance, 1, 1e-12);
        }
        const Vector3d p = position_of(box, cells.places[k]);
        EXPECT_NEAR(length(p - Vector3d{0.5, 0.5, 0.5}), 0.5, 1e-12);
    }
}

TEST(FaceCells, OfTrianglesHaveThreeEdges) {
    SurfaceMesh mesh = rough_torus(30, 20, 0.4);
    const SurfaceCells cells = face_cells(mesh);
    expect_cells(mesh, cells, 1200);
    for (std::size_t k = 0; k < 1200; ++k) EXPECT_EQ(cells.edges_of(k).size(), 3u);
    // Without known faces, the triangles of a mesh are its cells.
    mesh.faces.clear();
    EXPECT_EQ(face_cells(mesh).areas, cells.areas);
}

TEST(FaceCells, SphericalHarmonicsDecayAtTheirRates) {
    double last_error = 1;
    for (const int n : {8, 16, 32}) {
        const SurfaceMesh mesh = test::sphere(n);
        const SurfaceCells cells = face_cells(mesh);
        expect_cells(mesh, cells, static_cast<std::size_t>(8 * n * n));
        const double worst = test::harmonics_error(mesh, cells);
        EXPECT_LT(worst, last_error);
        last_error = worst;
    }
    EXPECT_LT(last_error, 0.01);
}

TEST(VertexCells, SphericalHarmonicsDecayAtTheirRates) {
    double last_error = 1;
    for (const int n : {8, 16, 32}) {
        const SurfaceMesh mesh = test::sphere(n);
        const SurfaceCells cells = vertex_cells(mesh);
        expect_cells(mesh, cells, mesh.points.size());
        const double worst = test::harmonics_error(mesh, cells);
        EXPECT_LT(worst, last_error / 3);
        last_error = worst;
    }
    EXPECT_LT(last_error, 0.003);
}

TEST(VertexCells, WeightsAreTheCotangentsOnAFlatLattice) {
    // Equilateral triangles of side 1: every weight is 1/√3, and the area of every inner cell is
    // √3/2.
    PolygonSoup soup;
    const double height = std::sqrt(3) / 2;
    for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 6; ++i) soup.points.push_back({i + 0.5 * j, height * j, 0});
    }
    for (std::uint32_t j = 0; j < 5; ++j) {
        for (std::uint32_t i = 0; i < 5; ++i) {
            const std::uint32_t a = 6 * j + i;
            for (const std::uint32_t corner : {a, a + 1, a + 6, a + 1, a + 7, a + 6}) {
                soup.corners.push_back(corner);
            }
            soup.ends.push_back(soup.corners.size() - 3);
            soup.ends.push_back(soup.corners.size());
        }
    }
    const SurfaceMesh mesh = make_mesh(std::move(soup))->mesh;
    const SurfaceCells cells = vertex_cells(mesh);
    expect_cells(mesh, cells, 36);
    const std::size_t middle = 6 * 3 + 2;
    EXPECT_NEAR(cells.areas[middle], height, 1e-12);
    ASSERT_EQ(cells.edges_of(middle).size(), 6u);
    for (const VoronoiEdge& edge : cells.edges_of(middle))
        EXPECT_NEAR(edge.weight(), 1 / std::sqrt(3), 1e-12);
    // Linear functions are harmonic, wherever the points are.
    std::vector<double> f;
    for (const Vector3d& p : mesh.points) f.push_back(3 * p.x - 2 * p.y);
    EXPECT_NEAR(test::laplacian(cells, f)[middle], 0, 1e-12);
}

/// Squares of a plane with moved points, so that many triangles are obtuse.
SurfaceMesh rough_plane() {
    PolygonSoup soup;
    std::uint32_t word = 7;
    const auto moved = [&] {
        word = word * 1664525u + 1013904223u;
        return 0.8 * (word / 4294967296.0 - 0.5);
    };
    for (int j = 0; j <= 12; ++j) {
        for (int i = 0; i <= 12; ++i) {
            const bool is_inside = i > 0 && i < 12 && j > 0 && j < 12;
            soup.points.push_back(
                {i + (is_inside ? moved() : 0), 3 * j + (is_inside ? moved() : 0), 0});
        }
    }
    for (std::uint32_t j = 0; j < 12; ++j) {
        for (std::uint32_t i = 0; i < 12; ++i) {
            const std::uint32_t a = 13 * j + i;
            for (const std::uint32_t corner : {a, a + 1, a + 14, a, a + 14, a + 13})
                soup.corners.push_back(corner);
            soup.ends.push_back(soup.corners.size() - 3);
            soup.ends.push_back(soup.corners.size());
        }
    }
    return make_mesh(std::move(soup))->mesh;
}

TEST(VertexCells, ObtuseTrianglesAreFlippedAndKeepLinearFunctionsHarmonic) {
    const SurfaceMesh mesh = rough_plane();
    const SurfaceCells cells = vertex_cells(mesh);
    expect_cells(mesh, cells, mesh.points.size());
    std::vector<double> f;
    for (const Vector3d& p : mesh.points) f.push_back(p.x - 2 * p.y);
    const std::vector<double> lap = test::laplacian(cells, f);
    for (int j = 2; j < 11; ++j) {
        for (int i = 2; i < 11; ++i)
            EXPECT_NEAR(lap[static_cast<std::size_t>(13 * j + i)], 0, 1e-9);
    }
}

TEST(IntrinsicDelaunay, HasNoNegativeWeightsAndTheSameArea) {
    const SurfaceMesh mesh = rough_torus(40, 9, 0.8);
    const IntrinsicMesh flipped = intrinsic_delaunay(mesh);
    double area = 0;
    std::size_t changed = 0;
    for (std::uint32_t t = 0; t < flipped.triangles.size(); ++t) {
        area += flipped.area(t);
        changed += flipped.triangles[t] != mesh.triangles[t];
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = flipped.across[t][k], here{t, k};
            ASSERT_TRUE(other.exists());
            EXPECT_EQ(flipped.across[other.triangle][other.edge], here);
            EXPECT_EQ(flipped.triangles[t][k],
                      flipped.triangles[other.triangle][(other.edge + 1) % 3]);
            EXPECT_NEAR(flipped.lengths[t][k], flipped.lengths[other.triangle][other.edge], 1e-12);
            EXPECT_GE(flipped.cotangent(here) + flipped.cotangent(other), -1e-8);
        }
    }
    EXPECT_GT(changed, 20u);
    EXPECT_NEAR(area / mesh.total_area(), 1, 1e-10);
}

}  // namespace
}  // namespace cascade
