// The source texts of the kernels.
#include "device/plane_kernels.h"

namespace cascade {
namespace {

// The numbers of SideKind: 0 periodic, 1 no_flux, 2 fixed, 3 slope. The records of plane p are
// kinds[12 p + side], numbers[7 p + side], and kinds[12 p + 6 + side], which is the position of the
// side's first value or -1. numbers[7 p + 6] is the spacing. A halo cell at an edge follows the
// rules of its sides one after the other: columns, rows, slices.
constexpr std::string_view halo_kernels = R"(
cw c_beyond(int kind, cw cell, cw value, cw spacing) {
    const cw two = c_word((cn)2);
    return kind == 2 ? c_subtract(c_multiply(two, value), c_flush(cell))
                     : c_add(c_flush(cell), c_multiply(spacing, value));
}
/* The cell beside a side: the first or the last of an axis. */
int c_source(int kind, int side, int count) { return (side % 2 == 0) == (kind == 0) ? count - 1 : 0; }
cw c_apply(cw cell, int side, long number, __global const int* kinds, __global const cw* numbers,
           __global const cw* side_values) {
    const int kind = kinds[side];
    if (kind < 2) return cell;
    const int first = kinds[6 + side];
    const cw value = first < 0 ? numbers[side] : side_values[first + number];
    return c_beyond(kind, cell, c_flush(value), c_flush(numbers[6]));
}
/* Cell n of the halo around a slice; false if there are fewer. */
bool c_find(long n, int width, int height, bool is_slice, int* i, int* j) {
    if (is_slice) {
        *i = (int)(n % (width + 2)) - 1;
        *j = (int)(n / (width + 2)) - 1;
        return *j <= height;
    }
    if (n < 2 * (width + 2)) {
        *i = (int)(n % (width + 2)) - 1;
        *j = n < width + 2 ? -1 : height;
        return true;
    }
    n -= 2 * (width + 2);
    *i = n % 2 == 0 ? -1 : width;
    *j = (int)(n / 2);
    return *j < height;
}
__kernel void c_halo(__global cw* planes, __global const long* places, __global const int* kinds,
                     __global const cw* numbers, __global const cw* side_values, const int width,
                     const int height, const int depth, const long stride, const long slice_stride,
                     const int first_slice, const int slices, const int is_slice) {
    const int plane = (int)get_global_id(1) / slices;
    /* Halo slices are -1 and depth. */
    const int k = is_slice ? ((int)get_global_id(1) % slices == 0 ? -1 : depth)
                           : first_slice + (int)get_global_id(1) % slices;
    int i, j;
    if (!c_find((long)get_global_id(0), width, height, is_slice, &i, &j)) return;
    kinds += 12 * plane;
    numbers += 7 * plane;
    planes += places[plane];
    const int x = i < 0 ? 0 : i >= width ? 1 : -1, y = j < 0 ? 2 : j >= height ? 3 : -1,
              z = k < 0 ? 4 : k >= depth ? 5 : -1;
    const int column = x < 0 ? i : c_source(kinds[x], x, width);
    const int row = y < 0 ? j : c_source(kinds[y], y, height);
    const int slice = z < 0 ? k : c_source(kinds[z], z, depth);
    cw cell = planes[slice * slice_stride + row * stride + column];
    if (x >= 0) cell = c_apply(cell, x, (long)slice * height + row, kinds, numbers, side_values);
    if (y >= 0) cell = c_apply(cell, y, (long)slice * width + column, kinds, numbers, side_values);
    if (z >= 0) cell = c_apply(cell, z, (long)row * width + column, kinds, numbers, side_values);
    planes[k * slice_stride + j * stride + i] = cell;
}
__kernel void c_not_finite(__global const cw* plane, const long place, __global int* flag,
                           const int width, const int height, const long stride,
                           const long slice_stride) {
    const int row = get_global_id(1);
    plane += place + row / height * slice_stride + row % height * stride;
    for (int i = get_global_id(0); i < width; i += 64) {
        if ((plane[i] & C_INFINITY) == C_INFINITY) flag[0] = 1;
    }
}
)";

constexpr std::string_view double_functions = R"(
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
double c_normal(double x) { return fabs(x) < 0x1p-1022 ? copysign(0.0, x) : x; }
double c_wide(cw w) { return (double)c_number(c_flush(w)); }
)";

