// Half-edges represent a surface, and remain a manifold during edits.
#include "mesh/half_edges.h"

#include "core/hash.h"
#include "mesh/collapse_edges.h"
#include "mesh/edge_pairs.h"
#include "unit/mesh/measures.h"
#include "unit/mesh/meshes.h"

#include <OpenMesh/Tools/Utils/MeshCheckerT.hh>

#include <gtest/gtest.h>

#include <sstream>

namespace cascade {
namespace {

/// Faults that OpenMesh's own check finds.
std::string faults_of(const HalfEdges& mesh) {
    std::ostringstream faults;
    OpenMesh::Utils::MeshCheckerT<HalfEdges>(mesh).check(
        OpenMesh::Utils::MeshCheckerT<HalfEdges>::CHECK_ALL, faults);
    return faults.str();
}

void expect_round_trip(const SurfaceMesh& mesh) {
    const auto made = half_edges(mesh);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(faults_of(*made), "");
    const SurfaceMesh again = surface_mesh(*made);
    EXPECT_EQ(again.points, mesh.points);
    EXPECT_EQ(again.triangles, mesh.triangles);
    EXPECT_EQ(again.across, mesh.across);
}

/// Two triangles over the same three points, back to back.
SurfaceMesh pillow() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 2}}); }

/// A closed surface cut open along the edge from 0 to 1, with a hole of two edges.
SurfaceMesh two_edges_between_two_points() {
    SurfaceMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}};
    mesh.across = pair_edges(mesh.points, mesh.triangles).across;
    mesh.across[0][0] = mesh.across[1][0] = {};
    return mesh;
}

TEST(HalfEdges, ASurfaceGoesThereAndBack) {
    for (const SurfaceMesh& mesh : {test::box(), test::square(), test::sphere(6), pillow(),
                                    two_edges_between_two_points(), SurfaceMesh{}}) {
        expect_round_trip(mesh);
    }
}

TEST(HalfEdges, TwoEdgesBetweenTwoPointsStayTwo) {
    const SurfaceMesh mesh = two_edges_between_two_points();
    ASSERT_EQ(facts_of(mesh).boundaries, 1u);
    ASSERT_EQ(facts_of(mesh).boundary_edges, 2u);
    const auto made = half_edges(mesh);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->n_edges(), facts_of(mesh).edges);
    // OpenMesh's add_face() would merge the two edges and lose the hole.
    HalfEdges added;
    for (const Vector3d& p : mesh.points) added.add_vertex({p.x, p.y, p.z});
    for (const auto& [a, b, c] : mesh.triangles) added.add_face(vertex(a), vertex(b), vertex(c));
    EXPECT_EQ(added.n_edges(), made->n_edges() - 1);
}

TEST(HalfEdges, RefusesWhatIsNoSurface) {
    const auto message = [](const SurfaceMesh& mesh) {
        const auto made = half_edges(mesh);
        return made ? std::string("none") : made.error().message;
    };
    SurfaceMesh twice = test::square();
    twice.triangles[0][0] = twice.triangles[0][1];
    EXPECT_EQ(message(twice), "triangle 0 of the surface has a corner twice");

    // Two triangles that share only a point, and two tetrahedra.
    const SurfaceMesh bow =
        mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
    EXPECT_EQ(message(bow), "the triangles around point 0 of the surface are not one fan");
    const SurfaceMesh hourglass = mesh_of(
        {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {-1, -1, -1}, {0, 1, -1}},
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {6, 5, 4}});
    EXPECT_EQ(message(hourglass), "the triangles around point 0 of the surface are not one fan");

    SurfaceMesh turned = test::square();
    std::swap(turned.triangles[1][0], turned.triangles[1][1]);
    EXPECT_EQ(message(turned),
              "edge 2 of triangle 0 of the surface does not match the triangle across it");
    SurfaceMesh one_way = test::square();
    one_way.across[1] = {};
    EXPECT_EQ(message(one_way),
              "edge 2 of triangle 0 of the surface does not match the triangle across it");
    SurfaceMesh outside = test::square();
    outside.points.pop_back();
    EXPECT_EQ(message(outside),
              "edge 2 of triangle 1 of the surface does not match the triangle across it");
    SurfaceMesh unlinked = test::square();
    unlinked.across.clear();
    EXPECT_EQ(message(unlinked), "the surface has triangles whose neighbours are not known");
}

