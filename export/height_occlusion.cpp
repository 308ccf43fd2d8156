// Marches from each cell in each direction, in steps that grow with the distance. Stops when no
// farther height could rise above the horizon found so far.
#include "export/height_occlusion.h"

#include "core/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace cascade {

namespace {

constexpr std::size_t directions = 16;
constexpr double least_rise = 0.02;
/// The length of a step, relative to the distance from the cell. The first steps are one cell long.
constexpr double step_part = 0.125;

class Horizon {
public:
    Horizon(const FlatCells& cells, std::span<const float> heights)
        : cells_(cells), heights_(heights) {
        for (std::size_t k = 0; k < cells.count(); ++k) {
            if (has_height(k)) highest_ = std::max(highest_, height(k));
        }
        farthest_ = static_cast<double>(std::max(cells.columns, cells.rows));
        for (std::size_t k = 0; k < directions; ++k) {
            const double angle =
                2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(directions);
            ways_[k] = {std::cos(angle), std::sin(angle)};
        }
    }

    float seen_from(std::int64_t i, std::int64_t j) const {
        const auto cell = static_cast<std::size_t>(j * cells_.columns + i);
        if (!has_height(cell)) return 1;
        double sum = 0;
        for (const auto& way : ways_) {
            const double rise =
                steepest(static_cast<double>(i), static_cast<double>(j), height(cell), way);
            sum += 1 / (1 + rise * rise);
        }
        return static_cast<float>(sum / static_cast<double>(directions));
    }

private:
    bool has_height(std::size_t cell) const {
        return cells_.is_inside(cell) && std::isfinite(heights_[cell]);
    }
    double height(std::size_t cell) const { return static_cast<double>(heights_[cell]); }

    double steepest(double x, double y, double from, const std::array<double, 2>& way) const {
        double steepest = 0;
        for (double away = 1; away <= farthest_; away += std::max(1.0, step_part * away)) {
            const double apart = away * cells_.side;
            if (highest_ - from <= std::max(steepest, least_rise) * apart) break;
            const double rise = (height_at(x + way[0] * away, y + way[1] * away) - from) / apart;
            if (rise > steepest) steepest = rise;
        }
        return steepest < least_rise ? 0 : steepest;
    }

    /// The height at any position, linear between cells. Where the plane has no height, the result
    /// is lower than all heights.
    double height_at(double x, double y) const {
        const double left = std::floor(x), top = std::floor(y);
        const auto corner = [&](std::int64_t i, std::int64_t j) {
            const std::int64_t column = cells_.column(static_cast<std::int64_t>(left) + i);
            const std::int64_t row = cells_.row(static_cast<std::int64_t>(top) + j);
            const auto cell = static_cast<std::size_t>(row * cells_.columns + column);
            return has_height(cell) ? height(cell) : std::numeric_limits<double>::lowest();
        };
        const double across = x - left, down = y - top;
        const auto line = [&](std::int64_t j) {
            return across == 0 ? corner(0, j) : (1 - across) * corner(0, j) + across * corner(1, j);
        };
        return down == 0 ? line(0) : (1 - down) * line(0) + down * line(1);
    }

    const FlatCells& cells_;
    std::span<const float> heights_;
    double highest_ = std::numeric_limits<double>::lowest(), farthest_ = 0;
    std::array<std::array<double, 2>, directions> ways_{};
};

}  // namespace

std::vector<float> height_occlusion(const FlatCells& cells, std::span<const float> heights,
                                    Team& team) {
    CHECK(heights.size() == cells.count(), "each cell has a height");
    const Horizon horizon(cells, heights);
    std::vector<float> seen(cells.count());
    team.run([&](int thread) {
        const RowRange mine = split_rows(cells.rows, thread, team.size());
        for (std::int64_t j = mine.begin; j < mine.end; ++j) {
            for (std::int64_t i = 0; i < cells.columns; ++i) {
                seen[static_cast<std::size_t>(j * cells.columns + i)] = horizon.seen_from(i, j);
            }
        }
    });
    return seen;
}

}  // namespace cascade
