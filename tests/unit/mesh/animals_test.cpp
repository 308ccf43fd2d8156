// Animals are single closed bodies, thick enough for cells, that stand on the ground.
#include "mesh/animals.h"
#include "mesh/disjoint_sets.h"
#include "mesh/normals.h"

#include "tests/support/never.h"
#include "unit/mesh/measures.h"

#include <set>

namespace cascade {
namespace {

using test::never;

struct Case {
    std::string name;
    Animal animal;
    Vector3d size;  ///< The size of the bounding box.
    std::size_t feet;
};

std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.name; }

class Animals : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(All, Animals,
                         testing::Values(Case{"creature", creature(), {0.56, 1.5, 1.75}, 4},
                                         Case{"leopard", leopard(), {0.36, 0.81, 2.0}, 4},
                                         Case{"giraffe", giraffe(), {1.0, 4.8, 3.25}, 4},
                                         Case{"zebra", zebra(), {0.70, 1.9, 2.4}, 4},
                                         Case{"fish", fish(), {0.168, 0.21, 0.43}, 2},
                                         Case{"frog", frog(), {0.15, 0.06, 0.104}, 4}),
                         [](const auto& one) { return one.param.name; });

/// The number of connected pieces of the surface below a height. Only pieces that reach the ground
/// count.
std::size_t parts_below(const SurfaceMesh& mesh, double height) {
    DisjointSets sets(mesh.points.size());
    std::set<std::uint32_t> parts;
    const auto is_low = [&](std::uint32_t k) { return mesh.points[k].y < height; };
    for (const auto& [a, b, c] : mesh.triangles) {
        if (!is_low(a) || !is_low(b) || !is_low(c)) continue;
        sets.join(a, b);
        sets.join(b, c);
    }
    for (const auto& corners : mesh.triangles) {
        if (std::all_of(corners.begin(), corners.end(), is_low))
            parts.insert(sets.find(corners[0]));
    }
    return parts.size();
}

/// How far the lowest point of the mesh is above the ground.
double height_above_ground(const Animal& animal, const SurfaceMesh& mesh) {
    const Vector3d foot =
        *std::min_element(mesh.points.begin(), mesh.points.end(),
                          [](const Vector3d& a, const Vector3d& b) { return a.y < b.y; });
    double y = -1;
    while (animal.body({foot.x, y, foot.z}) <= 0) y += 0.01 * animal.edge;
    return -y;
}

void expect_thicker(const Animal& animal, const SurfaceMesh& mesh, double thickness) {
    const std::vector<Vector3d> normals = point_normals(mesh);
    const Vector3d raised{0, height_above_ground(animal, mesh), 0};
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
        const Vector3d inside = mesh.points[k] - raised - normals[k] * thickness;
        EXPECT_GT(animal.body(inside), 0) << inside.x << " " << inside.y << " " << inside.z;
    }
}

TEST_P(Animals, AreOneSmoothPieceAtAllResolutions) {
    const auto& [name, animal, size, feet] = GetParam();
    for (const double edge : {1.3 * animal.edge, animal.edge}) {
        const auto made = animal.body.mesh(edge, never);
        ASSERT_TRUE(made) << made.error().message;
        test::expect_closed(*made);
        const MeshFacts facts = facts_of(*made);
        EXPECT_EQ(facts.components, 1u);
        EXPECT_EQ(facts.euler_characteristic, 2) << "limbs have grown together, or torn";
        EXPECT_GT(test::smallest_angle(*made), 10);
        EXPECT_EQ(facts.low.y, 0) << "it stands on the ground";
        EXPECT_EQ(parts_below(*made, 0.05 * size.y), feet);
        EXPECT_NEAR(facts.high.x - facts.low.x, size.x, 0.03 * size.x);
        EXPECT_NEAR(facts.high.y - facts.low.y, size.y, 0.03 * size.y);
        EXPECT_NEAR(facts.high.z - facts.low.z, size.z, 0.03 * size.z);
        EXPECT_NEAR(facts.low.x, -facts.high.x, 0.03 * size.x) << "x is from side to side";
        expect_thicker(animal, *made, 1.5 * animal.edge);
    }
}

TEST_P(Animals, HaveNothingFarAway) { EXPECT_EQ(GetParam().animal.body({1e6, 1e6, -1e6}), -1); }

}  // namespace
}  // namespace cascade
