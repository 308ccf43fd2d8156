// Directions that cells comb on closed surfaces: the sum of the indices of their singular places is
// the one that topology demands, and combing leaves few other singular places.
#include "run/pictures/drawn_cells.h"
#include "started_script.h"

#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace cascade {
namespace {

using test::start;

/// A direction at each point of a mesh: the tangential part of the sum of all cells' directions,
/// weighted by nearness.
std::vector<Vector3d> directions_at(const std::vector<Vector3d>& points,
                                    const std::vector<Vector3d>& normals,
                                    const PlacedFrames& cells) {
    std::vector<Vector3d> directions;
    for (std::size_t k = 0; k < points.size(); ++k) {
        Vector3d sum;
        for (std::size_t cell = 0; cell < cells.places.size(); ++cell) {
            const Vector3d way = cells.places[cell] - points[k];
            const double width = 1.5 * cells.radii[cell];
            const double weight = std::exp(-dot(way, way) / (width * width));
            sum = sum + turned(cells.turns[cell], {0, 0, 1}) * weight;
        }
        directions.push_back(sum - normals[k] * dot(sum, normals[k]));
    }
    return directions;
}

/// A tangent vector carried from a place with the normal `from` to one with the normal `to`, by the
/// rotation that takes one normal to the other.
Vector3d carried(const Vector3d& v, const Vector3d& from, const Vector3d& to) {
    return v - (from + to) * (dot(v, to) / (1 + dot(from, to)));
}

/// The angle from a to b about an axis, in −π … π.
double angle(const Vector3d& a, const Vector3d& b, const Vector3d& axis) {
    return std::atan2(dot(axis, cross(a, b)), dot(a, b));
}

struct Singularities {
    int sum = 0;    ///< The sum of all indices.
    int count = 0;  ///< The number of triangles with an index.
};

/// Finds the triangles with a singular place. Along the border of a triangle, the field turns by 2π
/// times the index of the singular place inside, and by a small angle that comes from the curvature
/// of the surface.
Singularities singularities(const SurfaceMesh& mesh, const std::vector<Vector3d>& normals,
                            const std::vector<Vector3d>& directions) {
    Singularities result;
    for (const auto& corners : mesh.triangles) {
        double angles = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
            angles +=
                angle(carried(directions[a], normals[a], normals[b]), directions[b], normals[b]);
        }
        const int index = static_cast<int>(std::lround(angles / (2 * std::numbers::pi)));
        result.sum += index;
        result.count += index == 0 ? 0 : 1;
    }
    return result;
}

class Combing : public ::testing::Test {
protected:
    /// The singular places of the directions of a stage's cells at its end.
    Singularities after(const std::string& text) {
        Script script = load_script("test.cascade", text, ".");
        const auto simulation = start(script);
        if (!simulation) return {};
        EXPECT_TRUE(simulation->advance_stage(0, 1'000'000, control_, {}));
        const PlacedFrames cells = frames_of(*simulation, 0);
        EXPECT_GT(cells.places.size(), 100U);
        const SurfaceMesh& mesh = simulation->domain().model->cells->mesh;
        const ModelBox box(mesh);
        std::vector<Vector3d> points;
        for (const Vector3d& point : mesh.points) points.push_back(box.in_script(point));
        const std::vector<Vector3d> normals = point_normals(mesh);
        return singularities(mesh, normals, directions_at(points, normals, cells));
    }

private:
    RunControl control_;
};

TEST_F(Combing, LeavesIndicesOfTwoOnASphere) {
    const Singularities found = after(
        "domain { surface: sphere; cells: 400 }\n"
        "stage cover: scales { founders: 2; r: 0.07; duration: 30 }\n");
    EXPECT_EQ(found.sum, 2);
    EXPECT_GE(found.count, 2);
    EXPECT_LE(found.count, 4);
}

TEST_F(Combing, LeavesNothingSingularOnATorus) {
    const Singularities found = after(
        "domain { surface: torus(1, 0.5); cells: 400 }\n"
        "stage cover: scales { founders: 1; r: 0.05; duration: 30 }\n");
    EXPECT_EQ(found.sum, 0);
    EXPECT_LE(found.count, 2);
}

TEST_F(Combing, IsWhatLeavesFew) {
    const Singularities found = after(
        "cells uncombed: on_surface, solid, upright, covering { r: 0.07 }\n"
        "domain { surface: sphere; cells: 400 }\n"
        "stage cover: uncombed { founders: 150; duration: 2 }\n");
    EXPECT_EQ(found.sum, 2);
    EXPECT_GT(found.count, 10);
}

}  // namespace
}  // namespace cascade
