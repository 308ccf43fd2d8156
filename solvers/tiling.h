// How the steps of a problem pass through memory: the number of levels at once, and the size of
// layers.
#pragma once

#include "core/cache_sizes.h"
#include "solvers/step_problem.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The outer axis is the axis of rows, of slices if the grid has them, or of columns if there are
/// few rows. The inner axis is the axis of rows within slices. A layer consists of several of them,
/// so that a kernel call is worth its cost.
struct Tiling {
    /// What a layer of the outer axis consists of.
    enum class Along : std::uint8_t {
        slices,   ///< Whole slices, or whole rows if there is one slice.
        rows,     ///< The same rows of all slices.
        columns,  ///< The same columns of all rows.
    };

    int levels = 1;  ///< The most levels; 1: each pass runs separately.
    /// Slices, rows or columns of a layer; columns in multiples of PlaneLayout::row_pad.
    std::int64_t outer_layer = 1;
    std::int64_t inner_layer = 1;  ///< For a grid with slices: the rows of a layer in them,
    int inner_bands = 1;  ///< and the number of bands of such layers; 1: slices are not cut.
    /// All levels but the first find their data in the second-level cache, so none is prefetched.
    bool is_near = false;
    Along along = Along::slices;

    friend bool operator==(const Tiling&, const Tiling&) = default;
};

/// Does a grid have so few rows that threads share its columns?
bool has_few_rows(const Grid& grid);

/// Part `index` of `count` nearly equal parts of the cells: rows, or columns of all rows.
Patch share_of(const Grid& grid, int index, int count);

/// Must the passes before this one be complete in all rows before it begins, because of an
/// aggregate or a filter of waves?
bool needs_all_rows(const StepProblem::Pass& pass);

/// Bytes of all planes, masks and links that the passes of a step read or write, each counted once,
/// including both copies of the species.
std::int64_t bytes_of_step(const StepProblem& problem);

/// The largest number of rows that a link spans; at least 1.
std::int64_t rows_reached(const StepProblem& problem);

/// Is any plane periodic from side to opposite side, along the axis of that side?
bool wraps(const StepProblem& problem, Side side);

/// Do all planes of a step stay in a core's caches from step to step? If so, more levels save
/// nothing.
bool stays_in_cache(const StepProblem& problem, const CacheSizes& caches);

/// The tiling that holds the data of its levels in the caches. For `reach`, see rows_reached().
Tiling choose_tiling(const StepProblem& problem, std::int64_t reach, const CacheSizes& caches);

/// That tiling first, then others that may be faster on this machine or for these kernels: one step
/// a pass, fewer levels, or tiles if planes stay in a third-level cache. No others if steps can be
/// taken in one way only, or if each thread's share of all planes stays in its second-level cache.
/// `threads` is the number of threads.
std::vector<Tiling> tilings_to_try(const StepProblem& problem, std::int64_t reach,
                                   const CacheSizes& caches, int threads);

/// Bytes of the layers that one thread uses at a time, in a tile with this number of levels.
double bytes_in_use(const StepProblem& problem, const Tiling& tiling, int levels);

}  // namespace cascade
