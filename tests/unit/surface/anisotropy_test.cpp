// Cells that are longer than wide, and diffusion over them.
#include "surface/make_cells.h"
#include "unit/surface/cell_checks.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

using test::never;

/// The square from 0 to 1 along both axes, made of n² squares.
SurfaceMesh plane(std::uint32_t n) {
    PolygonSoup soup;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) soup.points.push_back({1.0 * i / n, 1.0 * j / n, 0});
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = (n + 1) * j + i;
            for (const std::uint32_t corner : {a, a + 1, a + n + 2, a + n + 1})
                soup.corners.push_back(corner);
            soup.ends.push_back(soup.corners.size());
        }
    }
    return make_mesh(std::move(soup))->mesh;
}

Anisotropy constant(const SurfaceMesh& mesh, Vector3d direction, double ratio) {
    return {std::vector<Vector3d>(mesh.triangles.size(), direction),
            std::vector<double>(mesh.triangles.size(), ratio)};
}

SurfaceCells stretched_cells(const SurfaceMesh& mesh, std::uint64_t count,
                             const Anisotropy& anisotropy, int threads = 2) {
    Team team(threads);
    CellOptions options;
    options.count = count;
    options.anisotropy = &anisotropy;
    return *make_cells(mesh, options, team, never);
}

/// Weighted sums of squared distances, along a direction and across it.
struct SquaresAlongAndAcross {
    double along = 0, across = 0;
    void add(Vector3d offset, Vector3d direction, double weight) {
        const Vector3d side = {-direction.y, direction.x, 0};
        along += weight * dot(offset, direction) * dot(offset, direction);
        across += weight * dot(offset, side) * dot(offset, side);
    }
};

TEST(Stretch, ContractsAlongAndKeepsAreas) {
    const Stretch stretch = Stretch::along({3, 4}, 4);
    const Vector2d along = stretch({3, 4}), across = stretch({-4, 3});
    EXPECT_NEAR(along.x, 1.5, 1e-12);
    EXPECT_NEAR(along.y, 2, 1e-12);
    EXPECT_NEAR(across.x, -8, 1e-12);
    EXPECT_NEAR(across.y, 6, 1e-12);
    EXPECT_NEAR(stretch.xx * stretch.yy - stretch.xy * stretch.xy, 1, 1e-12);
    const Vector2d back = stretch.inverse()(stretch({0.3, -0.7}));
    EXPECT_NEAR(back.x, 0.3, 1e-12);
    EXPECT_NEAR(back.y, -0.7, 1e-12);
    // The matrix is diagonal in a frame whose x axis is the direction of the stretch.
    const Stretch turned = stretch.in_frame({0.6, 0.8});
    EXPECT_NEAR(turned.xx, 0.5, 1e-12);
    EXPECT_NEAR(turned.xy, 0, 1e-12);
    EXPECT_NEAR(turned.yy, 2, 1e-12);
}

TEST(Anisotropy, CellsAreLongerThanWide) {
    for (const std::uint32_t n : {3u, 40u}) {
        const SurfaceMesh mesh = plane(n);
        const Vector3d direction = unit(Vector3d{2, 1, 0});
        for (const double ratio : {1.0, 2.0, 4.0}) {
            const SurfaceCells cells =
                stretched_cells(mesh, 1500, constant(mesh, direction * 7, ratio));
            test::expect_areas_sum_to(mesh, cells);
            test::expect_symmetric_edges(cells);
            SquaresAlongAndAcross spread;
            for (std::uint32_t k = 0; k < 1500; ++k) {
                const Vector3d p = position_of(mesh, cells.places[k]);
                if (std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5)) > 0.35) continue;
                for (const VoronoiEdge& edge : cells.edges_of(k)) {
                    spread.add(position_of(mesh, cells.places[edge.neighbour]) - p, direction, 1);
                }
            }
            EXPECT_NEAR(std::sqrt(spread.along / spread.across) / ratio, 1, 0.05)
                << n << " " << ratio;
        }
    }
}

TEST(Anisotropy, DiffusionSpreadsFartherAlongTheDirection) {
    const SurfaceMesh mesh = plane(20);
    const Vector3d direction = unit(Vector3d{1, -1, 0});
    const double ratio = 3;
    const SurfaceCells cells = stretched_cells(mesh, 6000, constant(mesh, direction, ratio));
    // Diffusion begins with a spot in the middle and ends when the spot is a tenth as wide as the
    // square.
    std::vector<double> c(6000);
    const Vector3d middle = {0.5, 0.5, 0};
    const auto spread_of = [&] {
        SquaresAlongAndAcross spread;
        double sum = 0;
        for (std::size_t k = 0; k < c.size(); ++k) {
            spread.add(position_of(mesh, cells.places[k]) - middle, direction,
                       c[k] * cells.areas[k]);
            sum += c[k] * cells.areas[k];
        }
        return SquaresAlongAndAcross{spread.along / sum, spread.across / sum};
    };
    for (std::size_t k = 0; k < c.size(); ++k) {
        const Vector3d d = position_of(mesh, cells.places[k]) - middle;
        c[k] = std::exp(-dot(d, d) / 2 / 0.0009);
    }
    const SquaresAlongAndAcross before = spread_of();
    const double step = 0.1 / 6000, time = 0.002;
    for (double t = 0; t < time - step / 2; t += step) {
        const std::vector<double> change = test::laplacian(cells, c);
        for (std::size_t k = 0; k < c.size(); ++k) c[k] += step * change[k];
    }
    const SquaresAlongAndAcross after = spread_of();
    // The variance grows by 2 D t, with D = ratio along and 1 / ratio across.
    EXPECT_NEAR((after.along - before.along) / (2 * time) / ratio, 1, 0.05);
    EXPECT_NEAR((after.across - before.across) / (2 * time) * ratio, 1, 0.05);
}

TEST(Anisotropy, WorksOnASphereOnAnyNumberOfThreads) {
    const SurfaceMesh mesh = test::sphere(12);
    Anisotropy anisotropy = constant(mesh, {0, 0, 1}, 3);
    for (std::size_t t = 0; t < anisotropy.ratio.size(); t += 2) anisotropy.ratio[t] = 2;
    anisotropy.direction[5] = {};  // This element has no direction.
    const SurfaceCells one = stretched_cells(mesh, 900, anisotropy, 1),
                       three = stretched_cells(mesh, 900, anisotropy, 3);
    EXPECT_EQ(one.areas, three.areas);
    EXPECT_EQ(one.ends, three.ends);
    test::expect_areas_sum_to(mesh, one);
    test::expect_symmetric_edges(one);
    EXPECT_EQ(test::parts_of(one), 1u);
}

TEST(Anisotropy, OfRatioOneChangesNothing) {
    const SurfaceMesh mesh = test::box();
    Team team(2);
    CellOptions options;
    options.count = 300;
    const auto plain = make_cells(mesh, options, team, never);
    EXPECT_EQ(stretched_cells(mesh, 300, constant(mesh, {1, 2, 3}, 1)).areas, plain->areas);
}

}  // namespace
}  // namespace cascade
