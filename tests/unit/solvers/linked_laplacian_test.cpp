// The inverse of the Laplacian of linked cells, tested by applying the Laplacian to its result.
#include "solvers/linked_laplacian.h"

#include "core/plane.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace cascade {
namespace {

/// A ring of cells of different areas, whose last row is padded.
class Ring : public ::testing::Test {
protected:
    static constexpr std::int64_t cells = 150;

    Ring() {
        Grid grid;
        grid.width = 64;
        grid.height = 3;
        grid.linked = true;
        layout = PlaneLayout(grid);
        LinkList list;
        areas = Field(layout, Precision::binary64);
        for (std::int64_t k = 0; k < cells; ++k) {
            const double area = 1 + 0.5 * std::sin(static_cast<double>(k));
            areas.origin<double>()[at(k)] = area;
            for (const std::int64_t step : {cells - 1, std::int64_t{1}}) {
                list.neighbours.push_back(static_cast<std::uint32_t>((k + step) % cells));
                list.weights.push_back(1 / area);
            }
            list.ends.push_back(list.neighbours.size());
        }
        links = Links(list, layout, Precision::binary64);
    }

    std::int64_t at(std::int64_t cell) const { return layout.row_start(cell / 64) + cell % 64; }

    /// The largest residual of a (Δ − s) u = f in any cell. `has_mean` says whether the mean of f
    /// is not 0.
    double rest(double s, double a, bool has_mean) {
        LinkedLaplacian laplacian(links, layout, &areas);
        EXPECT_TRUE(laplacian.factorise(s));
        Field f(layout, Precision::binary64), u = f.clone(), image = f.clone();
        double sum = 0, area = 0;
        for (std::int64_t k = 0; k < cells; ++k) {
            f.origin<double>()[at(k)] = std::cos(0.3 * static_cast<double>(k * k));
            sum += areas.origin<double>()[at(k)] * f.origin<double>()[at(k)];
            area += areas.origin<double>()[at(k)];
        }
        for (std::int64_t k = 0; k < cells && !has_mean; ++k) {
            f.origin<double>()[at(k)] -= sum / area;
        }
        laplacian.solve(f.origin<double>(), u.origin<double>(), a);
        laplacian.apply(u.origin<double>(), image.origin<double>(), {0, 3});
        double largest = 0;
        for (std::int64_t k = 0; k < cells; ++k) {
            const double back = a * (image.origin<double>()[at(k)] - s * u.origin<double>()[at(k)]);
            largest = std::max(largest, std::abs(back - f.origin<double>()[at(k)]));
        }
        return largest;
    }

    PlaneLayout layout;
    Field areas;
    Links links;
};

TEST_F(Ring, IsSolved) {
    EXPECT_LT(rest(0.1, 1, true), 1e-11);
    EXPECT_LT(rest(30, -2.5, true), 1e-11);
}

/// For s = 0, u is determined only up to a constant. A hundredth of the second eigenvalue is then
/// added to −Δ.
TEST_F(Ring, IsNearlySolvedWhereAConstantIsFree) {
    EXPECT_LT(rest(0, 1, false), 0.1);
    EXPECT_GT(rest(0, 1, true), 1e-3);
}

}  // namespace
}  // namespace cascade
