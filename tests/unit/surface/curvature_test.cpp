// Curvatures of surfaces for which there are formulas.
#include "core/hash.h"
#include "surface/curvature.h"
#include "surface/place_values.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace cascade::test {
namespace {

using std::numbers::pi;

bool is_finite(const PrincipalCurvatures& c) {
    double sum = 0;
    for (std::size_t p = 0; p < c.high.size(); ++p) {
        sum += c.high[p] + c.low[p] + length(c.high_direction[p]) + length(c.low_direction[p]);
    }
    return std::isfinite(sum);
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(Curvature, OfASphereIsOneOverItsRadius) {
    SurfaceMesh mesh = sphere(24);
    for (Vector3d& p : mesh.points) p = p * 5.0 + Vector3d{1, 2, 3};
    const PrincipalCurvatures curvature = principal_curvatures(mesh);
    const std::vector<Vector3d> normals = sphere_normals(mesh);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        EXPECT_LT(length(normals[p] - unit(mesh.points[p] - Vector3d{1, 2, 3})), 1e-12);
        EXPECT_NEAR(curvature.high[p], 0.2, 1e-9);
        EXPECT_NEAR(curvature.low[p], 0.2, 1e-9);
        EXPECT_NEAR(curvature.gaussian(p), 0.04, 1e-9);
    }
}

TEST(Curvature, OfACylinderIsAroundItAndNotAlong) {
    const SurfaceMesh mesh = cylinder(60, 20, 0.5, 2);
    const PrincipalCurvatures curvature = principal_curvatures(mesh);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        if (mesh.points[p].z < 0.15 || mesh.points[p].z > 1.85) continue;
        EXPECT_NEAR(curvature.high[p], 2, 0.01);
        EXPECT_NEAR(curvature.low[p], 0, 0.01);
        EXPECT_NEAR(std::abs(curvature.low_direction[p].z), 1, 1e-3);
        EXPECT_NEAR(curvature.high_direction[p].z, 0, 0.03);
    }
}

/// The largest errors of both principal curvatures on a torus of radii 2 and 1.
std::array<double, 2> torus_errors(int n) {
    const SurfaceMesh mesh = torus(2 * n, n, 2, 1);
    const PrincipalCurvatures curvature = principal_curvatures(mesh);
    std::array<double, 2> worst{};
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        const Vector3d& at = mesh.points[p];
        const double out = std::hypot(at.x, at.y);
        worst[0] = std::max(worst[0], std::abs(curvature.high[p] - 1));
        worst[1] = std::max(worst[1], std::abs(curvature.low[p] - (out - 2) / out));
        const Vector3d around = unit(Vector3d{-at.y, at.x, 0});
        EXPECT_NEAR(std::abs(dot(curvature.low_direction[p], around)), 1, 0.02);
    }
    return worst;
}

TEST(Curvature, OfATorusConverges) {
    const auto coarse = torus_errors(24), middle = torus_errors(48), fine = torus_errors(96);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LT(middle[k], coarse[k] / 3);
        EXPECT_LT(fine[k], middle[k] / 3);
        EXPECT_LT(fine[k], 0.01);
    }
}

TEST(Curvature, OfASaddleHasBothSigns) {
    const SurfaceMesh mesh = sheet(40, 40, [](double u, double v) {
        const double x = 2 * u - 1, y = 2 * v - 1;
        return Vector3d{x, y, (y * y - x * x) / 2};
    });
    const PrincipalCurvatures curvature = principal_curvatures(mesh);
    const auto middle = std::find(mesh.points.begin(), mesh.points.end(), Vector3d{0, 0, 0});
    ASSERT_NE(middle, mesh.points.end());
    const auto p = static_cast<std::size_t>(middle - mesh.points.begin());
    EXPECT_NEAR(curvature.high[p], 1, 0.01);
    EXPECT_NEAR(curvature.low[p], -1, 0.01);
    EXPECT_NEAR(curvature.mean(p), 0, 1e-9);
    EXPECT_NEAR(std::abs(curvature.high_direction[p].x), 1, 0.01);
}

TEST(Curvature, TurksRadiiAreThoseOfTheSphereAndTheCylinder) {
    SurfaceMesh ball = sphere(40);
    for (Vector3d& p : ball.points) p = p * 3.0;
    for (const double radius : turk_radii(ball)) EXPECT_NEAR(radius, 3, 0.01);

    const SurfaceMesh pipe = cylinder(60, 20, 0.5, 2);
    const std::vector<double> radii = turk_radii(pipe);
    for (std::size_t p = 0; p < radii.size(); ++p) {
        if (pipe.points[p].z < 0.15 || pipe.points[p].z > 1.85) continue;
        EXPECT_NEAR(radii[p], 0.5, 0.01);
    }
}

