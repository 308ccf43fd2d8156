// Restriction takes the mean of the fine cells in a coarse cell; refinement interpolates linearly
// along each axis, with weights 3/4 and 1/4.
#include "core/resample.h"

#include "core/check.h"

namespace cascade {

namespace {

std::int64_t divided(std::int64_t cells, std::int64_t times) {
    if (cells == 1) return 1;
    CHECK(cells % times == 0, "cells of a coarser grid cover whole cells");
    return cells / times;
}

/// The coarse cells from which a fine cell is interpolated along one axis.
struct Neighbours {
    std::int64_t near = 0, far = 0;
};

/// Fine cells 2n and 2n + 1 lie in coarse cell n, a quarter of its width from its centre.
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
    result.width = divided(grid.width, times);
    result.height = divided(grid.height, times);
    result.depth = divided(grid.depth, times);
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

template Plane<float> restricted(const Plane<float>&, const Grid&, const Grid&);
template Plane<double> restricted(const Plane<double>&, const Grid&, const Grid&);
template Plane<float> refined(Plane<float>&, const Grid&, const Grid&, const SideRules&);
template Plane<double> refined(Plane<double>&, const Grid&, const Grid&, const SideRules&);

}  // namespace cascade
