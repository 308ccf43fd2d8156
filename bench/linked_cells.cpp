#include "bench/linked_cells.h"

#include "bench/curve_order.h"
#include "core/hash.h"
#include "surface/cell_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>

namespace cascade::bench {
namespace {

/// A number in [0, 1) that depends only on a and b.
double scatter(std::uint32_t a, std::uint32_t b) { return pcg4d({a, b, 1, 2})[0] * 0x1p-32; }

std::vector<std::uint32_t> shuffled(std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t k = count; k > 1; --k) {
        const auto other = static_cast<std::size_t>(scatter(static_cast<std::uint32_t>(k), 7) *
                                                    static_cast<double>(k));
        std::swap(order[k - 1], order[other]);
    }
    return order;
}

LinkedCells renumbered_cells(const LinkedCells& cells, const std::vector<std::uint32_t>& order) {
    LinkedCells result;
    for (const std::uint32_t cell : order) result.positions.push_back(cells.positions[cell]);
    result.links = renumbered(cells.links, order);
    return result;
}

}  // namespace

LinkedCells cells_of_torus(std::size_t side) {
    LinkedCells cells;
    for (std::uint32_t k = 0; k < side * side; ++k) {
        const double x = static_cast<double>(k % side) + 0.7 * scatter(k, 0);
        const double y = static_cast<double>(k / side) + 0.7 * scatter(k, 1);
        const double turn = 2 * std::numbers::pi / static_cast<double>(side);
        const double radius = 1 + 0.4 * std::cos(y * turn);
        cells.positions.push_back(
            {radius * std::cos(x * turn), radius * std::sin(x * turn), 0.4 * std::sin(y * turn)});
    }
    std::vector<std::vector<std::uint32_t>> neighbours(side * side);
    const auto link = [&](std::size_t a, std::size_t b) {
        neighbours[a].push_back(static_cast<std::uint32_t>(b));
        neighbours[b].push_back(static_cast<std::uint32_t>(a));
    };
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
            const std::size_t right = (i + 1) % side, above = (j + 1) % side;
            const std::size_t a = j * side + i, b = j * side + right;
            const std::size_t c = above * side + i, d = above * side + right;
            link(a, b);
            link(a, c);
            // Chooses one of the two diagonals of the square.
            if (scatter(static_cast<std::uint32_t>(a), 3) < 0.5) {
                link(a, d);
            } else {
                link(b, c);
            }
        }
    }
    for (std::size_t cell = 0; cell < neighbours.size(); ++cell) {
        for (const std::uint32_t other : neighbours[cell]) {
            cells.links.neighbours.push_back(other);
            const auto low = static_cast<std::uint32_t>(std::min<std::size_t>(cell, other));
            const auto high = static_cast<std::uint32_t>(std::max<std::size_t>(cell, other));
            cells.links.weights.push_back(0.5 + 0.3 * scatter(low, high));
        }
        cells.links.ends.push_back(cells.links.neighbours.size());
    }
    return renumbered_cells(cells, shuffled(side * side));
}

LinkedCells in_order(const LinkedCells& cells, const std::string& order, std::size_t window) {
    std::vector<std::uint32_t> chosen;
    if (order == "curve") {
        chosen = order_along_curve(cells.positions);
    } else if (order == "steps") {
        chosen = order_for_steps(cells.links);
    } else if (order == "levels") {
        chosen = order_by_levels(cells.links);
    } else {
        chosen.resize(cells.positions.size());
        std::iota(chosen.begin(), chosen.end(), 0U);
    }
    if (window > 0) group_by_links(chosen, cells.links, window);
    return renumbered_cells(cells, chosen);
}

}  // namespace cascade::bench
