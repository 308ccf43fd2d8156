// Values that are shown between the places of cells.
#include "core/hash.h"
#include "surface/cell_filter.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cascade::test {
namespace {

CellFilter filter_of(const SurfaceMesh& mesh, const SurfaceCells& cells, int threads = 2) {
    Team team(threads);
    return CellFilter(mesh, cells, team);
}

float filtered(const CellFilter& filter, const std::vector<float>& values,
               const SurfacePlace& place) {
    std::vector<CellShare> shares;
    filter.shares(place, shares);
    float sum = 0;
    for (const CellShare& share : shares) sum += share.weight * values[share.cell];
    return sum;
}

template <typename Function>
std::vector<float> values_of(const SurfaceMesh& mesh, const SurfaceCells& cells,
                             Function function) {
    std::vector<float> values;
    for (const SurfacePlace& place : cells.places) {
        values.push_back(static_cast<float>(function(position_of(mesh, place))));
    }
    return values;
}

/// Random values, each −1 or 1, which are as rough as values can be.
std::vector<float> random_signs(std::size_t count) {
    std::vector<float> values;
    for (std::uint32_t k = 0; k < count; ++k)
        values.push_back(pcg4d({k, 0, 0, 0})[0] & 1 ? 1.0F : -1.0F);
    return values;
}

/// A box 1 × 1 × thickness, each of its two large sides cut into 2 n² triangles.
SurfaceMesh leaf(double thickness, int n) {
    PolygonSoup soup;
    const auto add = [&](std::initializer_list<Vector3d> points) {
        for (const Vector3d& p : points) {
            soup.corners.push_back(static_cast<std::uint32_t>(soup.points.size()));
            soup.points.push_back(p);
        }
        soup.ends.push_back(soup.corners.size());
    };
    for (int i = 0; i < n; ++i) {
        const double a = static_cast<double>(i) / n, b = (i + 1.0) / n;
        for (int j = 0; j < n; ++j) {
            const double c = static_cast<double>(j) / n, d = (j + 1.0) / n;
            add({{a, c, thickness}, {b, c, thickness}, {b, d, thickness}, {a, d, thickness}});
            add({{a, c, 0}, {a, d, 0}, {b, d, 0}, {b, c, 0}});
        }
        if (thickness == 0) continue;
        add({{a, 0, 0}, {b, 0, 0}, {b, 0, thickness}, {a, 0, thickness}});
        add({{b, 1, 0}, {a, 1, 0}, {a, 1, thickness}, {b, 1, thickness}});
        add({{0, b, 0}, {0, a, 0}, {0, a, thickness}, {0, b, thickness}});
        add({{1, a, 0}, {1, b, 0}, {1, b, thickness}, {1, a, thickness}});
    }
    return make_mesh(std::move(soup))->mesh;
}

TEST(CellFilter, SharesAreAnAverageOfADozen) {
    for (const SurfaceMesh& mesh : {square(), box(), sphere(3), sphere(40)}) {
        const SurfaceCells cells = cells_of(mesh, 900);
        const CellFilter filter = filter_of(mesh, cells);
        std::vector<CellShare> shares;
        std::size_t count = 0;
        const std::vector<SurfacePlace> places = scatter(mesh, 2000, 5);
        for (const SurfacePlace& place : places) {
            filter.shares(place, shares);
            ASSERT_FALSE(shares.empty());
            double sum = 0;
            for (std::size_t k = 0; k < shares.size(); ++k) {
                EXPECT_GE(shares[k].weight, 0);
                EXPECT_TRUE(k == 0 || shares[k - 1].cell < shares[k].cell);
                sum += shares[k].weight;
                const double apart = length(position_of(mesh, cells.places[shares[k].cell]) -
                                            position_of(mesh, place));
                EXPECT_LE(apart, filter.radius() * (1 + 1e-6));
            }
            EXPECT_NEAR(sum, 1, 1e-6);
            count += shares.size();
        }
        EXPECT_NEAR(static_cast<double>(count) / 2000, 12, 1.5);
    }
}

TEST(CellFilter, LinearFunctionsStay) {
    const SurfaceMesh flat = square();
    const SurfaceCells cells = cells_of(flat, 2000);
    const CellFilter filter = filter_of(flat, cells);
    const auto slope = [](Vector3d p) { return 3 * p.x - 4 * p.y; };
    const std::vector<float> values = values_of(flat, cells, slope);
    const double spacing = filter.radius() / 2;
    double squares = 0, count = 0;
    for (const SurfacePlace& place : scatter(flat, 3000, 5)) {
        const Vector3d p = position_of(flat, place);
        if (std::min({p.x, p.y, 1 - p.x, 1 - p.y}) < filter.radius()) continue;
        const double error = filtered(filter, values, place) - slope(p);
        EXPECT_LT(std::abs(error), 5 * 0.2 * spacing);
        squares += error * error;
        ++count;
    }
    EXPECT_GT(count, 2000);
    EXPECT_LT(std::sqrt(squares / count), 5 * 0.04 * spacing);
}

/// The largest difference between the values that the two triangles at an edge show there.
double largest_jump(const SurfaceMesh& mesh, std::size_t count, const std::vector<float>& values) {
    const SurfaceCells cells = cells_of(mesh, count);
    const CellFilter filter = filter_of(mesh, cells);
    double largest = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists() || other.triangle < t) continue;
            const double along = length(mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k));
            const int steps = 2 + static_cast<int>(10 * along / filter.radius());
            for (int step = 0; step <= steps; ++step) {
                const double part = static_cast<double>(step) / steps;
                SurfacePlace here{t, {0, 0, 0}}, there{other.triangle, {0, 0, 0}};
                here.weights[k] = there.weights[(other.edge + 1) % 3] = 1 - part;
                here.weights[(k + 1) % 3] = there.weights[other.edge] = part;
                largest = std::max<double>(largest, std::abs(filtered(filter, values, here) -
                                                             filtered(filter, values, there)));
            }
        }
    }
    return largest;
}

