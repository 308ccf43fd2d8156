// Surfaces as meshes for pages: what each vertex shows of the cells.
#include "run/pictures/shown_surface.h"

#include "run/session/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <tuple>

namespace cascade {
namespace {

/// The surface of a script whose values are those of `u`.
std::shared_ptr<const Snapshot> shown_by(const std::string& domain, const std::string& u = "x") {
    SimulationOptions options;
    options.backend = "interp";
    options.threads = 1;
    RunControl control;
    const std::string text = "domain { " + domain + " }\nsystem s { u: " + u +
                             "; u' = 0 }\nstage one: s { iterations: 9 }\n";
    auto session = Session::begin(load_script("s.cascade", text, "."), options, control);
    EXPECT_TRUE(session.has_value()) << session.error().messages(false);
    return session ? (*session)->newest() : nullptr;
}

ShownSurface mesh_of(const Snapshot& snapshot) {
    Team team(2);
    return shown_surface(*snapshot.surface, team);
}

/// The value that a vertex shows.
double value_at(const ShownSurface& mesh, std::size_t vertex, const Snapshot& snapshot) {
    const PlaneLayout& layout = snapshot.fields[0].layout();
    double sum = 0;
    for (std::size_t k = vertex == 0 ? 0 : mesh.ends[vertex - 1]; k < mesh.ends[vertex]; ++k) {
        const auto cell = static_cast<std::int64_t>(mesh.shares[k].cell);
        sum += static_cast<double>(mesh.shares[k].weight) *
               snapshot.fields[0].number_at(cell % layout.width, cell / layout.width);
    }
    return sum;
}

void expect_sound(const ShownSurface& mesh) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.ends.size(), mesh.positions.size());
    ASSERT_EQ(mesh.ends.back(), mesh.shares.size());
    for (std::size_t v = 0; v < mesh.ends.size(); ++v) {
        double whole = 0;
        for (std::size_t k = v == 0 ? 0 : mesh.ends[v - 1]; k < mesh.ends[v]; ++k) {
            whole += static_cast<double>(mesh.shares[k].weight);
        }
        EXPECT_NEAR(whole, 1, 1e-5);
        EXPECT_NEAR(length(mesh.normals[v]), 1, 1e-5);
    }
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.positions.size());
    }
}

TEST(ShownSurface, VerticesOfAModelShowTheCellsAroundThem) {
    const auto snapshot = shown_by("surface: torus(1, 0.4); cells: 1500");
    const ShownSurface mesh = mesh_of(*snapshot);
    expect_sound(mesh);
    EXPECT_EQ(mesh.up, Axis::y);
    EXPECT_TRUE(mesh.places.empty());
    EXPECT_GT(mesh.positions.size(), 1500U);
    // Scripts and meshes use the same coordinates, so u = x shows the x of each vertex up to the
    // width of the filter.
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        EXPECT_NEAR(value_at(mesh, v, *snapshot), mesh.positions[v].x, mesh.spacing);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        EXPECT_LT(length(mesh.positions[a] - mesh.positions[b]), mesh.spacing);
    }
}

TEST(ShownSurface, CreasesStaySharp) {
    const ShownSurface mesh = mesh_of(*shown_by("surface: box; cells: 600"));
    expect_sound(mesh);
    std::set<std::tuple<float, float, float>> places;
    for (const Vector3& p : mesh.positions) places.insert({p.x, p.y, p.z});
    EXPECT_LT(places.size(), mesh.positions.size());
    for (const Vector3& n : mesh.normals) {
        EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6);
    }
}

