// For comparison: Turing's step over linked cells as a good programmer would write it.
#pragma once

#include <cstdint>

namespace cascade::bench {

/// u' = u + step (s (16 − u v) + diffusion_u lap u), v' = v + step (s (u v − v − beta) +
/// diffusion_v lap v).
struct LinkedTuring {
    float step, s, diffusion_u, diffusion_v;
};

/// Planes of cells, which begin with cell 0. `now` and `next` hold the planes of u and v.
struct LinkedPlanes {
    const float* now[2];
    float* next[2];
    const float* beta;
};

/// Slices of sixteen cells, stored as in core/links.h, for rows of `width` cells, a multiple of 16.
struct SlicedLinks {
    const std::uint32_t* starts;
    const std::int32_t* targets;
    const float* weights;
    std::int64_t width, height, stride;
};

/// Compressed sparse rows. The links of cell i end before ends[i].
struct RowLinks {
    const std::uint32_t* ends;
    const std::int32_t* targets;
    const float* weights;
    std::int64_t cells;
};

/// Uses the processor's gather instructions if it has AVX-512.
void sliced_by_gathers(const LinkedTuring&, const SlicedLinks&, const LinkedPlanes&);
/// Loops over sixteen cells and loads their neighbours one by one.
void sliced_by_loads(const LinkedTuring&, const SlicedLinks&, const LinkedPlanes&);
void by_rows(const LinkedTuring&, const RowLinks&, const LinkedPlanes&);

}  // namespace cascade::bench
