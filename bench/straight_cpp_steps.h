// The straight C++ code. One file for each set of flags includes it and defines
// STRAIGHT_CPP_FLAVOUR, the name of its function. Everything else is local to that file, so that
// each set has its own code.
#include "bench/straight_cpp.h"

#include <cstring>
#include <initializer_list>

/// Because of this declaration, g++ uses the vector functions of glibc's libmvec, which it
/// otherwise does only with -ffast-math. A comparison with code that calls expf cell by cell would
/// not be fair.
extern "C" [[gnu::simd("notinbranch")]] float expf(float);

namespace cascade::bench {
namespace {

inline float laplacian(const float* __restrict c, std::int64_t i, std::int64_t stride) {
    return c[i - stride] + c[i + stride] + c[i + 1] + c[i - 1] - 4.0F * c[i];
}

/// The number of elements from a row to the next, and from a slice to the next.
struct SpaceStride {
    std::int64_t row, slice;
};

inline float laplacian(const float* __restrict c, std::int64_t i, SpaceStride to) {
    return c[i - to.row] + c[i + to.row] + c[i + 1] + c[i - 1] + c[i - to.slice] + c[i + to.slice] -
           6.0F * c[i];
}

void fill_halo(float* cells, const StraightFields& f) {
    for (std::int64_t j = 0; j < f.height; ++j) {
        float* row = cells + j * f.stride;
        row[-1] = row[f.width - 1];
        row[f.width] = row[0];
    }
    // Includes the columns of the halo, because tensors read the corners.
    const auto bytes = static_cast<std::size_t>(f.width + 2) * sizeof(float);
    std::memcpy(cells - f.stride - 1, cells + (f.height - 1) * f.stride - 1, bytes);
    std::memcpy(cells + f.height * f.stride - 1, cells - 1, bytes);
}

void fill_halo_in_space(float* cells, const StraightFields& f) {
    for (std::int64_t k = 0; k < f.depth; ++k) fill_halo(cells + k * f.slice_stride, f);
    // From the first corner of a slice's halo to the last.
    float* first = cells - f.stride - 1;
    const auto bytes =
        static_cast<std::size_t>((f.height + 1) * f.stride + f.width + 2) * sizeof(float);
    std::memcpy(first - f.slice_stride, first + (f.depth - 1) * f.slice_stride, bytes);
    std::memcpy(first + f.depth * f.slice_stride, first, bytes);
}

// g++ uses __restrict only on parameters of functions that it does not inline. Otherwise it cannot
// prove that planes do not overlap, and does not vectorise these loops. So each row is a call of a
// function.

template <bool has_mask = true, typename Stride>
[[gnu::noinline]] void turing_row(const float* __restrict a, const float* __restrict b,
                                  const float* __restrict beta,
                                  const std::uint8_t* __restrict frozen, float* __restrict new_a,
                                  float* __restrict new_b, std::int64_t width, Stride stride,
                                  StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        // A weight instead of a choice between results, because g++ 12 vectorises this form of the
        // mask.
        const float weight = has_mask && frozen[i] ? 0.0F : k.speed;
        const float ab = a[i] * b[i];
        const float rate_a = k.ka * (16.0F - ab) + k.diff_a * laplacian(a, i, stride);
        const float rate_b = k.ka * (ab - b[i] - beta[i]) + k.diff_b * laplacian(b, i, stride);
        const float moved = b[i] + weight * rate_b;
        new_a[i] = a[i] + weight * rate_a;
        new_b[i] = moved < 0.0F ? 0.0F : moved;
    }
}

template <typename Stride>
[[gnu::noinline]] void gray_scott_row(const float* __restrict u, const float* __restrict v,
                                      float* __restrict new_u, float* __restrict new_v,
                                      std::int64_t width, Stride stride, StraightConstants k) {
    const float loss = k.feed + k.kill;
    for (std::int64_t i = 0; i < width; ++i) {
        const float rate = u[i] * v[i] * v[i];
        const float rate_u = k.diff_u * laplacian(u, i, stride) - rate + k.feed * (1.0F - u[i]);
        const float rate_v = k.diff_v * laplacian(v, i, stride) + rate - loss * v[i];
        new_u[i] = u[i] + k.speed * rate_u;
        new_v[i] = v[i] + k.speed * rate_v;
    }
}

[[gnu::noinline]] void stripes_row(const float* __restrict a, const float* __restrict b,
                                   const float* __restrict c, const float* __restrict d,
                                   const float* __restrict e, const float* __restrict ai,
                                   float* __restrict new_a, float* __restrict new_b,
                                   float* __restrict new_c, float* __restrict new_d,
                                   float* __restrict new_e, std::int64_t width, std::int64_t stride,
                                   StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        const float made_a = 0.01F * a[i] * a[i] * e[i] * ai[i];
        const float made_b = 0.01F * b[i] * b[i] * d[i];
        new_a[i] =
            a[i] + k.speed * (made_a / c[i] - k.p1 * a[i] + k.diff1 * laplacian(a, i, stride));
        new_b[i] =
            b[i] + k.speed * (made_b / c[i] - k.p1 * b[i] + k.diff1 * laplacian(b, i, stride));
        new_c[i] = c[i] + k.speed * (made_a + made_b - k.p2 * c[i]);
        new_d[i] = d[i] + k.speed * (k.p3 * (a[i] - d[i]) + k.diff2 * laplacian(d, i, stride));
        new_e[i] = e[i] + k.speed * (k.p3 * (b[i] - e[i]) + k.diff2 * laplacian(e, i, stride));
    }
}