TEST(CellFilter, NothingJumpsAtEdges) {
    const std::vector<float> values = random_signs(40'000);
    EXPECT_LT(largest_jump(square(), 1000, values), 1e-4);
    EXPECT_LT(largest_jump(sphere(40), 300, values), 0.05);
    EXPECT_LT(largest_jump(sphere(10), 1000, values), 0.05);
    EXPECT_LT(largest_jump(sphere(2), 5000, values), 0.05);
    EXPECT_LT(largest_jump(box(), 300, values), 0.05);
    EXPECT_LT(largest_jump(box(), 40'000, values), 0.05);
    EXPECT_LT(largest_jump(leaf(0.3, 8), 400, values), 0.05);
    // A ball that is so crumpled that a strip of its triangles, unfolded into the plane, overlaps
    // itself.
    SurfaceMesh crumpled = sphere(12);
    for (std::uint32_t k = 0; k < crumpled.points.size(); ++k) {
        crumpled.points[k] = crumpled.points[k] * (1 + 2e-11 * pcg4d({k, 0, 0, 1})[0]);
    }
    EXPECT_LT(largest_jump(crumpled, 800, values), 0.05);
}

TEST(CellFilter, TheOtherSideOfALeafIsNotSeen) {
    for (const double thickness : {0.0, 1e-3}) {
        for (const int n : {2, 30}) {
            const SurfaceMesh mesh = leaf(thickness, n);
            const SurfaceCells cells = cells_of(mesh, 2000);
            const CellFilter filter = filter_of(mesh, cells);
            const auto is_top = [&](const SurfacePlace& place) {
                return mesh.double_area_normal(place.triangle).z > 0;
            };
            std::vector<float> values;
            for (const SurfacePlace& place : cells.places)
                values.push_back(is_top(place) ? 1.0F : -1.0F);
            const double s = filter.radius();
            for (const SurfacePlace& place : scatter(mesh, 4000, 9)) {
                const Vector3d p = position_of(mesh, place);
                const double rim = std::min({p.x, p.y, 1 - p.x, 1 - p.y});
                const float seen = filtered(filter, values, place) * (is_top(place) ? 1 : -1);
                if (rim > s) {
                    EXPECT_NEAR(seen, 1, 1e-6);
                } else if (rim > s / 2) {
                    EXPECT_GT(seen, 0.6) << thickness << ' ' << n << ' ' << rim / s;
                }
            }
        }
    }
}

TEST(CellFilter, PiecesHaveNothingToDoWithEachOther) {
    PolygonSoup soup = cube();
    append(soup, cube(), {1e-3, 1e-3, 1e-3});
    const SurfaceMesh mesh = make_mesh(std::move(soup))->mesh;
    const std::vector<std::uint32_t> components = connected_components(mesh);
    const SurfaceCells cells = cells_of(mesh, 3000);
    const CellFilter filter = filter_of(mesh, cells);
    std::vector<float> values;
    for (const SurfacePlace& place : cells.places)
        values.push_back(static_cast<float>(components[place.triangle]));
    for (const SurfacePlace& place : scatter(mesh, 3000, 2)) {
        EXPECT_NEAR(filtered(filter, values, place), components[place.triangle], 1e-6);
    }
}

TEST(CellFilter, WhereNoCellIsNearTheNextOneIsSeen) {
    PolygonSoup soup = cube();
    append(soup, cube(), {50, 0, 0});
    const SurfaceMesh mesh = make_mesh(std::move(soup))->mesh;
    const std::vector<std::uint32_t> components = connected_components(mesh);
    SurfaceCells cells = cells_of(mesh, 400);
    // All cells of the second cube and most cells of the first are removed.
    std::vector<SurfacePlace> left;
    for (const SurfacePlace& place : cells.places) {
        const Vector3d p = position_of(mesh, place);
        if (components[place.triangle] == 0 && p.x > 0.5 && p.y > 0.5) left.push_back(place);
    }
    ASSERT_GT(left.size(), 10u);
    Team team(2);
    cells = voronoi_cells(mesh, left, team, never);
    const CellFilter filter(mesh, cells, team);
    std::vector<CellShare> shares;
    for (const SurfacePlace& place : scatter(mesh, 2000, 3)) {
        filter.shares(place, shares);
        double sum = 0;
        for (const CellShare& share : shares) {
            ASSERT_LT(share.cell, left.size());
            sum += share.weight;
        }
        EXPECT_NEAR(sum, 1, 1e-6);
        if (components[place.triangle] == 1) {
            EXPECT_GT(position_of(mesh, left[shares[0].cell]).x, 0.5);
        }
    }
}

TEST(CellFilter, OneCellIsSeenEverywhere) {
    const SurfaceMesh mesh = box();
    const CellFilter filter = filter_of(mesh, cells_of(mesh, 1));
    std::vector<CellShare> shares;
    for (const SurfacePlace& place : scatter(mesh, 100, 3)) {
        filter.shares(place, shares);
        ASSERT_EQ(shares.size(), 1u);
        EXPECT_FLOAT_EQ(shares[0].weight, 1);
    }
}

TEST(CellFilter, SlopesAreThoseOfTheShares) {
    for (const SurfaceMesh& mesh : {square(), sphere(8)}) {
        const SurfaceCells cells = cells_of(mesh, 700);
        const CellFilter filter = filter_of(mesh, cells);
        const std::vector<float> values = random_signs(700);
        std::vector<SlopedShare> shares;
        for (const SurfacePlace& place : scatter(mesh, 300, 6)) {
            filter.sloped_shares(place, shares);
            Vector3 slope, sum;
            for (const SlopedShare& share : shares) {
                slope = slope + share.slope * values[share.cell];
                sum = sum + share.slope;
            }
            EXPECT_LT(length(sum), 1e-5F);
            const std::array<double, 3> steps = {1e-3, -0.4e-3, -0.6e-3};
            SurfacePlace before = place, after = place;
            for (std::size_t k = 0; k < 3; ++k) {
                before.weights[k] -= steps[k];
                after.weights[k] += steps[k];
            }
            const Vector3d way = position_of(mesh, after) - position_of(mesh, before);
            const double change =
                filtered(filter, values, after) - filtered(filter, values, before);
            const double expected =
                (slope.x * way.x + slope.y * way.y + slope.z * way.z) / filter.radius();
            EXPECT_NEAR(change, expected, 1e-5 + 0.09 * length(way) / filter.radius());
        }
    }
}

TEST(CellFilter, ThreadsDoNotMatter) {
    const SurfaceMesh mesh = sphere(12);
    const SurfaceCells cells = cells_of(mesh, 800);
    const CellFilter one = filter_of(mesh, cells, 1), three = filter_of(mesh, cells, 3);
    std::vector<CellShare> a, b;
    for (const SurfacePlace& place : scatter(mesh, 500, 6)) {
        one.shares(place, a);
        three.shares(place, b);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
            EXPECT_EQ(a[k].cell, b[k].cell);
            EXPECT_EQ(a[k].weight, b[k].weight);
        }
    }
}

}  // namespace
}  // namespace cascade::test
