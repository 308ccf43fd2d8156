// How the steps of a problem go through memory: how many levels at once, on how large pieces.
#pragma once

#include "core/cache_sizes.h"
#include "solvers/step_problem.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The outer axis is that of rows or, where the grid has them, of slices; the inner one that of the
/// rows within slices. A layer is several of them, so that a call of a kernel is worth it.
struct Tiling {
    /// What a layer of the outer axis is made of, where the grid has slices.
    enum class Along : std::uint8_t {
        slices,  ///< Whole slices.
        rows,    ///< The same rows of all slices.
    };

    int levels = 1;                ///< At most; 1: every pass by itself.
    std::int64_t outer_layer = 1;  ///< Rows or slices of a layer.
    std::int64_t inner_layer = 1;  ///< Of a grid with slices: rows of a layer within them,
    int inner_bands = 1;           ///< and bands of those layers; 1: slices are not cut.
    /// What a level reads is in the second-level cache, but for the first, so nothing need be
    /// fetched ahead.
    bool is_near = false;
    Along along = Along::slices;

    friend bool operator==(const Tiling&, const Tiling&) = default;
};

/// Must the passes before this one be complete in all rows before it begins: for an aggregate, or a
/// filter of waves?
bool needs_all_rows(const StepProblem::Pass& pass);

/// Bytes of all planes, masks and links that the passes of a step read or write, each counted once,
/// both copies of what the steps change included.
std::int64_t bytes_of_step(const StepProblem& problem);

/// How many rows links reach at most, from any cell; at least 1. Looks at all links.
std::int64_t rows_reached(const StepProblem& problem);

/// Is any plane periodic from side to opposite side, along the axis of that side?
bool wraps(const StepProblem& problem, Side side);

/// Do all planes of a step stay in a core's caches from step to step? Then more levels save
/// nothing.
bool stays_in_cache(const StepProblem& problem, const CacheSizes& caches);

/// The tiling that keeps what its levels touch in the caches. `reach`: see rows_reached().
Tiling choose_tiling(const StepProblem& problem, std::int64_t reach, const CacheSizes& caches);

/// That one first, and others that may be faster on this machine or for these kernels: one step a
/// pass, fewer levels; tiles where planes stay in a third-level cache. No others where steps can be
/// taken in one way only, or what each of the `threads` has of all planes stays in its second-level
/// cache.
std::vector<Tiling> tilings_to_try(const StepProblem& problem, std::int64_t reach,
                                   const CacheSizes& caches, int threads);

/// Bytes of the layers that a tile of so many levels has in use at a time, of one thread.
double bytes_in_use(const StepProblem& problem, const Tiling& tiling, int levels);

}  // namespace cascade