[[gnu::noinline]] void potential_row(const float* __restrict c, float* __restrict mu,
                                     std::int64_t width, std::int64_t stride, StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        mu[i] = c[i] * c[i] * c[i] - c[i] - k.gamma * laplacian(c, i, stride);
    }
}

[[gnu::noinline]] void mixing_row(const float* __restrict c, const float* __restrict mu,
                                  float* __restrict new_c, std::int64_t width, std::int64_t stride,
                                  StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        new_c[i] = c[i] + k.mixing_speed * laplacian(mu, i, stride);
    }
}

[[gnu::noinline]] void inner_roll_row(const float* __restrict u, float* __restrict roll,
                                      std::int64_t width, std::int64_t stride,
                                      StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) roll[i] = k.kc2 * u[i] + laplacian(u, i, stride);
}

[[gnu::noinline]] void roll_row(const float* __restrict u, const float* __restrict roll,
                                float* __restrict new_u, std::int64_t width, std::int64_t stride,
                                StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        const float rate = k.above * u[i] - k.kc2 * roll[i] - laplacian(roll, i, stride) +
                           k.peaks * (u[i] * u[i]) - u[i] * u[i] * u[i];
        new_u[i] = u[i] + k.roll_speed * rate;
    }
}

/// The flux through the face between cell i and the cell at i + to, in units of chi.
inline float swarm_flux(const float* __restrict cells, const float* __restrict bait, std::int64_t i,
                        std::int64_t to) {
    return 0.5F * (cells[i] + cells[i + to]) * (bait[i + to] - bait[i]);
}

[[gnu::noinline]] void chemotaxis_row(const float* __restrict cells, const float* __restrict bait,
                                      float* __restrict new_cells, float* __restrict new_bait,
                                      std::int64_t width, std::int64_t stride,
                                      StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        const float flow = swarm_flux(cells, bait, i, 1) - swarm_flux(cells, bait, i - 1, 1) +
                           swarm_flux(cells, bait, i, stride) -
                           swarm_flux(cells, bait, i - stride, stride);
        new_cells[i] = cells[i] + k.swarm_speed * (laplacian(cells, i, stride) - k.chi * flow);
        new_bait[i] = bait[i] + k.swarm_speed * (k.spread * laplacian(bait, i, stride) +
                                                 cells[i] / (1.0F + cells[i]) - bait[i]);
    }
}

/// The flux by a tensor through the face between cell i and the cell at i + to. `beside` is the
/// offset along the face.
inline float tensor_flux(const float* __restrict c, std::int64_t i, std::int64_t to,
                         std::int64_t beside, float across, float turned) {
    const float along = (c[i + beside] - c[i - beside]) + (c[i + to + beside] - c[i + to - beside]);
    return across * (c[i + to] - c[i]) + turned * 0.25F * along;
}

