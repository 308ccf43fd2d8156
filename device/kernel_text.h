// Prints cell kernels as OpenCL C or WGSL.
#pragma once

#include "core/grid.h"
#include "device/prelude.h"
#include "ir/cell_kernel.h"

#include <string>
#include <vector>

namespace cascade {

/// The expressions for planes and uniforms in a printed kernel. In OpenCL a plane is a pointer to
/// cell (0, 0, 0). In WGSL a plane is its place in c_planes, and a mask is a place that is passed
/// to c_mask(). Uniforms are words.
struct KernelNames {
    std::vector<std::string> fields, masks, uniforms, results;
};

/// The statements that compute one cell, c_at, in column c_i, row c_j and slice c_k, and store its
/// results. On linked cells, they also use c_slice, c_lane and the parameters of link_parameters().
/// The kernel has a parameter c_pad, which is 0.
std::string cell_text(const CellKernel& kernel, const KernelNames& names, const TextTarget& target,
                      Stencil stencil, const PlaneLayout& layout);

/// The beginning of a kernel: the loop over the rows of a work-item, inside which the text of a
/// cell follows. In OpenCL a work-item computes `rows_of_item` rows of a column, in WGSL one cell.
std::string cells_begin(const TextTarget& target, Stencil stencil, const PlaneLayout& layout,
                        std::int64_t rows_of_item);
inline constexpr std::string_view cells_end = "    }\n";

}  // namespace cascade
