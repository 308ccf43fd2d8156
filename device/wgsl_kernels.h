// WGSL programs of kernels that belong to no step: for `--dump wgsl`, and for comparing kernels
// with the interpreter. wgsl_steps.h prints steps.
#pragma once

#include "core/grid.h"
#include "device/prelude.h"
#include "ir/cell_kernel.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Kernels in one program, named c_kernel_0 and so on, with separate planes and uniforms.
struct WgslKernels {
    /// The numbers of a kernel's first plane, mask and uniform. A kernel's planes are its fields,
    /// followed by its results.
    struct Place {
        std::size_t plane = 0, mask = 0, uniform = 0;
    };
    std::string text;
    std::vector<Place> places;
    Place end;  ///< The numbers of planes, masks and uniforms of all kernels.
};
WgslKernels wgsl_kernels(std::span<const CellKernel* const> kernels, const Grid& grid,
                         Flushing flushing);

/// The kernel c_halo, which fills halo cells of planes on a grid. Work-items: halo cells of a slice
/// × (planes · slices), where `slices` is 2 for a call that fills halo slices. Words in the buffer
/// c_sides, binding 5, describe the sides: for each plane its place in c_planes, then the lists of
/// HaloRecords. The words of a call from first_call_word on are the position of this description,
/// the number of planes, and 1 for halo slices, else 0.
std::string wgsl_halo(Flushing flushing, const PlaneLayout& layout);
inline constexpr std::size_t wgsl_halo_words = 15;
inline constexpr std::int64_t wgsl_halo_group = 64;

}  // namespace cascade