[[gnu::noinline]] void tensor_row(const float* __restrict c, float* __restrict new_c,
                                  std::int64_t width, std::int64_t stride, StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        const float along_x = tensor_flux(c, i, 1, stride, k.a11, k.a12) -
                              tensor_flux(c, i - 1, 1, stride, k.a11, k.a12);
        const float along_y = tensor_flux(c, i, stride, 1, k.a22, k.a12) -
                              tensor_flux(c, i - stride, stride, 1, k.a22, k.a12);
        new_c[i] = c[i] + k.tensor_speed * (along_x + along_y);
    }
}

[[gnu::noinline]] void walls_row(const float* __restrict u, float* __restrict new_u,
                                 std::int64_t width, std::int64_t stride, StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        const float rate = u[i] - u[i] * u[i] * u[i] + k.diffusion * laplacian(u, i, stride);
        new_u[i] = u[i] + k.wall_speed * rate;
    }
}

[[gnu::noinline]] void ring_row(const float* __restrict a, const float* __restrict b,
                                const float* __restrict c, float* __restrict new_a,
                                float* __restrict new_b, float* __restrict new_c,
                                std::int64_t width, std::int64_t stride, StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        const float free = k.growth * (1.0F - a[i] - b[i] - c[i]);
        const float rate_a = a[i] * (free - k.defeat * c[i]) + k.mobility * laplacian(a, i, stride);
        const float rate_b = b[i] * (free - k.defeat * a[i]) + k.mobility * laplacian(b, i, stride);
        const float rate_c = c[i] * (free - k.defeat * b[i]) + k.mobility * laplacian(c, i, stride);
        new_a[i] = a[i] + k.game_speed * rate_a;
        new_b[i] = b[i] + k.game_speed * rate_b;
        new_c[i] = c[i] + k.game_speed * rate_c;
    }
}

[[gnu::noinline]] void conductivity_row(const float* __restrict c, float* __restrict conductivity,
                                        std::int64_t width, std::int64_t stride,
                                        StraightConstants k) {
    const float square = k.edge * k.edge;
    for (std::int64_t i = 0; i < width; ++i) {
        const float along_x = 0.5F * (c[i + 1] - c[i - 1]);
        const float along_y = 0.5F * (c[i + stride] - c[i - stride]);
        conductivity[i] = expf(-(along_x * along_x + along_y * along_y) / square);
    }
}

/// The flux through the face between cell i and the cell at i + to.
inline float heat_flux(const float* __restrict c, const float* __restrict conductivity,
                       std::int64_t i, std::int64_t to) {
    return 0.5F * (conductivity[i] + conductivity[i + to]) * (c[i + to] - c[i]);
}

[[gnu::noinline]] void cleaning_row(const float* __restrict c, const float* __restrict conductivity,
                                    float* __restrict new_c, std::int64_t width,
                                    std::int64_t stride, StraightConstants k) {
    for (std::int64_t i = 0; i < width; ++i) {
        const float rate = heat_flux(c, conductivity, i, 1) - heat_flux(c, conductivity, i - 1, 1) +
                           heat_flux(c, conductivity, i, stride) -
                           heat_flux(c, conductivity, i - stride, stride);
        new_c[i] = c[i] + k.cleaning_speed * rate;
    }
}

void turing_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        turing_row(f.now[0] + at, f.now[1] + at, f.varying + at, f.frozen + at, f.next[0] + at,
                   f.next[1] + at, f.width, f.stride, k);
    }
    for (int s = 0; s < 2; ++s) fill_halo(f.next[s], f);
}

void turing_without_mask_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        turing_row<false>(f.now[0] + at, f.now[1] + at, f.varying + at, nullptr, f.next[0] + at,
                          f.next[1] + at, f.width, f.stride, k);
    }
    for (int s = 0; s < 2; ++s) fill_halo(f.next[s], f);
}

void gray_scott_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        gray_scott_row(f.now[0] + at, f.now[1] + at, f.next[0] + at, f.next[1] + at, f.width,
                       f.stride, k);
    }
    for (int s = 0; s < 2; ++s) fill_halo(f.next[s], f);
}

