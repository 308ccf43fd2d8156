// What cells sense, compared with theory.
#include "tissue/sense_kernel.h"

#include "mesh/edge_pairs.h"
#include "mesh/shapes.h"
#include "tests/support/random_stream.h"
#include "tissue/tissue.h"

#include <cmath>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

NearPlace found(const Surroundings& around, Vector3d point) {
    return around.near(point, NearPlace::no_triangle);
}

TEST(Surroundings, OfASphere) {
    const SurfaceMesh mesh = *sphere_mesh(0.5, 0.02);
    const auto around = around_surface(mesh);
    RandomStream random(1);
    for (int k = 0; k < 200; ++k) {
        const Vector3d direction =
            unit(Vector3d{random.symmetric(), random.symmetric(), random.symmetric()});
        for (const double radius : {0.4, 0.5001, 0.7}) {
            const NearPlace near = found(*around, direction * radius);
            EXPECT_NEAR(near.off, radius - 0.5, 2e-4);
            // The error of the normal grows with the distance from the surface, whose triangles are
            // flat.
            EXPECT_LT(length(near.normal - direction), 2e-3 + 0.03 * std::abs(near.off));
            EXPECT_NEAR(length(near.normal), 1, 1e-12);
            EXPECT_FALSE(near.is_beyond);
        }
    }
    EXPECT_TRUE(std::isnan(found(*around, {NAN, 0, 0}).off));
}

/// `off` and the normal are continuous across edges of triangles.
TEST(Surroundings, AreSmoothAlongASurface) {
    const SurfaceMesh mesh = *torus_mesh(0.35, 0.15, 0.03);
    const auto around = around_surface(mesh);
    std::uint32_t triangle = NearPlace::no_triangle;
    NearPlace last = found(*around, {0.51, 0, 0});
    constexpr int steps = 40000;
    for (int k = 1; k <= steps; ++k) {
        const double angle = 2 * M_PI * k / steps;
        const NearPlace near =
            around->near({0.51 * std::cos(angle), 0, 0.51 * std::sin(angle)}, triangle);
        EXPECT_LT(std::abs(near.off - last.off), 1e-4);
        EXPECT_LT(length(near.normal - last.normal), 5e-3);
        triangle = near.place.triangle;
        last = near;
    }
}

TEST(Surroundings, HoldCellsAtTheBoundaryOfASheet) {
    const SurfaceMesh mesh =
        mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 2, 3}}});
    const auto around = around_surface(mesh);
    const Vector3d beyond{1.25, 0.5, 0.125};
    const NearPlace near = found(*around, beyond);
    EXPECT_TRUE(near.is_beyond);
    EXPECT_EQ(near.off, 0.125);
    EXPECT_EQ(around->held_inside(beyond, near), (Vector3d{1, 0.5, 0.125}));
    const Vector3d inside{0.5, 0.25, -0.125};
    EXPECT_EQ(found(*around, inside).off, -0.125);
    EXPECT_EQ(around->held_inside(inside, found(*around, inside)), inside);
}

TEST(Surroundings, OfAPlane) {
    const auto around = in_box({1, 0.5, 0}, {true, false, false});
    const Vector3d point{1.25, 0.75, 0.1};
    const NearPlace near = found(*around, point);
    EXPECT_EQ(near.off, 0.1);
    EXPECT_EQ(near.normal, (Vector3d{0, 0, 1}));
    EXPECT_EQ(around->held_inside(point, near), (Vector3d{0.25, 0.5, 0.1}));
    const double nearly = around->held_inside({-1e-18, 0, 0}, near).x;
    EXPECT_GE(nearly, 0);
    EXPECT_LT(nearly, 1);
    EXPECT_EQ(around->period(), (std::array<double, 3>{1, 0, 0}));
    EXPECT_EQ(found(*in_box({1, 1, 1}, {}), {2, 3, 4}).off, 0);
}

/// Cells at given places, and the values that they sense.
struct Sensed {
    Sensed(const std::vector<Vector3d>& places, std::shared_ptr<const Surroundings> around,
           std::vector<Sense> senses, int threads) {
        TissueRecord record;
        record.species.resize(3);
        for (const Vector3d& place : places) {
            record.numbers.push_back(static_cast<std::uint32_t>(record.numbers.size()));
            record.species[0].push_back(place.x);
            record.species[1].push_back(place.y);
            record.species[2].push_back(place.z);
        }
        const Tissue tissue(record, Precision::binary64);
        auto triangles = std::make_shared<NearTriangles>();
        triangles->before = triangles->now = tissue.triangles;
        const KernelPointer kernel = make_sense_kernel(around, senses, triangles);
        std::vector<const double*> fields;
        for (const Field& field : tissue.species) fields.push_back(field.origin<double>());
        std::vector<Field> planes;
        std::vector<double*> results;
        for (std::size_t k = 0; k < senses.size(); ++k) {
            planes.emplace_back(tissue.layout(), Precision::binary64);
        }
        for (Field& plane : planes) results.push_back(plane.origin<double>());
        Team team(threads);
        team.run([&](int thread) {
            kernel->run(KernelArgumentsOf<double>{fields, {}, {}, results, tissue.layout()},
                        {split_rows(tissue.layout().height, thread, threads)});
        });
        for (const Field& plane : planes) {
            values.emplace_back();
            for (std::size_t k = 0; k < places.size(); ++k) {
                values.back().push_back(plane.origin<double>()[tissue.element(k)]);
            }
        }
        nearest = triangles->now;
    }
    std::vector<std::vector<double>> values;  ///< Indexed by sense and cell.
    std::vector<std::uint32_t> nearest;
};

