// Filters, tested with the operators that they undo. The operators are computed from neighbours and
// halos, without waves.
#include "solvers/wave_filter.h"

#include "core/plane.h"
#include "solvers/wave_transforms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace cascade {
namespace {

/// Values of a plane in order of cells.
using Values = std::vector<double>;

struct Domain {
    Grid grid;
    SideRules sides;

    std::size_t count() const { return static_cast<std::size_t>(grid.cell_count()); }
    std::size_t cell(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return static_cast<std::size_t>((k * grid.height + j) * grid.width + i);
    }
};

template <typename Visit>
void for_cells(const Grid& grid, const Visit& visit) {
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) visit(i, j, k);
        }
    }
}

/// The value of a change beyond a side: the value inside, or its negative at a side with a fixed
/// value.
double neighbour(const Domain& domain, const Values& u, std::int64_t at[3], int axis, int by) {
    const std::int64_t cells[3] = {domain.grid.width, domain.grid.height, domain.grid.depth};
    std::int64_t place[3] = {at[0], at[1], at[2]};
    double sign = 1;
    place[axis] += by;
    if (place[axis] < 0 || place[axis] >= cells[axis]) {
        const SideKind kind = domain.sides.at[static_cast<std::size_t>(2 * axis + (by > 0))].kind;
        if (kind == SideKind::periodic) {
            place[axis] = (place[axis] + cells[axis]) % cells[axis];
        } else {
            place[axis] = at[axis];
            if (kind == SideKind::fixed) sign = -1;
        }
    }
    return sign * u[domain.cell(place[0], place[1], place[2])];
}

Values second_difference(const Domain& domain, const Values& u, int axis) {
    const std::int64_t cells[3] = {domain.grid.width, domain.grid.height, domain.grid.depth};
    const double h = domain.grid.spacing;
    Values result(u.size(), 0);
    if (cells[axis] == 1) return result;
    for_cells(domain.grid, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        std::int64_t at[3] = {i, j, k};
        const double own = u[domain.cell(i, j, k)];
        result[domain.cell(i, j, k)] =
            (neighbour(domain, u, at, axis, -1) + neighbour(domain, u, at, axis, 1) - 2 * own) /
            (h * h);
    });
    return result;
}

/// The central difference along a periodic axis.
Values first_difference(const Domain& domain, const Values& u, int axis) {
    Values result(u.size(), 0);
    for_cells(domain.grid, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        std::int64_t at[3] = {i, j, k};
        result[domain.cell(i, j, k)] =
            (neighbour(domain, u, at, axis, 1) - neighbour(domain, u, at, axis, -1)) /
            (2 * domain.grid.spacing);
    });
    return result;
}

void add(Values& to, double factor, const Values& values) {
    for (std::size_t n = 0; n < to.size(); ++n) to[n] += factor * values[n];
}

Values laplacian(const Domain& domain, const Values& u) {
    Values sum(u.size(), 0);
    for (int axis = 0; axis < 3; ++axis) add(sum, 1, second_difference(domain, u, axis));
    return sum;
}

/// M u by the definition of M. The factors damp all waves.
Values diffused(const Domain& domain, const DiffusionSymbol& f, const Values& u) {
    Values sum(u.size(), 0), power = u;
    for (std::size_t n = 0; n < laplacian_powers; ++n) {
        power = laplacian(domain, power);
        add(sum, n % 2 == 0 ? f[n] : -f[n], power);
    }
    for (int axis = 0; axis < 3; ++axis) {
        add(sum, f[laplacian_powers + static_cast<std::size_t>(axis)],
            second_difference(domain, u, axis));
    }
    if (f[mixed_term] != 0) {
        add(sum, f[mixed_term], first_difference(domain, first_difference(domain, u, 0), 1));
    }
    add(sum, -f[decay_term], u);
    return sum;
}

template <typename Number>
Values filtered(const Domain& domain, const DiffusionSymbol& symbol, WaveResponse response,
                double length, const Values& u, int threads = 1) {
    Plane<Number> plane{PlaneLayout(domain.grid)};
    for_cells(domain.grid, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        plane.at(i, j, k) = static_cast<Number>(u[domain.cell(i, j, k)]);
    });
    const WaveFilter<Number> filter(domain.grid, {domain.sides});
    Number* const cells = plane.origin();
    Team team(threads);
    team.run([&](int thread) {
        filter.apply(team, thread, threads, {{cells}, {}, {}}, std::span(&symbol, 1), response,
                     length);
    });
    Values result(u.size());
    for_cells(domain.grid, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        result[domain.cell(i, j, k)] = static_cast<double>(plane.at(i, j, k));
    });
    return result;
}

Values any_values(std::size_t count) {
    Values values(count);
    for (std::size_t n = 0; n < count; ++n) {
        values[n] = std::sin(1.7 * static_cast<double>(n * n % 101)) + 0.3;
    }
    return values;
}

double largest_difference(const Values& a, const Values& b) {
    double most = 0;
    for (std::size_t n = 0; n < a.size(); ++n) most = std::max(most, std::abs(a[n] - b[n]));
    return most;
}

SideRules rules(const std::string& words) {
    SideRules result;
    for (std::size_t side = 0; side < side_count; ++side) {
        switch (words[side]) {
            case 'p': result.at[side].kind = SideKind::periodic; break;
            case 'n': result.at[side].kind = SideKind::no_flux; break;
            case 'f': result.at[side].kind = SideKind::slope; break;
            default: result.at[side].kind = SideKind::fixed; break;
        }
    }
    return result;
}

