// The fixed parts of the C headers of compiled stages. In them, $ stands for the name of the stage,
// and $$ for the same name in capitals.
#pragma once

#include <string_view>

namespace cascade::c_text {

inline constexpr std::string_view beginning = R"(
#ifndef $$_H
#define $$_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#ifdef __FAST_MATH__
#error "The bits of Cascade need strict arithmetic: compile without -ffast-math."
#endif

#ifdef __cplusplus
extern "C" {
#endif

)";

inline constexpr std::string_view sides = R"(
/* The rule of a species at a side. `value` is the value of fixed and slope. `values` is NULL, or
 * points to cell (0, 0, 0) of a plane that holds a value for each cell beside the side. */
struct $_side {
    int kind;
    float value;
    const float *values;
};
enum { $_periodic, $_noflux, $_fixed, $_slope };
/* The order of the sides. */
enum { $_left, $_right, $_top, $_bottom, $_front, $_back };

)";

inline constexpr std::string_view planes = R"(
/* The offset of cell (column i, row j, slice k) from cell (0, 0, 0) of its plane. */
static inline int64_t $_at(int64_t i, int64_t j, int64_t k) {
    return k * $$_SLICE_STRIDE + j * $$_STRIDE + i;
}

/* Sets the floating-point control register of this thread. The compiler moves no arithmetic on
 * memory across this call. */
static inline void $_set_control(uint64_t control) {
#if defined(__x86_64__)
    __asm__ volatile("" : : : "memory");
    _mm_setcsr((unsigned)control);
    __asm__ volatile("" : : : "memory");
#elif defined(__aarch64__)
    __asm__ volatile("msr fpcr, %0" : : "r"(control) : "memory");
#else
    (void)control;
#endif
}

/* Flushes denormal numbers to zero on this thread, as Cascade does. Returns the earlier setting. */
static inline uint64_t $_enter(void) {
    uint64_t before = 0;
#if defined(__x86_64__)
    before = _mm_getcsr();
    $_set_control((before & ~(uint64_t)0x6000) | 0x8040);
#elif defined(__aarch64__)
    __asm__ volatile("mrs %0, fpcr" : "=r"(before));
    $_set_control((before & ~(uint64_t)0xc00000) | 0x1000000);
#endif
    return before;
}

/* A rounded product. Compilers cannot contract it with a following sum to one rounding. */
static inline double $_rounded(double product) {
    const volatile double rounded = product;
    return rounded;
}

/* The value beyond a side. */
static inline float $_beyond(const struct $_side *side, float cell, float value) {
    if (side->kind == $_fixed) return (value + value) - cell;
    {
        const volatile float change = $$_SPACING * value;
        return cell + change;
    }
}

/* The cell of an axis from which the one beyond a side comes: the first or the last. */
static inline int64_t $_source(const struct $_side *sides, int side, int64_t count) {
    return (side % 2 == 0) == (sides[side].kind == $_periodic) ? count - 1 : 0;
}

static inline void $_fill_row(float *to, const float *from, const struct $_side *side,
                              int64_t place) {
    int64_t i;
    if (side->kind <= $_noflux) {
        memcpy(to - 1, from - 1, ($$_WIDTH + 2) * sizeof(float));
        return;
    }
    for (i = -1; i <= $$_WIDTH; ++i) {
        to[i] = $_beyond(side, from[i], side->values ? side->values[place + i] : side->value);
    }
}

/* Fills the halo of a plane: columns, then rows with their halo columns, then slices with both. */
static inline void $_fill_halo(float *plane, const struct $_side *sides) {
    const int64_t left = $_source(sides, $_left, $$_WIDTH);
    const int64_t right = $_source(sides, $_right, $$_WIDTH);
    const int64_t top = $_source(sides, $_top, $$_HEIGHT);
    const int64_t bottom = $_source(sides, $_bottom, $$_HEIGHT);
    int64_t j, k;
    for (k = 0; k < $$_DEPTH; ++k) {
        for (j = 0; j < $$_HEIGHT; ++j) {
            float *row = plane + $_at(0, j, k);
            row[-1] = row[left];
            row[$$_WIDTH] = row[right];
            if (sides[$_left].kind > $_noflux) {
                const float *values = sides[$_left].values;
                row[-1] = $_beyond(&sides[$_left], row[0],
                                   values ? values[$_at(0, j, k)] : sides[$_left].value);
            }
            if (sides[$_right].kind > $_noflux) {
                const float *values = sides[$_right].values;
                row[$$_WIDTH] = $_beyond(&sides[$_right], row[$$_WIDTH - 1],
                                         values ? values[$_at($$_WIDTH - 1, j, k)]
                                                : sides[$_right].value);
            }
        }
        $_fill_row(plane + $_at(0, -1, k), plane + $_at(0, top, k), &sides[$_top],
                   $_at(0, top, k));
        $_fill_row(plane + $_at(0, $$_HEIGHT, k), plane + $_at(0, bottom, k), &sides[$_bottom],
                   $_at(0, bottom, k));
    }
#if $$_DEPTH > 1
    {
        const int64_t front = $_source(sides, $_front, $$_DEPTH);
        const int64_t back = $_source(sides, $_back, $$_DEPTH);
        for (j = -1; j <= $$_HEIGHT; ++j) {
            $_fill_row(plane + $_at(0, j, -1), plane + $_at(0, j, front), &sides[$_front],
                       $_at(0, j, front));
            $_fill_row(plane + $_at(0, j, $$_DEPTH), plane + $_at(0, j, back), &sides[$_back],
                       $_at(0, j, back));
        }
    }
#endif
}