TEST(Curvature, TurksRadiiAreSmoothedAndBounded) {
    const double diagonal = std::sqrt(3.0);
    for (const double radius : turk_radii(box())) {
        EXPECT_GT(radius, 0.2);
        EXPECT_LE(radius, diagonal);
    }
    const SurfaceMesh flat = sheet(5, 5, [](double u, double v) { return Vector3d{u, v, 0}; });
    for (const double radius : turk_radii(flat)) EXPECT_DOUBLE_EQ(radius, std::sqrt(2.0));
    // A dent in a plane has curvature at its place, and each round of smoothing widens the curved
    // region.
    SurfaceMesh dented = sheet(20, 20, [](double u, double v) { return Vector3d{u, v, 0}; });
    const auto p = static_cast<std::size_t>(
        std::min_element(dented.points.begin(), dented.points.end(),
                         [](Vector3d a, Vector3d b) {
                             const Vector3d middle = {0.5, 0.5, 0};
                             return length(a - middle) < length(b - middle);
                         }) -
        dented.points.begin());
    dented.points[p].z = -0.05;
    const auto none = turk_radii(dented, 0), one = turk_radii(dented, 1),
               two = turk_radii(dented, 2);
    EXPECT_EQ(std::min_element(none.begin(), none.end()) - none.begin(),
              static_cast<std::ptrdiff_t>(p));
    const auto changed = [](const std::vector<double>& radii) {
        return std::count_if(radii.begin(), radii.end(), [](double r) { return r < 1.41; });
    };
    EXPECT_LT(changed(none), changed(one));
    EXPECT_LT(changed(one), changed(two));
}

TEST(Curvature, StaysFiniteOnBadMeshes) {
    SurfaceMesh noisy = sphere(20);
    for (std::uint32_t p = 0; p < noisy.points.size(); ++p) {
        const auto [x, y, z, w] = pcg4d({p, 1, 2, 3});
        noisy.points[p] =
            noisy.points[p] + Vector3d{x / 4294967296.0, y / 4294967296.0, z / 4294967296.0} * 0.5;
    }
    const SurfaceMesh thin = sheet(30, 4, [](double u, double v) {
        return Vector3d{std::pow(u, 9.0) + 50 * v, v, u * v};
    });
    SurfaceMesh needle = box();
    needle.points[3] = needle.points[2] + Vector3d{1e-14, 0, 0};
    SurfaceMesh folded = square();
    folded.points[2] = folded.points[0];
    SurfaceMesh point = box();
    for (Vector3d& p : point.points) p = {1, 1, 1};
    for (const SurfaceMesh& mesh : {noisy, thin, needle, folded, point}) {
        EXPECT_TRUE(is_finite(principal_curvatures(mesh)));
        EXPECT_TRUE(std::isfinite(sum_of(turk_radii(mesh))));
        for (const Vector3d& normal : sphere_normals(mesh)) EXPECT_NEAR(length(normal), 1, 1e-9);
    }
}

TEST(PlaceValues, AreLinearInATriangle) {
    SurfaceMesh mesh = square();
    std::vector<double> values;
    for (const Vector3d& p : mesh.points) values.push_back(2 * p.x - 3 * p.y + 1);
    const std::vector<SurfacePlace> places = scatter(mesh, 50, 1);
    const std::vector<double> found = values_at(mesh, values, places);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Vector3d p = position_of(mesh, places[k]);
        EXPECT_NEAR(found[k], 2 * p.x - 3 * p.y + 1, 1e-12);
    }
    EXPECT_FALSE(texture_place_at(mesh, places[0]));
    for (std::size_t t = 0; t < 2; ++t) {
        mesh.texture.push_back({});
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d p = mesh.corner(t, k);
            mesh.texture[t][k] = {static_cast<float>(p.y), static_cast<float>(1 - p.x)};
        }
    }
    for (const SurfacePlace& place : places) {
        const Vector3d p = position_of(mesh, place);
        const auto at = texture_place_at(mesh, place);
        ASSERT_TRUE(at);
        EXPECT_NEAR((*at)[0], p.y, 1e-7);
        EXPECT_NEAR((*at)[1], 1 - p.x, 1e-7);
    }
}

}  // namespace
}  // namespace cascade::test
