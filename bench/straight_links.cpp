#include "bench/straight_links.h"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace cascade::bench {
namespace {

constexpr std::int64_t slice_cells = 16;

template <typename Slice>
void for_each_slice(const SlicedLinks& links, const Slice& slice) {
    const std::int64_t slices = links.width / slice_cells;
    for (std::int64_t row = 0; row < links.height; ++row) {
        for (std::int64_t k = 0; k < slices; ++k) {
            slice(row * slices + k, row * links.stride + k * slice_cells);
        }
    }
}

}  // namespace

void sliced_by_gathers(const LinkedTuring& p, const SlicedLinks& links,
                       const LinkedPlanes& planes) {
#ifdef __AVX512F__
    const float* u = planes.now[0];
    const float* v = planes.now[1];
    const __m512 step = _mm512_set1_ps(p.step), s = _mm512_set1_ps(p.s);
    const __m512 du = _mm512_set1_ps(p.diffusion_u), dv = _mm512_set1_ps(p.diffusion_v);
    const __m512 sixteen = _mm512_set1_ps(16);
    for_each_slice(links, [&](std::int64_t slice, std::int64_t at) {
        const __m512 ui = _mm512_load_ps(u + at), vi = _mm512_load_ps(v + at);
        __m512 lap_u = _mm512_setzero_ps(), lap_v = _mm512_setzero_ps();
        for (std::int64_t e = links.starts[slice]; e < links.starts[slice + 1]; ++e) {
            const __m512i j = _mm512_load_si512(links.targets + e * slice_cells);
            const __m512 w = _mm512_load_ps(links.weights + e * slice_cells);
            const __m512 uj = _mm512_i32gather_ps(j, u, 4), vj = _mm512_i32gather_ps(j, v, 4);
            lap_u = _mm512_add_ps(lap_u, _mm512_mul_ps(w, _mm512_sub_ps(uj, ui)));
            lap_v = _mm512_add_ps(lap_v, _mm512_mul_ps(w, _mm512_sub_ps(vj, vi)));
        }
        const __m512 uv = _mm512_mul_ps(ui, vi);
        const __m512 rate_u =
            _mm512_add_ps(_mm512_mul_ps(s, _mm512_sub_ps(sixteen, uv)), _mm512_mul_ps(du, lap_u));
        const __m512 eaten = _mm512_sub_ps(_mm512_sub_ps(uv, vi), _mm512_load_ps(planes.beta + at));
        const __m512 rate_v = _mm512_add_ps(_mm512_mul_ps(s, eaten), _mm512_mul_ps(dv, lap_v));
        _mm512_store_ps(planes.next[0] + at, _mm512_add_ps(ui, _mm512_mul_ps(step, rate_u)));
        _mm512_store_ps(planes.next[1] + at, _mm512_add_ps(vi, _mm512_mul_ps(step, rate_v)));
    });
#else
    sliced_by_loads(p, links, planes);
#endif
}

void sliced_by_loads(const LinkedTuring& p, const SlicedLinks& links, const LinkedPlanes& planes) {
    const float* __restrict u = planes.now[0];
    const float* __restrict v = planes.now[1];
    for_each_slice(links, [&](std::int64_t slice, std::int64_t at) {
        float lap_u[slice_cells] = {}, lap_v[slice_cells] = {};
        for (std::int64_t e = links.starts[slice]; e < links.starts[slice + 1]; ++e) {
            const std::int32_t* __restrict targets = links.targets + e * slice_cells;
            const float* __restrict w = links.weights + e * slice_cells;
            float uj[slice_cells], vj[slice_cells];
#pragma GCC unroll 16
            for (int k = 0; k < slice_cells; ++k) {
                uj[k] = u[targets[k]];
                vj[k] = v[targets[k]];
            }
            for (int k = 0; k < slice_cells; ++k) {
                lap_u[k] += w[k] * (uj[k] - u[at + k]);
                lap_v[k] += w[k] * (vj[k] - v[at + k]);
            }
        }
        float* __restrict next_u = planes.next[0] + at;
        float* __restrict next_v = planes.next[1] + at;
        for (int k = 0; k < slice_cells; ++k) {
            const float ui = u[at + k], vi = v[at + k], uv = ui * vi;
            next_u[k] = ui + p.step * (p.s * (16 - uv) + p.diffusion_u * lap_u[k]);
            next_v[k] =
                vi + p.step * (p.s * (uv - vi - planes.beta[at + k]) + p.diffusion_v * lap_v[k]);
        }
    });
}

void by_rows(const LinkedTuring& p, const RowLinks& links, const LinkedPlanes& planes) {
    const float* __restrict u = planes.now[0];
    const float* __restrict v = planes.now[1];
    std::uint32_t link = 0;
    for (std::int64_t i = 0; i < links.cells; ++i) {
        const float ui = u[i], vi = v[i];
        float lap_u = 0, lap_v = 0;
        for (; link < links.ends[i]; ++link) {
            const std::int32_t j = links.targets[link];
            lap_u += links.weights[link] * (u[j] - ui);
            lap_v += links.weights[link] * (v[j] - vi);
        }
        const float uv = ui * vi;
        planes.next[0][i] = ui + p.step * (p.s * (16 - uv) + p.diffusion_u * lap_u);
        planes.next[1][i] =
            vi + p.step * (p.s * (uv - vi - planes.beta[i]) + p.diffusion_v * lap_v);
    }
}

}  // namespace cascade::bench
