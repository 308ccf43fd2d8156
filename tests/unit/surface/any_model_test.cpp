// Computations on surfaces give finite results for any mesh that a file may contain.
#include "core/hash.h"
#include "surface/cell_gradient.h"
#include "surface/curvature.h"
#include "surface/distance.h"
#include "surface/key_directions.h"
#include "surface/key_positions.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cascade::test {
namespace {

/// Triangles of any size between few points, of which some coincide or are on one line.
PolygonSoup random_soup(std::uint32_t seed) {
    const auto word = [&](std::uint32_t k, std::uint32_t what) {
        return pcg4d({k, what, seed, 17})[0];
    };
    const double scale = std::pow(10.0, static_cast<double>(word(0, 0) % 101) - 50);
    const std::uint32_t points = 4 + word(1, 0) % 30, triangles = 2 + word(2, 0) % 60;
    const std::uint32_t grid = 2 + word(3, 0) % 4;
    PolygonSoup soup;
    for (std::uint32_t k = 0; k < points; ++k) {
        const auto at = [&](std::uint32_t axis) {
            const std::uint32_t step = word(k, 1 + axis) % grid;
            // Some points are moved a little away from the grid.
            const double off = word(k, 7) % 5 == 0 ? std::pow(10.0, -1.0 - word(k, 8) % 16) : 0;
            return scale * (step + off);
        };
        soup.points.push_back({at(0), at(1), at(2)});
    }
    for (std::uint32_t k = 0; k < triangles; ++k) {
        for (std::uint32_t c = 0; c < 3; ++c) soup.corners.push_back(word(k, 10 + c) % points);
        soup.ends.push_back(soup.corners.size());
    }
    return soup;
}

bool all_finite(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool all_unit(const std::vector<Vector3d>& vectors) {
    return std::all_of(vectors.begin(), vectors.end(),
                       [](Vector3d v) { return std::abs(length(v) - 1) < 1e-6; });
}

void expect_finite_geometry(const SurfaceMesh& mesh) {
    const PrincipalCurvatures curvature = principal_curvatures(mesh);
    EXPECT_TRUE(all_finite(curvature.high));
    EXPECT_TRUE(all_finite(curvature.low));
    EXPECT_TRUE(all_unit(curvature.high_direction));
    EXPECT_TRUE(all_finite(turk_radii(mesh)));
    const TangentPlanes planes = planes_of_triangles(mesh);
    EXPECT_TRUE(all_unit(axis_directions(planes, {0, 0, 1}, DirectionKind::arrows)));
    EXPECT_TRUE(all_unit(directions(
        planes, curvature_lines(mesh, planes, curvature, Principal::high), DirectionKind::lines)));
}

void expect_finite_cells(const SurfaceMesh& mesh) {
    const SurfaceCells cells = cells_of(mesh, 60);
    Team team(2);
    for (const Vector3d& weight : cell_gradient_weights(mesh, cells, team, never)) {
        EXPECT_TRUE(std::isfinite(weight.x) && std::isfinite(weight.y) && std::isfinite(weight.z));
    }
    const Vector3d at = mesh.points[0];
    const std::vector<KeyValue> keys = {{at, 1}, {mesh.points.back(), 2}};
    const auto values = nearest_key_values(mesh, cells, keys, never);
    const double size = length(facts_of(mesh).high - facts_of(mesh).low);
    for (const double value : smoothed(cells, values, size / 10, team, never)) {
        EXPECT_GE(value, 1);
        EXPECT_LE(value, 2);
    }
    // Distances are at least those along straight lines, except for rounding and the merging of
    // fronts.
    const SurfacePlace source = cells.places[0];
    const SurfaceDistance distance(mesh, std::span(&source, 1), never, {2'000});
    EXPECT_LT(distance.at(source).distance, 1e-9 * size);
    for (const SurfacePlace& place : cells.places) {
        const double straight = length(position_of(mesh, place) - position_of(mesh, source));
        EXPECT_GE(distance.at(place).distance, straight - 0.1 * size);
    }
    const TangentPlanes planes = planes_of_triangles(mesh);
    const KeyDirection key = {at, {1, 2, 3}};
    const auto field =
        key_directions(mesh, planes, std::span(&key, 1), DirectionKind::lines, never);
    EXPECT_TRUE(all_unit(field));
    EXPECT_TRUE(
        all_unit(smoothed_directions(planes, field, DirectionKind::lines, size / 5, team, never)));
}

TEST(AnyModel, HasFiniteGeometry) {
    int made = 0;
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        auto model = make_mesh(random_soup(seed));
        if (!model) continue;
        ++made;
        SCOPED_TRACE(seed);
        expect_manifold(model->mesh);
        expect_finite_geometry(model->mesh);
        expect_finite_cells(model->mesh);
        if (HasFailure()) break;
    }
    EXPECT_GT(made, 40);
}

}  // namespace
}  // namespace cascade::test
