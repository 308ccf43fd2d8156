// Maps of the cells on a surface, compared with shapes whose heights and normals are known.
#include "run/pictures/cells_from_outside.h"

#include "export/bake.h"
#include "tests/support/never.h"
#include "unit/export/example_surfaces.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <numbers>

namespace cascade {
namespace {

/// The unit ball, made of facets at most about 1/1000 away from the sphere.
TriangleMesh fine_ball() {
    constexpr std::uint32_t rows = 64, columns = 128;
    TriangleMesh ball;
    for (std::uint32_t j = 0; j <= rows; ++j) {
        const float latitude = std::numbers::pi_v<float> * static_cast<float>(j) / rows;
        for (std::uint32_t i = 0; i < columns; ++i) {
            const float longitude = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / columns;
            const float ring = std::sin(latitude);
            ball.normals.push_back(
                {ring * std::cos(longitude), ring * std::sin(longitude), -std::cos(latitude)});
            if (j == rows) continue;
            const std::uint32_t a = j * columns + i, b = j * columns + (i + 1) % columns;
            ball.triangles.push_back({a, b, b + columns});
            ball.triangles.push_back({a, b + columns, a + columns});
        }
    }
    ball.positions = ball.normals;
    return ball;
}

Instances one_ball(Vector3d place, double radius) {
    Placement each;
    each.place = place;
    each.scale = {radius, radius, radius};
    each.colour = {1, 0, 0};
    return {{fine_ball()}, {each}};
}

TEST(CellsFromOutside, MapsOfABallAreThoseOfItsFormula) {
    const SurfaceMesh mesh = test::flat_square(3);
    constexpr double radius = 0.25;
    const Vector3d middle{0.5, 0.5, 0};
    const CellsFromOutside cells(mesh, one_ball(middle, radius));
    const SkinColours skin{{0, 0, 1}, nullptr, {}};
    BakeOptions options;
    options.width = options.height = 64;
    options.samples = 1;
    Team team(2);
    const auto baked = bake(
        mesh, [&] { return std::make_unique<OutsideSamples>(cells, skin); }, options, team,
        test::never);
    ASSERT_TRUE(baked.has_value()) << baked.error().message;
    EXPECT_EQ(baked->heights.low, 0);
    EXPECT_NEAR(static_cast<double>(baked->heights.high), radius, 0.002);
    int on_ball = 0;
    for (std::int64_t row = 0; row < 64; ++row) {
        for (std::int64_t column = 0; column < 64; ++column) {
            const double x = (static_cast<double>(column) + 0.5) / 64 - middle.x;
            const double y = 1 - (static_cast<double>(row) + 0.5) / 64 - middle.y;
            const double square = radius * radius - x * x - y * y;
            if (std::abs(square) < 0.008) continue;  // At the rim facets are seen from the side.
            const bool is_ball = square > 0;
            on_ball += is_ball;
            const double height = is_ball ? std::sqrt(square) : 0;
            const Vector3d normal =
                is_ball ? Vector3d{x, y, height} * (1 / radius) : Vector3d{0, 0, 1};
            const Colour expected = is_ball ? Colour{1, 0, 0} : Colour{0, 0, 1};
            EXPECT_EQ(baked->colour.at(column, row), expected);
            const double seen = static_cast<double>(baked->relief.at(column, row)[0]) *
                                static_cast<double>(baked->heights.high);
            EXPECT_NEAR(seen, height, 0.002);
            const Colour direction = baked->normals.at(column, row);
            EXPECT_NEAR(static_cast<double>(direction[0]), 0.5 + normal.x / 2, 0.01);
            EXPECT_NEAR(static_cast<double>(direction[1]), 0.5 + normal.y / 2, 0.01);
            EXPECT_NEAR(static_cast<double>(direction[2]), 0.5 + normal.z / 2, 0.01);
        }
    }
    EXPECT_GT(on_ball, 400);
}

TEST(CellsFromOutside, AnotherPartOfTheSurfaceHidesNothing) {
    // A square that faces upwards, and 0.3 above it another one that faces downwards and carries a
    // ball.
    PolygonSoup soup;
    for (const double z : {0.0, 0.3}) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
            soup.points.push_back({x, y, z});
        }
        for (const std::uint32_t k : {0u, 1u, 2u, 3u}) {
            soup.corners.push_back(first + (z > 0 ? 3 - k : k));
        }
        soup.ends.push_back(soup.corners.size());
    }
    const SurfaceMesh mesh = test::mesh_of(std::move(soup));
    const CellsFromOutside cells(mesh, one_ball({0.5, 0.5, 0.3}, 0.1));
    int seen = 0;
    for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            // A place close to the middle of a triangle's edge: the diagonal or a side of the
            // square.
            std::array<double, 3> weights{0.495, 0.495, 0.495};
            weights[corner] = 0.01;
            const SurfacePlace place{triangle, weights};
            const Vector3d at = position_of(mesh, place);
            const bool is_at_ball = std::hypot(at.x - 0.5, at.y - 0.5) < 0.09 && at.z > 0.2;
            EXPECT_EQ(cells.above(place).has_value(), is_at_ball) << at.x << ' ' << at.y;
            seen += is_at_ball;
        }
    }
    EXPECT_EQ(seen, 2) << "both triangles of the upper square";
}

TEST(CellsFromOutside, WithoutThingsThereIsTheSkin) {
    const SurfaceMesh mesh = test::flat_square(1);
    const CellsFromOutside cells(mesh, {});
    EXPECT_FALSE(cells.above({0, {0.3, 0.3, 0.4}}).has_value());
}

}  // namespace
}  // namespace cascade
