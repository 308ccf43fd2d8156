// Restriction averages the fine cells in each coarse cell. Refinement interpolates linearly along
// each axis, with weights 3/4 and 1/4. Division interpolates on cubic curves.
#include "core/resample.h"

#include "core/between_cells.h"
#include "core/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cascade {

namespace {

std::int64_t joined(std::int64_t cells, std::int64_t times) {
    if (cells == 1) return 1;
    CHECK(cells % times == 0, "cells of a coarser grid cover whole cells");
    return cells / times;
}

/// The coarse cells from which a fine cell is interpolated along one axis.
struct Neighbours {
    std::int64_t near = 0, far = 0;
};

/// Fine cells 2n and 2n + 1 lie in coarse cell n. Their centres are a quarter of a coarse
/// cell's width from the coarse cell's centre.
Neighbours neighbours_of(std::int64_t fine, std::int64_t coarse_cells) {
    if (coarse_cells == 1) return {0, 0};
    const std::int64_t near = fine / 2;
    return {near, fine % 2 == 0 ? near - 1 : near + 1};
}

template <typename Number>
Number between(Number near, Number far) {
    return near + (far - near) / 4;
}

}  // namespace

Grid coarser(const Grid& grid, std::int64_t times) {
    Grid result = grid;
    result.width = joined(grid.width, times);
    result.height = joined(grid.height, times);
    result.depth = joined(grid.depth, times);
    result.spacing = grid.spacing * static_cast<double>(times);
    return result;
}

template <typename Number>
Plane<Number> restricted(const Plane<Number>& fine, const Grid& fine_grid,
                         const Grid& coarse_grid) {
    Plane<Number> coarse{PlaneLayout(coarse_grid)};
    const std::int64_t columns = fine_grid.width / coarse_grid.width,
                       rows = fine_grid.height / coarse_grid.height,
                       slices = fine_grid.depth / coarse_grid.depth;
    const auto count = static_cast<double>(columns * rows * slices);
    for (std::int64_t k = 0; k < coarse_grid.depth; ++k) {
        for (std::int64_t j = 0; j < coarse_grid.height; ++j) {
            for (std::int64_t i = 0; i < coarse_grid.width; ++i) {
                double sum = 0;
                for (std::int64_t z = k * slices; z < (k + 1) * slices; ++z) {
                    for (std::int64_t y = j * rows; y < (j + 1) * rows; ++y) {
                        for (std::int64_t x = i * columns; x < (i + 1) * columns; ++x) {
                            sum += static_cast<double>(fine.at(x, y, z));
                        }
                    }
                }
                coarse.at(i, j, k) = static_cast<Number>(sum / count);
            }
        }
    }
    return coarse;
}

template <typename Number>
Plane<Number> refined(Plane<Number>& coarse, const Grid& coarse_grid, const Grid& fine_grid,
                      const SideRules& sides) {
    fill_halo(coarse.origin(), coarse.layout(), sides);
    Plane<Number> fine{PlaneLayout(fine_grid)};
    for (std::int64_t k = 0; k < fine_grid.depth; ++k) {
        const Neighbours z = neighbours_of(k, coarse_grid.depth);
        for (std::int64_t j = 0; j < fine_grid.height; ++j) {
            const Neighbours y = neighbours_of(j, coarse_grid.height);
            for (std::int64_t i = 0; i < fine_grid.width; ++i) {
                const Neighbours x = neighbours_of(i, coarse_grid.width);
                const auto in_row = [&](std::int64_t row, std::int64_t slice) {
                    return between(coarse.at(x.near, row, slice), coarse.at(x.far, row, slice));
                };
                const auto in_slice = [&](std::int64_t slice) {
                    return between(in_row(y.near, slice), in_row(y.far, slice));
                };
                fine.at(i, j, k) = between(in_slice(z.near), in_slice(z.far));
            }
        }
    }
    return fine;
}

Grid finer_grid(const Grid& grid, std::int64_t times) {
    Grid result = grid;
    for (std::int64_t* const side : {&result.width, &result.height, &result.depth}) {
        if (*side > 1) *side *= times;
    }
    result.spacing = grid.spacing / static_cast<double>(times);
    return result;
}

