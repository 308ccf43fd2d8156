// Measures correlations of neighbours in blocks of a field.
#include "solvers/chequerboard.h"

#include "solvers/field_norms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace cascade {
namespace {

constexpr std::int64_t cells_of_block = 64;
/// Only every n-th band of blocks is examined. n is the larger of cells / `most_cells`, rounded up,
/// and cells / `many_cells`, limited to 1 … 4.
constexpr std::int64_t many_cells = std::int64_t{1} << 14, most_cells = std::int64_t{1} << 22;
/// Neighbours alternate only if their correlation is below −`grid_limit` on a grid, or below
/// −`link_limit` for linked cells.
constexpr double grid_limit = 0.5, link_limit = 0.3;

/// Correlates the deviations of neighbouring cells, and decides whether neighbours alternate.
class Pairs {
public:
    void add(double a, double b) {
        products_ += a * b;
        squares_ += (a * a + b * b) / 2;
        ++count_;
    }
    bool alternate(double limit) const {
        constexpr int least = 8;
        if (count_ < least) return false;
        const double by_chance = std::tanh(4.5 / std::sqrt(static_cast<double>(count_ - 3)));
        return products_ < -std::max(limit, by_chance) * squares_;
    }

private:
    double products_ = 0, squares_ = 0;
    std::int64_t count_ = 0;
};

/// A part of an axis: cells [begin, end).
struct Stretch {
    std::int64_t begin = 0, end = 0;
};

/// Covers cells [0, count) of an axis with stretches of `length` cells. Each begins `stride` cells
/// after the previous one, but the last ends at `count`.
std::vector<Stretch> stretches(std::int64_t count, std::int64_t length, std::int64_t stride) {
    std::vector<Stretch> all;
    for (std::int64_t begin = 0; all.empty() || all.back().end < count; begin += stride) {
        const std::int64_t end = std::min(begin + length, count);
        all.push_back({std::max<std::int64_t>(0, end - length), end});
    }
    return all;
}

/// The size of blocks: 64 cells along a line, 8 × 8 in a plane, 4 × 4 × 4 in space.
std::array<std::int64_t, 3> block_sides(const PlaneLayout& layout) {
    const std::array<std::int64_t, 3> counts{layout.width, layout.height, layout.depth};
    const auto axes =
        std::count_if(counts.begin(), counts.end(), [](auto count) { return count > 1; });
    const std::int64_t side = axes <= 1 ? cells_of_block : axes == 2 ? 8 : 4;
    return {side, side, side};
}

template <typename Number>
class Blocks {
public:
    Blocks(const Plane<Number>& plane, const Mask* inside, double deviation)
        : plane_(plane),
          layout_(plane.layout()),
          inside_(inside),
          least_variance_(0.01 * deviation * deviation) {}

    /// The fraction of cells that are in blocks which alternate along an axis.
    double on_grid() {
        const auto sides = block_sides(layout_);
        const auto cut = [&](std::int64_t count, std::int64_t side, std::int64_t apart = 1) {
            return stretches(count, side, std::max<std::int64_t>(side / 2, 1) * apart);
        };
        const std::int64_t cells = layout_.width * layout_.row_count();
        const std::int64_t apart = std::max(std::clamp<std::int64_t>(cells / many_cells, 1, 4),
                                            (cells + most_cells - 1) / most_cells);
        for (const Stretch k : cut(layout_.depth, sides[2])) {
            for (const Stretch j : cut(layout_.height, sides[1], apart)) {
                for (const Stretch i : cut(layout_.width, sides[0])) look_at({i, j, k});
            }
        }
        return part();
    }

    double on_links(const LinkTable<Number>& table) {
        for (std::int64_t row = 0; row < layout_.row_count(); ++row) {
            for (const Stretch columns : stretches(layout_.width, cells_of_block, cells_of_block)) {
                look_at(table, columns, row);
            }
        }
        return part();
    }

private:
    struct Block {
        Stretch i, j, k;
    };

    bool counts(std::int64_t i, std::int64_t row) const {
        return inside_ == nullptr || inside_->row(row)[i] != 0;
    }
    double part() const { return cells_ > 0 ? alternating_ / cells_ : 0; }

