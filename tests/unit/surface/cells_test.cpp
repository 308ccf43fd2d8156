// Places spread over surfaces, and the cells around them, against what is known of both.
#include "surface/relax.h"
#include "surface/scatter.h"
#include "surface/unfolding.h"
#include "unit/surface/shapes.h"

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
    const SurfaceMesh mesh = box();
    for (std::uint32_t t = 0; t < 12; ++t) {
        const SurfacePlace start = {t, {0.3, 0.45, 0.25}};
        // Along the direction of an edge of the cube the way is closed after four sides.
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
    const SurfaceMesh mesh = square();
    const FlatTriangle flat = own_frame(mesh, 0);
    const SurfacePlace start = {0, {0.2, 0.5, 0.3}};
    const SurfacePlace end = walk(mesh, start, (flat[1] - flat[0]) * 9).place;
    const Vector3d p = position_of(mesh, end);
    EXPECT_NEAR(std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5)), 0.5, 1e-12);
}

TEST(Unfolding, LaysACubesNetFlat) {
    const SurfaceMesh mesh = box();
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
    const SurfaceMesh mesh = box();
    std::map<std::uint32_t, int> on_triangle;
    for (const SurfacePlace& place : scatter(mesh, 12'000, 7)) {
        ++on_triangle[place.triangle];
        for (const double weight : place.weights) EXPECT_GE(weight, 0);
    }
    for (const auto& [triangle, count] : on_triangle) EXPECT_NEAR(count, 1000, 1) << triangle;
}

/// Standard deviation over mean of the distance to the nearest other place.
double unevenness(const SurfaceMesh& mesh, const std::vector<SurfacePlace>& places) {
    double sum = 0, squares = 0;
    for (std::size_t a = 0; a < places.size(); ++a) {
        double nearest = 1e9;
        for (std::size_t b = 0; b < places.size(); ++b) {
            if (a == b) continue;
            nearest = std::min(nearest, length(position_of(mesh, places[a]) - position_of(mesh, places[b])));
        }
        sum += nearest;
        squares += nearest * nearest;
    }
    const auto count = static_cast<double>(places.size());
    return std::sqrt(squares / count - sum / count * (sum / count)) / (sum / count);
}

TEST(Relax, PlacesBecomeEven) {
    const SurfaceMesh mesh = sphere(16);
    const double random = unevenness(mesh, scatter(mesh, 800, 1));
    const double relaxed = unevenness(mesh, even_places(mesh, 800));
    EXPECT_GT(random, 0.35);  // Of independent places it would be 0.52.
    EXPECT_LT(relaxed, 0.08);
}

TEST(Relax, ThreadsDoNotMatter) {
    const SurfaceMesh mesh = box();
    const auto one = even_places(mesh, 500, 1, 10), three = even_places(mesh, 500, 3, 10);
    for (std::size_t k = 0; k < one.size(); ++k) {
        EXPECT_EQ(one[k].triangle, three[k].triangle);
        EXPECT_EQ(one[k].weights, three[k].weights);
    }
}

TEST(VoronoiCells, AreasAreTheSurface) {
    for (const SurfaceMesh& mesh : {square(), box(), sphere(20)}) {
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

TEST(VoronoiCells, WallsAreSymmetricAndAboutSix) {
    const SurfaceCells cells = cells_of(box(), 1200);
    EXPECT_NEAR(static_cast<double>(cells.walls.size()) / 1200, 6, 0.1);
    for (std::uint32_t i = 0; i < 1200; ++i) {
        for (const CellWall& wall : cells.walls_of(i)) {
            bool is_found = false;
            for (const CellWall& back : cells.walls_of(wall.neighbour)) {
                if (back.neighbour != i) continue;
                is_found = true;
                EXPECT_EQ(back.length, wall.length);
                EXPECT_EQ(back.distance, wall.distance);
            }
            EXPECT_TRUE(is_found);
        }
    }
}

/// (Σ wall (c_j − c_i) length / distance) / area.
std::vector<double> laplacian(const SurfaceCells& cells, const std::vector<double>& c) {
    std::vector<double> result;
    for (std::size_t i = 0; i < c.size(); ++i) {
        double sum = 0;
        for (const CellWall& wall : cells.walls_of(i)) {
            sum += (c[wall.neighbour] - c[i]) * wall.length / wall.distance;
        }
        result.push_back(sum / cells.areas[i]);
    }
    return result;
}

/// What ⟨f, L f⟩ / ⟨f, f⟩ is, with areas as weights: minus the rate at which f decays.
double decay_rate(const SurfaceCells& cells, const std::vector<double>& f) {
    const std::vector<double> lap = laplacian(cells, f);
    double above = 0, below = 0;
    for (std::size_t k = 0; k < f.size(); ++k) {
        above -= f[k] * lap[k] * cells.areas[k];
        below += f[k] * f[k] * cells.areas[k];
    }
    return above / below;
}

TEST(VoronoiCells, SphericalHarmonicsDecayAtTheirRates) {
    const SurfaceMesh mesh = sphere(40);
    double last_error = 1;
    for (const std::size_t count : {500, 2000, 8000}) {
        const SurfaceCells cells = cells_of(mesh, count);
        double worst = 0;
        for (int l = 1; l <= 3; ++l) {
            std::vector<double> f;
            for (const SurfacePlace& place : cells.places) {
                const double z = unit(position_of(mesh, place)).z;
                f.push_back(l == 1 ? z : l == 2 ? 1.5 * z * z - 0.5 : 2.5 * z * z * z - 1.5 * z);
            }
            const double error = std::abs(decay_rate(cells, f) / (l * (l + 1)) - 1);
            RecordProperty("error_l" + std::to_string(l) + "_" + std::to_string(count), std::to_string(error));
            worst = std::max(worst, error);
        }
        EXPECT_LT(worst, last_error);
        last_error = worst;
    }
    EXPECT_LT(last_error, 0.01);
}

}  // namespace
}  // namespace cascade
