// The order in which the steps of a problem visit memory: the number of levels run at once, and the
// size of layers (docs/time_tiling.md explains both).
#pragma once

#include "core/cache_sizes.h"
#include "solvers/step_problem.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cascade {

/// Tiles are cut along one or two axes. The outer axis is the axis of rows, of slices if the grid
/// has several, or of columns if there are few rows. The inner axis is the axis of rows within
/// slices. A layer consists of several rows, slices or columns, so that a kernel call is worth its
/// cost.
struct Tiling {
    /// The parts of the grid that form a layer of the outer axis.
    enum class Along : std::uint8_t {
        slices,   ///< Whole slices, or whole rows if there is one slice.
        rows,     ///< The same rows of all slices.
        columns,  ///< The same columns of all rows.
    };

    int levels = 1;  ///< The largest number of levels. If it is 1, each pass runs separately.
    /// The number of slices, rows or columns in a layer. Columns are a multiple of
    /// PlaneLayout::row_pad.
    std::int64_t outer_layer = 1;
    /// The number of rows in a layer of the inner axis. Only for a grid with slices.
    std::int64_t inner_layer = 1;
    /// The number of bands along the inner axis. If it is 1, slices are not cut.
    int inner_bands = 1;
    /// Whether all levels but the first find their data in the second-level cache, so that none of
    /// it is prefetched.
    bool is_near = false;
    Along along = Along::slices;

    friend bool operator==(const Tiling&, const Tiling&) = default;
};

/// Whether a grid has so few rows that threads share its columns.
bool has_few_rows(const Grid& grid);

/// Part `index` of `count` nearly equal parts of the cells: rows or, if there are few rows, columns
/// of all rows.
Patch share_of(const Grid& grid, int index, int count);

/// The number of threads that are worthwhile for steps of this many species, at most `most`. Small
/// grids get fewer threads.
int worthwhile_threads(const Grid& grid, std::size_t species, int most);

/// Whether all rows of the preceding passes must be complete before this pass begins, because it
/// has an aggregate or a filter of waves.
bool needs_all_rows(const StepProblem::Pass& pass);

/// The bytes of all planes, masks and links that the passes of a step read or write, each counted
/// once. Includes both copies of the species.
std::int64_t bytes_of_step(const StepProblem& problem);

/// The largest number of rows that a link spans; at least 1.
std::int64_t rows_reached(const StepProblem& problem);

/// Whether any plane is periodic along the axis to which this side belongs.
bool wraps(const StepProblem& problem, Side side);

/// Whether all planes of a step stay in a core's caches from step to step. If they do, several
/// levels per tile save nothing.
bool stays_in_cache(const StepProblem& problem, const CacheSizes& caches);

/// The tiling whose levels' data fit into the caches. `reach` is the result of rows_reached().
Tiling choose_tiling(const StepProblem& problem, std::int64_t reach, const CacheSizes& caches);
/// Chooses a tiling as above for `part`, a part of the problem's grid.
Tiling choose_tiling(const StepProblem& problem, const Grid& part, std::int64_t reach,
                     const CacheSizes& caches);

/// The result of choose_tiling() first, then others that may be faster on this machine or for these
/// kernels: one step at a time, fewer levels, or tiles if planes stay in a third-level cache. The
/// list has only one tiling if there is only one way to take the steps, or if each thread's share
/// of all planes stays in its second-level cache. `threads` is the number of threads.
std::vector<Tiling> tilings_to_try(const StepProblem& problem, std::int64_t reach,
                                   const CacheSizes& caches, int threads);

/// The bytes of the layers that one thread uses at a time, in a tile with this number of levels.
double bytes_in_use(const StepProblem& problem, const Tiling& tiling, int levels);

}  // namespace cascade
