// The meaning of every operation of ir/operations.def in OpenCL C and in WGSL.
//
// Internal to device/. Values are words: in OpenCL C, `cw` is the integer type and `cn` the number
// type of the kernel's precision, and in WGSL all values are u32. All names begin with c_, because
// both languages have built-in functions such as step() and mix(). A kernel with such a name would
// be missing without any error.
//
// The text of an operation on operands is the body of a function of the words a, b and c
// (prelude.h, wgsl_prelude.h). The text of a source is an expression in a kernel. It may contain:
//   $f  the field that it reads: a pointer to cell (0, 0, 0), in WGSL its place in c_planes
//   $s  the field `factor` of a flow
//   $d  the distance to a neighbour, in elements
//   $m  the mask: a pointer to cell (0, 0, 0), in WGSL a place of c_mask()
//   $w  the word of the payload, or the uniform
// and the names of the prelude: c_at, c_there, c_i, c_j, c_k, C_LINKS.
#pragma once

#include "device/prelude.h"
#include "ir/cell_kernel.h"

#include <string_view>

namespace cascade {

std::string_view text_of(Op op, TextLanguage language);

}  // namespace cascade
