// The beginning of every WGSL program: bindings, and a function for each operation. The counterpart
// of prelude.h, for browsers and other hosts of WebGPU. Programs are in single precision.
//
// WGSL has no pointers that programs may store or pass on, and WebGPU promises a kernel only few
// buffers. So all planes are in one buffer, and kernels name them by their place in it.
//
// The bindings of group 0:
//   0  c_call, a uniform: the words of a call
//   1  c_planes, read and written: all planes
//   2  c_mask_words, read: the bytes of all masks
//   3  c_uniforms, read: the uniforms of all passes
//   4  c_links, read: the tables of links, on linked cells
// The words of a call:
//   0      0, which no compiler knows: operands are combined with it, so that no compiler may join
//          an operation with the next one
//   1, 2   the first row, and the row after the last one
//   4 – 7  on linked cells, the places of bases, offsets, filled and weights in c_links, which
//          begins with starts
//   8 – 10 the places of the components of links
//   first_call_word and later words: what a program adds
#pragma once

#include "core/grid.h"
#include "device/prelude.h"

#include <cstddef>
#include <string>

namespace cascade {

inline constexpr std::size_t first_call_word = 12;
/// The width and height of work-groups.
inline constexpr std::int64_t wgsl_group_width = 16, wgsl_group_height = 4;

/// The bindings, constants and functions of a program. A call has `call_words` words.
std::string wgsl_prelude(const TextTarget& target, std::size_t call_words);

/// The functions that read neighbours on a grid, or links.
std::string wgsl_stencil(Stencil stencil, const PlaneLayout& layout);

/// The head of the kernel `name`, up to its opening brace.
std::string wgsl_head(std::string_view name);

/// The word of a call as an expression of type u32.
std::string wgsl_call_word(std::size_t word);

}  // namespace cascade
