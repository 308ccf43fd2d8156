// Kernels that can be used with the planes of any problem: halos, checks for numbers that are not
// finite, and sums. Drivers store compiled programs, so these kernels are compiled once per device.
#pragma once

#include "device/prelude.h"

#include <string>

namespace cascade {

/// c_halo(planes, places, kinds, numbers, side_values, width, height, depth, stride, slice_stride,
///        first_slice, slices, is_slice): fills halo cells. Work-items: halo cells of a slice ×
///        (planes · slices).
/// c_not_finite(plane, place, flag, width, height, stride, slice_stride): sets flag[0] to 1 if a
///        cell is not finite. Work-items: 64 × rows.
std::string plane_kernels_text(const TextTarget& target);

/// Sums in binary64, in the order of ir/reduction.h and solvers/field_norms.h. Only for devices
/// with binary64. The text after each kernel says how many work-items it needs.
/// c_row_parts(plane, place, parts, kind, width, height, stride, slice_stride): 8 × rows.
/// c_row_values(parts, rows, kind, width): 1 × rows.
/// c_fold_rows(rows, spare, count, kind, cells, aggregates, number): one work-group of 64.
/// c_row_squares(plane, place, parts, width, height, stride, slice_stride, counted): 16 × rows.
/// c_square_sums(parts, rows): 1 × rows.
std::string sum_kernels_text(const TextTarget& target);

/// The width of work-groups of c_halo.
inline constexpr std::size_t halo_group = 64;

}  // namespace cascade