TEST(ShownSurface, VerticesOfAFunctionLieInCellsAndBetweenThem) {
    const std::string tube =
        "grid: 96, 80; boundary: periodic, noflux; surface: cos(2*pi*sx), "
        "sin(2*pi*sx), 3 * sy";
    const auto snapshot = shown_by(tube, "y");
    const ShownSurface mesh = mesh_of(*snapshot);
    expect_sound(mesh);
    EXPECT_EQ(mesh.up, Axis::z);
    ASSERT_EQ(mesh.places.size(), mesh.positions.size());
    ASSERT_EQ(mesh.positions.size(), 193U * 161U);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        // Between the centres of the outermost cells and the sides, values are constant.
        const double y = std::clamp(static_cast<double>(mesh.places[v][1]), 0.5 / 96, 79.5 / 96);
        EXPECT_NEAR(value_at(mesh, v, *snapshot), y, 1e-6);
    }
    EXPECT_EQ(mesh.ends[193 + 1] - mesh.ends[193], 1U) << "a vertex in the middle of a cell";
}

TEST(ShownSurface, ABodyLiesFlatAsItsCellsDo) {
    const std::string text =
        "domain { grid: 16, 16, 16; boundary: noflux }\n"
        "system ball { u: 0.3 - sqrt((x - 0.5)^2 + (y - 0.4)^2 + (z - 0.6)^2); u' = 0 }\n"
        "cells still { p' = 0 * p }\n"
        "stage one: ball { iterations: 9 }\n"
        "stage two: still { body: one.u; founders: 20; r: 0.01; duration: 1 }\n"
        "picture { width: 0.02 }\n";
    SimulationOptions options;
    options.backend = "interp";
    options.threads = 1;
    RunControl control;
    auto session = Session::begin(load_script("s.cascade", text, "."), options, control);
    ASSERT_TRUE(session.has_value()) << session.error().messages(false);
    auto snapshot = (*session)->newest();
    EXPECT_EQ(snapshot->surface, nullptr) << "a volume has none";
    (*session)->post(TakeSteps{10}, [](const Accepted<void>&) {});
    for (int k = 0; k < 300 && !snapshot->cells; ++k) {
        if (auto newer = (*session)->newer_than(snapshot->number, std::chrono::milliseconds(100))) {
            snapshot = newer;
        }
    }
    ASSERT_TRUE(snapshot->cells);
    ASSERT_TRUE(snapshot->surface);
    EXPECT_GT(snapshot->surface_number, 0U);
    const ShownSurface mesh = mesh_of(*snapshot);
    EXPECT_EQ(mesh.up, Axis::y);
    EXPECT_EQ(mesh.ends.size(), mesh.positions.size());
    EXPECT_TRUE(mesh.shares.empty());
    const Vector3 middle{0.5F, 0.6F, 0.4F};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vector3 outward = mesh.positions[v] - middle;
        EXPECT_NEAR(length(outward), 0.3, 0.01);
        EXPECT_GT(dot(outward, mesh.normals[v]), 0.25F);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vector3 across =
            cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        EXPECT_GE(dot(across, mesh.positions[a] - middle), 0) << "it is seen from outside";
    }
    ASSERT_EQ(snapshot->cells->placements.size(), 20U);
    EXPECT_TRUE(snapshot->cells->is_on_body);
    for (const Placement& each : snapshot->cells->placements) {
        EXPECT_NEAR(length(each.place - Vector3d{0.5, 0.6, 0.4}), 0.3, 0.01);
    }
}

TEST(ShownSurface, IsTheSameWhileThePlacesAre) {
    const std::string tube = "grid: 8, 8; surface: cos(2*pi*sx), sin(2*pi*sx), 3 * sy";
    const auto one = shown_by(tube)->surface, same = shown_by(tube, "y")->surface;
    EXPECT_TRUE(one->is_same_as(*same));
    EXPECT_FALSE(one->is_same_as(*shown_by(tube + " / 2")->surface));
    EXPECT_FALSE(one->is_same_as(*shown_by("surface: sphere; cells: 99")->surface));
    EXPECT_EQ(shown_by("grid: 8, 8")->surface, nullptr);
    EXPECT_EQ(shown_by("grid: 8, 8")->surface_number, 0U);
    EXPECT_EQ(shown_by(tube)->surface_number, 1U);
}

}  // namespace
}  // namespace cascade
