// The tips of a ball with horns, and of a ball without.
#include "core/run_control.h"
#include "mesh/shapes.h"
#include "surface/tips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade {
namespace {

TEST(Tips, AreTheEndsOfHorns) {
    const std::array<Vector3d, 4> horns{unit(Vector3d{1, 1, 1}), unit(Vector3d{1, -1, -1}),
                                        unit(Vector3d{-1, 1, -1}), unit(Vector3d{-1, -1, 1})};
    SurfaceMesh mesh = sphere_mesh(1, 0.08).value();
    for (Vector3d& point : mesh.points) {
        double longer = 0;
        for (const Vector3d& horn : horns) {
            longer += 1.5 * std::exp(-20 * (1 - dot(unit(point), horn)));
        }
        point = point * (1 + longer);
    }
    const std::vector<Vector3d> tips = tips_of(mesh, never_cancelled);
    ASSERT_EQ(tips.size(), horns.size());
    for (const Vector3d& horn : horns) {
        EXPECT_TRUE(std::ranges::any_of(tips, [&](const Vector3d& tip) {
            return length(tip - horn * 2.5) < 0.15;
        }));
    }
}

TEST(Tips, ABallHasNone) {
    EXPECT_TRUE(tips_of(sphere_mesh(1, 0.1).value(), never_cancelled).empty());
}

}  // namespace
}  // namespace cascade