/* Computes all rows of a pass. With OpenMP (-fopenmp) threads share them; the bits stay the same. */
static inline void $_compute($_kernel *kernel, const float *const *fields,
                             const unsigned char *const *masks, const float *uniforms,
                             float *const *results) {
    const int64_t band = 16, bands = ($$_HEIGHT + band - 1) / band;
    int64_t number;
#ifdef _OPENMP
#pragma omp parallel for schedule(static)
#endif
    for (number = 0; number < bands * $$_DEPTH; ++number) {
        const uint64_t before = $_enter();
        const int64_t slice = number / bands, first = number % bands * band;
        const int64_t last = first + band < $$_HEIGHT ? first + band : $$_HEIGHT;
#if $$_DEPTH > 1
        const int64_t rows = $$_HEIGHT + 2;
        kernel(fields, masks, uniforms, results, 0, $$_WIDTH, $$_STRIDE, slice * rows + first,
               slice * rows + last, 0, rows, slice);
#else
        (void)slice;
        kernel(fields, masks, uniforms, results, 0, $$_WIDTH, $$_STRIDE, first, last, 0);
#endif
        $_set_control(before);
    }
}
)";

inline constexpr std::string_view draws = R"(
/* Which step it is, as random numbers are drawn by it: the bits of a number. */
static inline float $_draw(int64_t steps) {
    const uint32_t late = 0x80000000u + (uint32_t)steps;
    float number = (float)steps;
    if (steps >= 16777216) memcpy(&number, &late, sizeof number);
    return number;
}
)";

inline constexpr std::string_view masks = R"(
/* 1 where a plane is not 0. */
static inline void $_make_mask(const float *plane, unsigned char *mask) {
    int64_t i, j, k;
    for (k = 0; k < $$_DEPTH; ++k) {
        for (j = 0; j < $$_HEIGHT; ++j) {
            for (i = 0; i < $$_WIDTH; ++i) mask[$_at(i, j, k)] = plane[$_at(i, j, k)] != 0;
        }
    }
}
)";

inline constexpr std::string_view reductions = R"(
/* Aggregates over the domain: each row in eight partial results, these in pairs; then rows in
 * pairs, pairs in pairs. The tree depends on the grid alone. */
enum { $_sum, $_mean, $_least, $_largest };

static inline double $_together(int kind, double a, double b) {
    if (kind <= $_mean) return a + b;
    if (a != a) return a;
    return (kind == $_least ? a < b : a > b) ? a : b;
}

static inline double $_fold(int kind, double *values, int64_t count) {
    for (; count > 1; count = (count + 1) / 2) {
        int64_t k;
        for (k = 0; 2 * k < count; ++k) {
            values[k] = 2 * k + 1 < count ? $_together(kind, values[2 * k], values[2 * k + 1])
                                          : values[2 * k];
        }
    }
    return values[0];
}

static inline float $_reduce(struct $ *s, int kind, const float *plane) {
    const int64_t lanes = $$_WIDTH < 8 ? $$_WIDTH : 8;
    int64_t row;
    double all;
    for (row = 0; row < $$_ROWS; ++row) {
        const float *cells = plane + $_at(0, row % $$_HEIGHT, row / $$_HEIGHT);
        double partial[8];
        int64_t i;
        for (i = 0; i < lanes; ++i) partial[i] = (double)cells[i];
        for (; i < $$_WIDTH; ++i) partial[i % 8] = $_together(kind, partial[i % 8], (double)cells[i]);
        s->rows[row] = $_fold(kind, partial, lanes);
    }
    all = $_fold(kind, s->rows, $$_ROWS);
    return (float)(kind == $_mean ? all / (double)$$_CELLS : all);
}
)";

inline constexpr std::string_view allocation = R"(
/* The next plane of the memory: the address of its cell (0, 0, 0). */
static inline float *$_plane(char **memory) {
    float *const origin = (float *)(void *)*memory + $$_ORIGIN;
    *memory += $$_PLANE_SIZE * sizeof(float);
    return origin;
}
)";

inline constexpr std::string_view data = R"(
static inline void $_copy(float *plane, const float *data) {
    int64_t row;
    for (row = 0; row < $$_ROWS; ++row) {
        memcpy(plane + $_at(0, row % $$_HEIGHT, row / $$_HEIGHT), data + row * $$_WIDTH,
               $$_WIDTH * sizeof(float));
    }
}
)";

inline constexpr std::string_view clock = R"(    if (length != s->length) {
        s->base_time += $_rounded((double)(float)(s->steps - s->base_step) * s->length);
        s->base_step = s->steps;
        s->length = length;
    }
    t = s->base_time + $_rounded((double)(float)(s->steps - s->base_step) * length);
)";

inline constexpr std::string_view ending = R"(
/* Takes this number of steps. */
static inline void $_run(struct $ *s, int64_t steps) {
    for (; steps > 0; --steps) $_step(s);
}

#ifdef __cplusplus
}
#endif

#endif
)";

}  // namespace cascade::c_text