std::vector<Domain> domains() {
    std::vector<Domain> result;
    const auto grid = [](std::int64_t w, std::int64_t h, std::int64_t d, double spacing) {
        Grid made;
        made.width = w;
        made.height = h;
        made.depth = d;
        made.spacing = spacing;
        return made;
    };
    for (const char* words :
         {"pppppp", "nnnnnn", "vvvvvv", "vnnvff", "nvppvv", "ppvnnf", "ppppnv"}) {
        result.push_back({grid(13, 1, 1, 1), rules(words)});
        result.push_back({grid(1, 24, 1, 0.5), rules(words)});
        result.push_back({grid(19, 12, 1, 2), rules(words)});
        result.push_back({grid(32, 2, 1, 1), rules(words)});
        result.push_back({grid(17, 5, 6, 1.5), rules(words)});
        result.push_back({grid(1, 7, 9, 1), rules(words)});
    }
    return result;
}

constexpr DiffusionSymbol of_all{0.7, 0.3, 0.05, 0.01, 0.4, 0.2, 0.6, 0, 0.15};

TEST(WaveFilter, UndoesImplicitDiffusionAtAllSides) {
    const double h = 1.3;
    for (const Domain& domain : domains()) {
        const Values u = any_values(domain.count());
        const Values found = filtered<double>(domain, of_all, WaveResponse::implicit, h, u);
        Values back = found;
        add(back, -h, diffused(domain, of_all, found));
        EXPECT_LT(largest_difference(back, u), 1e-10)
            << domain.grid.width << " " << domain.grid.height << " " << domain.grid.depth;
        const Values rounded = filtered<float>(domain, of_all, WaveResponse::implicit, h, u);
        EXPECT_LT(largest_difference(rounded, found), 2e-6);
    }
}

/// Diffusion in an oblique direction, a11 dxx + 2 a12 dxy + a22 dyy, between periodic sides.
TEST(WaveFilter, UndoesDiffusionInADirection) {
    for (const double mixed : {0.5, -0.5}) {
        const DiffusionSymbol oblique{0.1, 0, 0, 0, 0.6, 0.2, 0.3, mixed, 0.2};
        int count = 0;
        for (const Domain& domain : domains()) {
            bool is_periodic = true;
            for (std::size_t side = 0; side < 4; ++side) {
                is_periodic &= domain.sides.at[side].kind == SideKind::periodic;
            }
            if (!is_periodic) continue;
            ++count;
            const Values u = any_values(domain.count());
            const Values found = filtered<double>(domain, oblique, WaveResponse::implicit, 2.5, u);
            Values back = found;
            add(back, -2.5, diffused(domain, oblique, found));
            EXPECT_LT(largest_difference(back, u), 1e-10)
                << domain.grid.width << " " << domain.grid.height << " " << domain.grid.depth;
        }
        EXPECT_EQ(count, 12);
    }
}

// R is the filter of waves with the exponential response, so exp(h M) u = u + h M R u. Two such
// steps equal one step of twice the length.
TEST(WaveFilter, ExponentialStepsAddUp) {
    for (const Domain& domain : domains()) {
        const auto step = [&](const Values& u, double h) {
            Values result = u;
            add(result, h,
                diffused(domain, of_all,
                         filtered<double>(domain, of_all, WaveResponse::exponential, h, u)));
            return result;
        };
        const Values u = any_values(domain.count());
        EXPECT_LT(largest_difference(step(step(u, 0.4), 0.4), step(u, 0.8)), 1e-9);
    }
}

TEST(WaveFilter, LeavesWavesThatWouldGrow) {
    const Domain domain{Grid{64, 1}, rules("pppppp")};
    Values u(64);
    for (int n = 0; n < 64; ++n)
        u[static_cast<std::size_t>(n)] = std::cos(2 * std::numbers::pi * n / 16);
    DiffusionSymbol backwards{};
    backwards[0] = -1;
    backwards[1] = 1;
    EXPECT_LT(
        largest_difference(filtered<double>(domain, backwards, WaveResponse::implicit, 100, u), u),
        1e-12);
}

TEST(WaveFilter, BitsDoNotDependOnThreads) {
    for (const Domain& domain : domains()) {
        const Values u = any_values(domain.count());
        for (const WaveResponse response : {WaveResponse::implicit, WaveResponse::exponential}) {
            const Values one = filtered<float>(domain, of_all, response, 2, u);
            for (const int threads : {2, 3, 5}) {
                EXPECT_EQ(filtered<float>(domain, of_all, response, 2, u, threads), one) << threads;
            }
        }
    }
}

TEST(WaveFilter, IsAbandonedInTheMiddleWhenTheRunIsCancelled) {
    const Grid grid{12, 10, {Boundary::periodic, Boundary::periodic, Boundary::periodic}, 1};
    const WaveTransforms<float> transforms(grid, {SideRules(grid.boundary)});
    Plane<float> plane{PlaneLayout(grid)};
    float* const cells[] = {plane.origin()};
    const std::span<float* const> planes(cells);
    for (const int threads : {1, 3}) {
        std::atomic<bool> cancel = false;
        std::atomic<int> visits = 0;
        Team team(threads);
        const auto visit = [&](const WaveBlock<float>&) {
            ++visits;
            cancel = true;
        };
        const auto transform = [&](const std::atomic<bool>* flag) {
            return complete([&] {
                team.run([&](int thread) {
                    transforms.apply(team, thread, threads, {true}, {&planes, 1}, visit, flag);
                });
            });
        };
        EXPECT_FALSE(transform(&cancel));
        EXPECT_GE(visits, 1) << "it has begun";
        EXPECT_TRUE(transform(nullptr)) << "the team works on";
    }
}

}  // namespace
}  // namespace cascade