TEST(HalfEdges, VerticesMayComeInAnotherOrder) {
    const auto made = half_edges(test::box());
    ASSERT_TRUE(made);
    const std::vector<std::uint32_t> order = {7, 6, 5, 4, 3, 2, 1, 0};
    const SurfaceMesh mesh = surface_mesh(*made, order);
    test::expect_closed(mesh);
    for (std::uint32_t p = 0; p < 8; ++p) EXPECT_EQ(mesh.points[p], test::box().points[7 - p]);
}

TEST(HalfEdges, OneRingsGoCounterclockwise) {
    const SurfaceMesh mesh = test::sphere(4);
    const auto made = half_edges(mesh);
    std::vector<HalfedgeHandle> spokes;
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
        outgoing(*made, vertex(p), spokes);
        EXPECT_EQ(spokes.size(), made->valence(vertex(p)));
        for (std::size_t k = 0; k < spokes.size(); ++k) {
            const auto to = [&](std::size_t j) {
                return position(*made, made->to_vertex_handle(spokes[j % spokes.size()])) -
                       mesh.points[p];
            };
            EXPECT_GT(dot(cross(to(k), to(k + 1)), mesh.points[p]), 0);
        }
    }
    const auto open = half_edges(test::square());
    for (std::uint32_t p = 0; p < 4; ++p) {
        outgoing(*open, vertex(p), spokes);
        EXPECT_FALSE(open->is_boundary(spokes.front()));
        EXPECT_TRUE(open->is_boundary(spokes.back()));
        EXPECT_EQ(spokes.size(), open->valence(vertex(p)));
    }
    EXPECT_TRUE(are_neighbours(*open, vertex(0), vertex(2)) !=
                are_neighbours(*open, vertex(1), vertex(3)));
}

/// Flips, splits and collapses edges chosen by a hash, if OpenMesh allows it.
void edit(HalfEdges& mesh, std::uint32_t seed, int edits) {
    for (int k = 0; k < edits; ++k) {
        const auto random = pcg4d({seed, static_cast<std::uint32_t>(k), 0, 0});
        const EdgeHandle e(static_cast<int>(random[0] % mesh.n_edges()));
        if (mesh.status(e).deleted()) continue;
        const HalfedgeHandle h = mesh.halfedge_handle(e, random[1] % 2);
        switch (random[2] % 4) {
            case 0:
                if (mesh.is_flip_ok(e)) mesh.flip(e);
                break;
            case 1: mesh.split(e, mesh.calc_edge_midpoint(e)); break;
            case 2:
                if (!mesh.is_boundary(h)) {
                    const FaceHandle f = mesh.face_handle(h);
                    mesh.split(f, mesh.calc_face_centroid(f));
                }
                break;
            default:
                // OpenMesh's test would allow collapsing a tetrahedron to nothing.
                if (mesh.is_collapse_ok(h) && mesh.n_faces() > 20) mesh.collapse(h);
        }
    }
}

TEST(HalfEdges, EditsKeepTheTopology) {
    for (const SurfaceMesh& mesh : {test::sphere(4), test::box(), test::square()}) {
        const MeshFacts before = facts_of(mesh);
        for (std::uint32_t seed = 0; seed < 30; ++seed) {
            auto made = half_edges(mesh);
            edit(*made, seed, 400);
            ASSERT_EQ(faults_of(*made), "") << seed;
            const SurfaceMesh after = surface_mesh(*made);
            test::expect_manifold(after);
            EXPECT_EQ(facts_of(after).euler_characteristic, before.euler_characteristic) << seed;
            EXPECT_EQ(facts_of(after).boundaries, before.boundaries) << seed;
            EXPECT_EQ(facts_of(after).components, before.components) << seed;
            expect_round_trip(after);
        }
    }
}

TEST(CollapseEdges, ShortEdgesGoAndTheFormStays) {
    const SurfaceMesh mesh = test::sphere(24);
    auto made = half_edges(mesh);
    collapse_edges(*made, 0.1, 0.25);
    EXPECT_EQ(faults_of(*made), "");
    const SurfaceMesh after = surface_mesh(*made);
    test::expect_closed(after);
    EXPECT_EQ(facts_of(after).euler_characteristic, 2);
    EXPECT_LT(after.points.size(), mesh.points.size() / 2);
    EXPECT_NEAR(after.total_area() / mesh.total_area(), 1, 0.02);
    for (std::size_t t = 0; t < after.triangles.size(); ++t) {
        EXPECT_GT(dot(after.double_area_normal(t), after.corner(t, 0)), 0);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_LE(length(after.corner(t, (k + 1) % 3) - after.corner(t, k)), 0.25);
        }
    }
}

}  // namespace
}  // namespace cascade