namespace {

/// The position of a fine cell's centre along an axis of the coarse grid: the six coarse cells
/// around it, and the fraction of the way from the third to the fourth.
template <typename Number>
struct Around {
    std::array<std::int64_t, cells_between> cells{};
    Number part = 0;
};

template <typename Number>
std::vector<Around<Number>> around(std::int64_t cells, std::int64_t finer, Boundary boundary) {
    std::vector<Around<Number>> result;
    for (std::int64_t k = 0; k < finer; ++k) {
        const double place = (static_cast<double>(k) + 0.5) * static_cast<double>(cells) /
                                 static_cast<double>(finer) -
                             0.5;
        const double before = std::floor(place);
        Around<Number> each;
        each.part = static_cast<Number>(place - before);
        for (std::size_t n = 0; n < cells_between; ++n) {
            const std::int64_t cell =
                static_cast<std::int64_t>(before) + static_cast<std::int64_t>(n) - 2;
            each.cells[n] = boundary == Boundary::periodic
                                ? (cell % cells + cells) % cells
                                : std::clamp<std::int64_t>(cell, 0, cells - 1);
        }
        result.push_back(each);
    }
    return result;
}

/// Interpolates one slice of a grid, which begins at `from`, into slice k of the finer grid.
template <typename Number, typename Between>
void divide_slice(const Number* from, const PlaneLayout& layout, const Grid& grid,
                  const std::vector<Around<Number>>& columns,
                  const std::vector<Around<Number>>& rows, Plane<Number>& result, std::int64_t k,
                  const Between& value_at) {
    std::vector<Number> line(static_cast<std::size_t>(grid.width));
    for (std::int64_t j = 0; j < static_cast<std::int64_t>(rows.size()); ++j) {
        const Around<Number>& down = rows[static_cast<std::size_t>(j)];
        for (std::int64_t i = 0; i < grid.width; ++i) {
            std::array<Number, cells_between> v{};
            for (std::size_t n = 0; n < v.size(); ++n)
                v[n] = from[down.cells[n] * layout.stride + i];
            line[static_cast<std::size_t>(i)] = value_at(v, down.part);
        }
        for (std::int64_t i = 0; i < static_cast<std::int64_t>(columns.size()); ++i) {
            const Around<Number>& across = columns[static_cast<std::size_t>(i)];
            std::array<Number, cells_between> v{};
            for (std::size_t n = 0; n < v.size(); ++n) {
                v[n] = line[static_cast<std::size_t>(across.cells[n])];
            }
            result.at(i, j, k) = value_at(v, across.part);
        }
    }
}

template <typename Number, typename Between>
Plane<Number> divided_by(const Between& value_at, const Plane<Number>& plane, const Grid& grid,
                         std::int64_t times) {
    const Grid finer = finer_grid(grid, times);
    Plane<Number> result{PlaneLayout(finer)};
    const auto columns = around<Number>(grid.width, finer.width, grid.boundary.x);
    const auto rows = around<Number>(grid.height, finer.height, grid.boundary.y);
    if (grid.depth == 1) {
        divide_slice(plane.origin(), plane.layout(), grid, columns, rows, result, 0, value_at);
        return result;
    }
    const auto slices = around<Number>(grid.depth, finer.depth, grid.boundary.z);
    Plane<Number> between{PlaneLayout(Grid{grid.width, grid.height})};
    for (std::int64_t k = 0; k < finer.depth; ++k) {
        const Around<Number>& deep = slices[static_cast<std::size_t>(k)];
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                std::array<Number, cells_between> v{};
                for (std::size_t n = 0; n < v.size(); ++n) v[n] = plane.at(i, j, deep.cells[n]);
                between.at(i, j) = value_at(v, deep.part);
            }
        }
        divide_slice(between.origin(), between.layout(), grid, columns, rows, result, k, value_at);
    }
    return result;
}

}  // namespace

template <typename Number>
Plane<Number> divided(const Plane<Number>& plane, const Grid& grid, std::int64_t times) {
    return divided_by([](const auto& v, Number part) { return value_between(v, part); }, plane,
                      grid, times);
}

template <typename Number>
Plane<Number> divided_in_range(const Plane<Number>& plane, const Grid& grid, std::int64_t times) {
    return divided_by([](const auto& v, Number part) { return value_in_range(v, part); }, plane,
                      grid, times);
}

template Plane<float> divided(const Plane<float>&, const Grid&, std::int64_t);
template Plane<double> divided(const Plane<double>&, const Grid&, std::int64_t);
template Plane<float> divided_in_range(const Plane<float>&, const Grid&, std::int64_t);
template Plane<double> divided_in_range(const Plane<double>&, const Grid&, std::int64_t);
template Plane<float> restricted(const Plane<float>&, const Grid&, const Grid&);
template Plane<double> restricted(const Plane<double>&, const Grid&, const Grid&);
template Plane<float> refined(Plane<float>&, const Grid&, const Grid&, const SideRules&);
template Plane<double> refined(Plane<double>&, const Grid&, const Grid&, const SideRules&);

}  // namespace cascade
