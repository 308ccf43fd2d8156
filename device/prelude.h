// The beginning of every OpenCL program: types, denormal numbers, and a function for each
// operation.
//
// Arithmetic flushes denormal numbers, as everywhere in Cascade (spec/numerics.md). A device does
// this in one of two ways:
//
// - `by_device`: the program is built with -cl-denorms-are-zero, and the device's arithmetic
//   flushes. Some compilers ignore this, and replace x · 1 by x, or a choice between two numbers by
//   a minimum. So the constants with which they could do that, and words that may be denormal, pass
//   through an exclusive or with c_pad, a kernel argument that is 0.
// - `by_kernel`: the device may keep denormal numbers. Kernels flush operands that may be denormal,
//   and results. A product just below the least normal number would be rounded up to it, so the
//   product of larger operands decides (wasm/arithmetic.cpp does the same).
#pragma once

#include "core/grid.h"
#include "core/precision.h"

#include <string>
#include <string_view>

namespace cascade {

enum class Flushing : std::uint8_t { by_device, by_kernel };
/// WGSL has no binary64: programs in WGSL are in single precision.
enum class TextLanguage : std::uint8_t { opencl, wgsl };

/// The properties of a device and the precision for which a program is printed.
struct TextTarget {
    Precision precision = Precision::single;
    Flushing flushing = Flushing::by_kernel;
    /// Whether fma() is a single instruction. If not, a Laplacian is computed without fma(), with
    /// the same result.
    bool has_fast_fma = false;
    /// Whether elements of a plane are counted in 64 bits.
    bool has_large_planes = false;
    TextLanguage language = TextLanguage::opencl;
};

/// The types and functions of a program, which must come first in it.
std::string prelude_text(const TextTarget& target);

/// An expression for the sum of a cell's neighbours. `cell` is the text of the word at some
/// distance, with {} in place of the distance, for example "c_f[c_at + ({})]".
std::string neighbour_sum(Stencil stencil, const PlaneLayout& layout, std::string_view cell);

/// The functions that read neighbours on a grid, or links: c_laplacian() and others. Comes after
/// prelude_text().
std::string stencil_text(const TextTarget& target, Stencil stencil, const PlaneLayout& layout);

/// The parameters by which kernels receive links, empty on grids. The macro C_LINKS passes the
/// links of a cell on to functions. It is empty on grids, too.
std::string link_parameters(const TextTarget& target, bool linked);

}  // namespace cascade