    /// Calls `visit(i, row)` for the cells of a block that are inside the mask.
    template <typename Visit>
    void for_each_cell(const Block& block, Visit visit) const {
        for (std::int64_t k = block.k.begin; k < block.k.end; ++k) {
            for (std::int64_t j = block.j.begin; j < block.j.end; ++j) {
                const std::int64_t row = k * layout_.height + j;
                for (std::int64_t i = block.i.begin; i < block.i.end; ++i) {
                    if (counts(i, row)) visit(i, row);
                }
            }
        }
    }

    struct Level {
        double cells = 0, mean = 0;
        /// Whether the block's deviations are only rounding errors, or are small compared to the
        /// deviations of the whole field.
        bool is_uniform = true;
    };
    Level level_of(const Block& block) const {
        Level level;
        double sum = 0, squares = 0;
        for_each_cell(block, [&](std::int64_t i, std::int64_t row) {
            sum += plane_.row(row)[i];
            ++level.cells;
        });
        level.mean = level.cells > 0 ? sum / level.cells : 0;
        for_each_cell(block, [&](std::int64_t i, std::int64_t row) {
            const double deviation = plane_.row(row)[i] - level.mean;
            squares += deviation * deviation;
        });
        const double variance = level.cells > 0 ? squares / level.cells : 0;
        const double rounding = 1e-6 * level.mean;
        level.is_uniform = !(variance >= least_variance_ && variance > rounding * rounding);
        return level;
    }

    void look_at(const Block& block) {
        const Level level = level_of(block);
        cells_ += level.cells;
        if (level.is_uniform) return;
        if (alternates(block, level.mean, {1, 0, 0}) || alternates(block, level.mean, {0, 1, 0}) ||
            alternates(block, level.mean, {0, 0, 1})) {
            alternating_ += level.cells;
        }
    }

    /// Whether neighbours at offset `to` alternate. Counts pairs whose cells are both in the block.
    bool alternates(const Block& block, double mean, std::array<std::int64_t, 3> to) const {
        const Block first{{block.i.begin, block.i.end - to[0]},
                          {block.j.begin, block.j.end - to[1]},
                          {block.k.begin, block.k.end - to[2]}};
        const std::int64_t rows = to[1] + to[2] * layout_.height;
        Pairs pairs;
        for_each_cell(first, [&](std::int64_t i, std::int64_t row) {
            const std::int64_t beside = i + to[0], row_beside = row + rows;
            if (!counts(beside, row_beside)) return;
            pairs.add(plane_.row(row)[i] - mean, plane_.row(row_beside)[beside] - mean);
        });
        return pairs.alternate(grid_limit);
    }

    void look_at(const LinkTable<Number>& table, Stretch columns, std::int64_t row) {
        const Level level = level_of({columns, {row, row + 1}, {0, 1}});
        cells_ += level.cells;
        if (level.is_uniform) return;
        constexpr std::int64_t lanes = LinkTable<Number>::slice_cells;
        const std::int64_t slices_of_row = (layout_.width + lanes - 1) / lanes;
        Pairs pairs;
        for (std::int64_t i = columns.begin; i < columns.end; ++i) {
            if (!counts(i, row)) continue;
            const std::int64_t slice = row * slices_of_row + i / lanes;
            for (std::uint32_t entry = table.starts[slice]; entry < table.starts[slice + 1];
                 ++entry) {
                const std::int64_t link = entry * lanes + i % lanes;
                if (table.weights[link] == 0) continue;  // This is padding of the slice.
                pairs.add(plane_.row(row)[i] - level.mean,
                          plane_.origin()[table.target(link)] - level.mean);
            }
        }
        if (pairs.alternate(link_limit)) alternating_ += level.cells;
    }

    const Plane<Number>& plane_;
    const PlaneLayout& layout_;
    const Mask* inside_;
    double least_variance_;
    double cells_ = 0, alternating_ = 0;
};

}  // namespace

double alternating_part(const Field& field, const Mask* inside, const Links* links) {
    if (field.empty()) return 0;
    const double deviation = moments(field, inside).deviation;
    if (!(deviation > 0)) return 0;
    return field.visit([&](const auto& plane) {
        using Number = std::remove_cvref_t<decltype(*plane.origin())>;
        Blocks blocks(plane, inside, deviation);
        return links != nullptr ? blocks.on_links(links->table<Number>()) : blocks.on_grid();
    });
}

}  // namespace cascade