TEST(SenseKernel, WritesWhatIsAskedForOnAnyNumberOfThreads) {
    const SurfaceMesh mesh = *torus_mesh(0.35, 0.15, 0.05);
    const std::shared_ptr<const Surroundings> around = around_surface(mesh);
    std::vector<float> heights;
    for (const Vector3d& point : mesh.points) heights.push_back(static_cast<float>(point.y));
    RandomStream random(5);
    std::vector<Vector3d> places;
    for (int k = 0; k < 500; ++k) {
        places.push_back(Vector3d{random.symmetric(), random.symmetric(), random.symmetric()} *
                         0.5);
    }
    const std::vector<Sense> senses{{Sense::Kind::off},
                                    {Sense::Kind::normal_y},
                                    {Sense::Kind::value, of_points(mesh, heights)},
                                    {Sense::Kind::value, feature_of(mesh)}};
    const Sensed one(places, around, senses, 1), two(places, around, senses, 2);
    EXPECT_EQ(one.values, two.values);
    EXPECT_EQ(one.nearest, two.nearest);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const NearPlace near = found(*around, places[k]);
        EXPECT_EQ(one.nearest[k], near.place.triangle);
        EXPECT_EQ(one.values[0][k], near.off);
        EXPECT_EQ(one.values[1][k], near.normal.y);
        EXPECT_NEAR(one.values[2][k], near.position.y, 1e-7);
        EXPECT_NEAR(one.values[3][k], std::sqrt(mesh.area(near.place.triangle)), 1e-7);
    }
}

/// A linear field is interpolated exactly between the centres of cells.
TEST(SenseKernel, ReadsGridsBetweenTheirCells) {
    Grid grid;
    grid.width = 8;
    grid.height = 4;
    Field values{PlaneLayout(grid)};
    for (std::int64_t j = 0; j < 4; ++j) {
        for (std::int64_t i = 0; i < 8; ++i) values.at(i, j) = static_cast<float>(i + 10 * j);
    }
    const auto at = [&](double x, double y, Boundary boundary) {
        NearPlace near;
        near.position = {x / 8, y / 8, 0};
        return of_grid(values, boundary)(near);
    };
    EXPECT_NEAR(at(3.25, 1.75, Boundary::no_flux), 2.75 + 10 * 1.25, 1e-12);
    EXPECT_NEAR(at(0, 1.5, Boundary::no_flux), 10, 1e-12);
    EXPECT_NEAR(at(0, 1.5, Boundary::periodic), 13.5, 1e-12);
    EXPECT_NEAR(at(8, 1.5, Boundary::periodic), 13.5, 1e-12);
    EXPECT_NEAR(at(-800, 1.5, Boundary::periodic), 13.5, 1e-12);
    EXPECT_NEAR(at(1e300, 1.5, Boundary::no_flux), 17, 1e-12);
    EXPECT_TRUE(std::isfinite(at(NAN, 1, Boundary::periodic)));
}

/// The cells of the model have the values of a linear function of the place.
TEST(SenseKernel, ReadsTheCellsOfAModel) {
    const SurfaceMesh mesh = *sphere_mesh(0.5, 0.02);
    SurfaceCells cells;
    std::vector<float> values;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); t += 2) {
        cells.places.push_back({t, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
        cells.areas.push_back(mesh.area(t));
        values.push_back(static_cast<float>(position_of(mesh, cells.places.back()).x));
        cells.ends.push_back(0);
    }
    Team team(1);
    const CellFilter filter(mesh, cells, team);
    const PlaceValue sensed = of_cells(filter, values);
    const auto around = around_surface(mesh);
    for (const Vector3d point : {Vector3d{0.5, 0.1, 0}, Vector3d{-0.1, 0.3, 0.4}}) {
        const NearPlace near = found(*around, point);
        EXPECT_NEAR(sensed(near), near.position.x, 0.01);
    }
}

}  // namespace
}  // namespace cascade::test