/// Calls `row` with the offset of each row's first cell, slice after slice.
template <typename Row>
void for_rows_in_space(const StraightFields& f, Row row) {
    for (std::int64_t k = 0; k < f.depth; ++k) {
        for (std::int64_t j = 0; j < f.height; ++j) row(k * f.slice_stride + j * f.stride);
    }
}

void turing_in_space_step(const StraightFields& f, const StraightConstants& k) {
    const SpaceStride stride = {f.stride, f.slice_stride};
    for_rows_in_space(f, [&](std::int64_t at) {
        turing_row(f.now[0] + at, f.now[1] + at, f.varying + at, f.frozen + at, f.next[0] + at,
                   f.next[1] + at, f.width, stride, k);
    });
    for (int s = 0; s < 2; ++s) fill_halo_in_space(f.next[s], f);
}

void gray_scott_in_space_step(const StraightFields& f, const StraightConstants& k) {
    const SpaceStride stride = {f.stride, f.slice_stride};
    for_rows_in_space(f, [&](std::int64_t at) {
        gray_scott_row(f.now[0] + at, f.now[1] + at, f.next[0] + at, f.next[1] + at, f.width,
                       stride, k);
    });
    for (int s = 0; s < 2; ++s) fill_halo_in_space(f.next[s], f);
}

void stripes_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        stripes_row(f.now[0] + at, f.now[1] + at, f.now[2] + at, f.now[3] + at, f.now[4] + at,
                    f.varying + at, f.next[0] + at, f.next[1] + at, f.next[2] + at, f.next[3] + at,
                    f.next[4] + at, f.width, f.stride, k);
    }
    // Nothing reads c at neighbours, so its halo is not filled.
    for (const int s : {0, 1, 3, 4}) fill_halo(f.next[s], f);
}

void cahn_hilliard_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        potential_row(f.now[0] + at, f.scratch + at, f.width, f.stride, k);
    }
    fill_halo(f.scratch, f);
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        mixing_row(f.now[0] + at, f.scratch + at, f.next[0] + at, f.width, f.stride, k);
    }
    fill_halo(f.next[0], f);
}

void chemotaxis_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        chemotaxis_row(f.now[0] + at, f.now[1] + at, f.next[0] + at, f.next[1] + at, f.width,
                       f.stride, k);
    }
    for (int s = 0; s < 2; ++s) fill_halo(f.next[s], f);
}

void tensor_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        tensor_row(f.now[0] + at, f.next[0] + at, f.width, f.stride, k);
    }
    fill_halo(f.next[0], f);
}

void allen_cahn_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        walls_row(f.now[0] + at, f.next[0] + at, f.width, f.stride, k);
    }
    fill_halo(f.next[0], f);
}

void rock_scissors_paper_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        ring_row(f.now[0] + at, f.now[1] + at, f.now[2] + at, f.next[0] + at, f.next[1] + at,
                 f.next[2] + at, f.width, f.stride, k);
    }
    for (int s = 0; s < 3; ++s) fill_halo(f.next[s], f);
}

void perona_malik_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        conductivity_row(f.now[0] + at, f.scratch + at, f.width, f.stride, k);
    }
    fill_halo(f.scratch, f);
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        cleaning_row(f.now[0] + at, f.scratch + at, f.next[0] + at, f.width, f.stride, k);
    }
    fill_halo(f.next[0], f);
}

void swift_hohenberg_step(const StraightFields& f, const StraightConstants& k) {
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        inner_roll_row(f.now[0] + at, f.scratch + at, f.width, f.stride, k);
    }
    fill_halo(f.scratch, f);
    for (std::int64_t at = 0; at < f.height * f.stride; at += f.stride) {
        roll_row(f.now[0] + at, f.scratch + at, f.next[0] + at, f.width, f.stride, k);
    }
    fill_halo(f.next[0], f);
}

}  // namespace

StraightSteps STRAIGHT_CPP_FLAVOUR() {
    return {turing_step,
            gray_scott_step,
            stripes_step,
            cahn_hilliard_step,
            chemotaxis_step,
            tensor_step,
            allen_cahn_step,
            rock_scissors_paper_step,
            perona_malik_step,
            swift_hohenberg_step,
            turing_in_space_step,
            gray_scott_in_space_step,
            turing_without_mask_step};
}

}  // namespace cascade::bench