// The numbers of ReductionKind: 0 sum, 1 mean, 2 least, 3 largest.
constexpr std::string_view reduction_kernels = R"(
double c_together(int kind, double a, double b) {
    if (kind < 2) return c_normal(a + b);
    return isnan(a) || (kind == 2 ? a < b : a > b) ? a : b;
}
__kernel void c_row_parts(__global const cw* plane, const long place, __global double* parts,
                          const int kind, const int width, const int height, const long stride,
                          const long slice_stride) {
    const int lane = get_global_id(0), row = get_global_id(1);
    plane += place + row / height * slice_stride + row % height * stride;
    if (lane >= width) return;
    double part = c_wide(plane[lane]);
    for (int i = lane + 8; i < width; i += 8) part = c_together(kind, part, c_wide(plane[i]));
    parts[8 * row + lane] = part;
}
__kernel void c_row_values(__global double* parts, __global double* rows, const int kind,
                           const int width) {
    const int row = get_global_id(1);
    parts += 8 * row;
    for (int count = min(width, 8); count > 1; count = (count + 1) / 2) {
        for (int k = 0; 2 * k < count; ++k) {
            parts[k] = 2 * k + 1 < count ? c_together(kind, parts[2 * k], parts[2 * k + 1])
                                         : parts[2 * k];
        }
    }
    rows[row] = parts[0];
}
__kernel void c_fold_rows(__global double* rows, __global double* spare, const int count,
                          const int kind, const double cells, __global cw* aggregates,
                          const int number) {
    __global double* from = rows;
    __global double* to = spare;
    for (int left = count; left > 1; left = (left + 1) / 2) {
        for (int k = get_local_id(0); 2 * k < left; k += 64) {
            to[k] = 2 * k + 1 < left ? c_together(kind, from[2 * k], from[2 * k + 1])
                                     : from[2 * k];
        }
        barrier(CLK_GLOBAL_MEM_FENCE);
        __global double* const other = from;
        from = to;
        to = other;
    }
    if (get_local_id(0) != 0) return;
    aggregates[number] = c_flush(c_word((cn)(kind == 1 ? from[0] / cells : from[0])));
}
)";

constexpr std::string_view square_kernels = R"(
double c_square(cw w) {
    const double x = c_wide(w);
    return c_normal(x * x);
}
/* Lane 0 also adds what is left after the last sixteen. `counted` cells of all rows count. */
__kernel void c_row_squares(__global const cw* plane, const long place, __global double* parts,
                            const int width, const int height, const long stride,
                            const long slice_stride, const long counted) {
    const int lane = get_global_id(0), row = get_global_id(1);
    plane += place + row / height * slice_stride + row % height * stride;
    const long cells = min((long)width, max(0L, counted - (long)row * width));
    const int whole = width / 16 * 16;
    double sum = 0;
    for (int i = lane; i < whole; i += 16) sum = c_normal(sum + (i < cells ? c_square(plane[i]) : 0.0));
    if (lane == 0) {
        for (int i = whole; i < width; ++i) sum = c_normal(sum + (i < cells ? c_square(plane[i]) : 0.0));
    }
    parts[16 * row + lane] = sum;
}
__kernel void c_square_sums(__global const double* parts, __global double* rows) {
    const int row = get_global_id(1);
    double total = 0;
    for (int lane = 0; lane < 16; ++lane) total = c_normal(total + parts[16 * row + lane]);
    rows[row] = total;
}
)";

}  // namespace

std::string plane_kernels_text(const TextTarget& target) {
    return prelude_text(target) + std::string(halo_kernels);
}

std::string sum_kernels_text(const TextTarget& target) {
    return prelude_text(target) + std::string(double_functions) + std::string(reduction_kernels) +
           std::string(square_kernels);
}

}  // namespace cascade
