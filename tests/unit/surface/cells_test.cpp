// Places spread over surfaces, and the cells around them, compared with known results.
#include "core/hash.h"
#include "surface/convex_region.h"
#include "surface/relax.h"
#include "surface/scatter.h"
#include "surface/unfolding.h"
#include "surface/voronoi_cells.h"
#include "unit/surface/cell_checks.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace cascade {
namespace {

using test::box;
using test::cells_of;
using test::even_places;
using test::sphere;
using test::square;

TEST(Walk, GoesAroundACubeAndComesBack) {
    const SurfaceMesh mesh = test::box();
    for (std::uint32_t t = 0; t < 12; ++t) {
        const SurfacePlace start = {t, {0.3, 0.45, 0.25}};
        // A walk parallel to an edge of the cube returns to its start after four sides.
        const FlatTriangle flat = own_frame(mesh, t);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Vector2d edge = flat[(k + 1) % 3] - flat[k];
            if (std::abs(length(edge) - 1) > 1e-9) continue;
            const SurfacePlace end = walk(mesh, start, edge * 4).place;
            EXPECT_NEAR(length(position_of(mesh, end) - position_of(mesh, start)), 0, 1e-12);
        }
    }
}

TEST(Walk, StopsAtABoundary) {
    const SurfaceMesh mesh = test::square();
    const FlatTriangle flat = own_frame(mesh, 0);
    const SurfacePlace start = {0, {0.2, 0.5, 0.3}};
    const SurfacePlace end = walk(mesh, start, (flat[1] - flat[0]) * 9).place;
    const Vector3d p = position_of(mesh, end);
    EXPECT_NEAR(std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5)), 0.5, 1e-12);
}

TEST(Unfolding, LaysACubesNetFlat) {
    const SurfaceMesh mesh = test::box();
    const EdgeShapes shapes(mesh);
    Unfolding unfolding(mesh, shapes);
    const auto pieces = unfolding.around({0, {1.0 / 3, 1.0 / 3, 1.0 / 3}}, 0.9);
    double area = 0;
    for (const Unfolding::Piece& piece : pieces) {
        area += cross(piece.flat[1] - piece.flat[0], piece.flat[2] - piece.flat[0]) / 2;
    }
    EXPECT_DOUBLE_EQ(area, 0.5 * static_cast<double>(pieces.size()));
    EXPECT_GE(pieces.size(), 4u);
    EXPECT_LT(pieces.size(), 12u);
    EXPECT_TRUE(unfolding.flat_of(0));
    unfolding.around({5, {1, 0, 0}}, 1e-9);
    EXPECT_TRUE(unfolding.flat_of(5));
}

TEST(Scatter, PlacesAreAsDenseEverywhere) {
    const SurfaceMesh mesh = test::box();
    std::map<std::uint32_t, int> on_triangle;
    for (const SurfacePlace& place : scatter(mesh, 12'000, 7)) {
        ++on_triangle[place.triangle];
        for (const double weight : place.weights) EXPECT_GE(weight, 0);
    }
    for (const auto& [triangle, count] : on_triangle) EXPECT_NEAR(count, 1000, 1) << triangle;
}

/// The unevenness (see unevenness()) of points on a periodic square of side 1 which S. Lloyd's
/// method ("Least squares quantization in PCM", 1982) has moved to the centroids of their Voronoi
/// regions.
double unevenness_by_lloyd(std::size_t count, int rounds) {
    std::vector<Vector2d> points;
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto words = pcg4d({k, 5, 6, 7});
        points.push_back({words[0] / 4294967296.0, words[1] / 4294967296.0});
    }
    std::vector<double> nearest(count);
    for (int round = 0; round <= rounds; ++round) {
        std::vector<Vector2d> moved = points;
        for (std::size_t k = 0; k < count; ++k) {
            std::vector<std::pair<double, Vector2d>> others;
            for (std::size_t j = 0; j < count; ++j) {
                const Vector2d d = points[j] - points[k];
                const Vector2d image = {d.x - std::round(d.x), d.y - std::round(d.y)};
                if (j != k && length(image) < 0.4) others.push_back({length(image), image});
            }
            std::sort(others.begin(), others.end(),
                      [](const auto& a, const auto& b) { return a.first < b.first; });
            nearest[k] = others[0].first;
            ConvexRegion region = ConvexRegion::square(0.2);
            for (const auto& [distance, place] : others) {
                if (distance < 2 * region.farthest()) region.cut_halfway(place, 0);
            }
            Vector2d moment;
            const auto& edges = region.edges();
            for (std::size_t e = 0; e < edges.size(); ++e) {
                const Vector2d a = edges[e].from, b = edges[(e + 1) % edges.size()].from;
                moment = moment + (a + b) * (cross(a, b) / 6);
            }
            moved[k] = points[k] + moment * (1 / region.area());
        }
        points = moved;
    }
    return test::relative_deviation(nearest);
}

TEST(Relax, PlacesBecomeAsEvenAsByLloydsMethod) {
    const SurfaceMesh mesh = test::sphere(16);
    const double random = test::unevenness(mesh, scatter(mesh, 800, 1));
    const double relaxed = test::unevenness(mesh, even_places(mesh, 800, 2, relaxing_rounds));
    const double lloyd = unevenness_by_lloyd(400, relaxing_rounds);
    RecordProperty("lloyd", std::to_string(lloyd));
    RecordProperty("relaxed", std::to_string(relaxed));
    EXPECT_GT(random, 0.35);  // Independent random places would give 0.52.
    EXPECT_LT(relaxed, random / 5);
    EXPECT_LT(relaxed, lloyd);
    // The usual number of rounds is so large that more rounds make no difference.
    const double longer = test::unevenness(mesh, even_places(mesh, 800, 2, 3 * relaxing_rounds));
    EXPECT_NEAR(longer, relaxed, 0.02);
}

TEST(Relax, ThreadsDoNotMatter) {
    const SurfaceMesh mesh = test::box();
    const auto one = even_places(mesh, 500, 1, 10), three = even_places(mesh, 500, 3, 10);
    for (std::size_t k = 0; k < one.size(); ++k) {
        EXPECT_EQ(one[k].triangle, three[k].triangle);
        EXPECT_EQ(one[k].weights, three[k].weights);
    }
}

TEST(VoronoiCells, AreasAreTheSurface) {
    for (const SurfaceMesh& mesh : {test::square(), test::box(), test::sphere(20)}) {
        const SurfaceCells cells = cells_of(mesh, 1000);
        double sum = cells.bare_area;
        for (const double area : cells.areas) {
            EXPECT_GT(area, 0);
            sum += area;
        }
        EXPECT_NEAR(sum / facts_of(mesh).area, 1, 1e-12);
        EXPECT_EQ(cells.bare_area, 0);
    }
}

TEST(VoronoiCells, EdgesAreSymmetricAndAboutSix) {
    const SurfaceCells cells = cells_of(test::box(), 1200);
    EXPECT_NEAR(static_cast<double>(cells.edges.size()) / 1200, 6, 0.1);
    test::expect_symmetric_edges(cells);
}

TEST(VoronoiCells, SphericalHarmonicsDecayAtTheirRates) {
    const SurfaceMesh mesh = test::sphere(40);
    double last_error = 1;
    for (const std::size_t count : {500, 2000, 8000}) {
        const double worst = test::harmonics_error(mesh, cells_of(mesh, count));
        EXPECT_LT(worst, last_error);
        last_error = worst;
    }
    EXPECT_LT(last_error, 0.01);
}

}  // namespace
}  // namespace cascade
