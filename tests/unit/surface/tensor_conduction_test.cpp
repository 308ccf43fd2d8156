// Weights of links for diffusion along a direction: linear functions, sums, waves, and the
// triangles between cells.
#include "surface/cell_gradient.h"
#include "surface/make_cells.h"
#include "surface/tensor_conduction.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace cascade::test {
namespace {

struct Case {
    SurfaceMesh mesh;
    SurfaceCells cells;
    bool are_spread = true;

    CellFrames frames() const { return cell_frames(mesh, cells); }
    Conduction conduction() const { return conduction_of(cells, are_spread, 1); }
    TensorConduction tensors(int threads = 2) const {
        Team team(threads);
        return {mesh, cells, frames(), conduction(), team, never};
    }
    std::size_t count() const { return cells.places.size(); }
    Vector3d place(std::size_t cell) const { return position_of(mesh, cells.places[cell]); }
};

SurfaceMesh flat_square() {
    return sheet(24, 24, [](double u, double v) { return Vector3d{u, v, 0}; });
}

std::vector<Case> cases_of(const SurfaceMesh& mesh) {
    return {{mesh, cells_of(mesh, 600), true},
            {mesh, vertex_cells(mesh), false},
            {mesh, face_cells(mesh), false}};
}

/// Σ_j weight_ij (f_j − f_i) for each cell.
std::vector<double> rates(const TensorConduction& tensors, const std::vector<double>& weights,
                          const std::vector<double>& f) {
    std::vector<double> sums(f.size(), 0);
    for (std::size_t cell = 0, link = 0; cell < f.size(); ++cell) {
        for (; link < tensors.ends()[cell]; ++link)
            sums[cell] += weights[link] * (f[tensors.links()[link].neighbour] - f[cell]);
    }
    return sums;
}

TEST(TensorConduction, LinearFunctionsStayOnFlatCells) {
    for (const Case& each : cases_of(flat_square())) {
        const TensorConduction tensors = each.tensors();
        const std::vector<double> weights =
            tensors.weights(std::vector<double>(each.count(), 0),
                            std::vector<Vector2d>(each.count(), {2, 0.5}));
        std::vector<double> linear, square;
        for (std::size_t k = 0; k < each.count(); ++k) {
            linear.push_back(3 * each.place(k).x - each.place(k).y);
            square.push_back(each.place(k).x * each.place(k).x);
        }
        const std::vector<double> still = rates(tensors, weights, linear),
                                  bent = rates(tensors, weights, square);
        const std::vector<double> areas = each.conduction().areas;
        double all = 0, area = 0;
        for (std::size_t k = 0; k < each.count(); ++k) {
            const Vector3d at = each.place(k);
            if (std::min({at.x, 1 - at.x, at.y, 1 - at.y}) < 0.15) continue;
            EXPECT_NEAR(still[k], 0, 1e-7) << k;
            all += areas[k] * bent[k];
            area += each.cells.areas[k];
        }
        // The second derivative of x² along v is 2 v_x² = 8. The positions of faces are so near
        // each other that diffusion along v is limited.
        const bool is_limited = each.count() == each.mesh.triangles.size();
        EXPECT_NEAR(all / area, 8, is_limited ? 0.4 : 0.05);
    }
}

TEST(TensorConduction, IsotropicWeightsAreThoseOfTheLaplacian) {
    const Case ball{sphere(12), cells_of(sphere(12), 400), true};
    const TensorConduction tensors = ball.tensors();
    const Conduction conduction = ball.conduction();
    const std::vector<double> weights = tensors.isotropic();
    for (std::size_t cell = 0, link = 0, edge = 0; cell < ball.count(); ++cell) {
        for (; link < tensors.ends()[cell]; ++link) {
            const bool is_diagonal = tensors.links()[link].length == 0;
            const double flow = is_diagonal ? 0 : conduction.flows[edge++];
            EXPECT_EQ(weights[link], flow / conduction.areas[cell]);
        }
    }
}

/// On any cells sums are conserved, and no wave grows, or decays faster than the bound says.
TEST(TensorConduction, KeepsSumsAndBoundsWaves) {
    std::mt19937 random(5);
    const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    std::vector<Case> all = cases_of(sphere(9));
    for (const Case& each : cases_of(flat_square())) all.push_back(each);
    for (const Case& each : all) {
        const TensorConduction tensors = each.tensors();
        const std::vector<double> areas = each.conduction().areas;
        double most = 0;
        const std::vector<double> isotropic = tensors.isotropic();
        for (std::size_t cell = 0, link = 0; cell < each.count(); ++cell) {
            double sum = 0;
            for (; link < tensors.ends()[cell]; ++link) sum += isotropic[link];
            most = std::max(most, sum);
        }
        std::vector<double> low, f;
        std::vector<Vector2d> along;
        for (std::size_t k = 0; k < each.count(); ++k) {
            const double angle = 4 * number(), rate = std::abs(number());
            low.push_back(1 - rate);
            along.push_back(Vector2d{std::cos(angle), std::sin(angle)} * std::sqrt(rate));
        }
        const std::vector<double> weights = tensors.weights(low, along);
        for (std::size_t k = 0; k < each.count(); ++k) f.push_back(number());
        // Repeated multiplication gives the wave that decays fastest.
        for (int round = 0; round < 60; ++round) {
            const std::vector<double> change = rates(tensors, weights, f);
            double sum = 0, size = 0, squares = 0, product = 0;
            for (std::size_t k = 0; k < f.size(); ++k) {
                sum += areas[k] * change[k];
                size += areas[k] * std::abs(change[k]);
                squares += areas[k] * f[k] * f[k];
                product += areas[k] * f[k] * change[k];
            }
            ASSERT_NEAR(sum, 0, 1e-10 * size);
            ASSERT_LE(product, 0);
            ASSERT_GE(product, -2 * most * squares);
            f = change;
            const double largest = std::abs(*std::max_element(
                f.begin(), f.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
            for (double& value : f) value /= largest;
        }
    }
}

TEST(TensorConduction, PolygonsBetweenFacesAreCutAndHolesAreNot) {
    const SurfaceMesh ball = sphere(8), square = flat_square();
    for (const SurfaceMesh* mesh : {&ball, &square}) {
        const Case faces{*mesh, face_cells(*mesh), false};
        Team team(2);
        const std::vector<Vector3d> unfolded = unfolded_neighbours(*mesh, faces.cells, team, never);
        const CellTriangles found = triangles_between(*mesh, faces.cells, faces.frames(), unfolded);
        // A point inside the surface with n faces gives n − 2 triangles.
        std::size_t expected = 0;
        std::vector<std::size_t> around(mesh->points.size(), 0);
        std::vector<bool> is_inside(mesh->points.size(), true);
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                ++around[mesh->triangles[t][k]];
                if (mesh->across[t][k].exists()) continue;
                is_inside[mesh->triangles[t][k]] = false;
                is_inside[mesh->triangles[t][corner_after(k)]] = false;
            }
        }
        for (std::size_t point = 0; point < around.size(); ++point) {
            if (is_inside[point] && around[point] > 2) expected += around[point] - 2;
        }
        EXPECT_EQ(found.triangles.size(), expected);
        EXPECT_FALSE(found.diagonals.empty());
    }
}

TEST(TensorConduction, DependsOnNoThreads) {
    const SurfaceMesh mesh = sphere(9);
    const Case each{mesh, cells_of(mesh, 300), true};
    const std::vector<double> low(each.count(), 0.5);
    const std::vector<Vector2d> along(each.count(), {0.3, -1});
    EXPECT_EQ(each.tensors(1).weights(low, along), each.tensors(5).weights(low, along));
}

}  // namespace
}  // namespace cascade::test
