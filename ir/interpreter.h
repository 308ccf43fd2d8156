// The interpreter: runs a cell kernel on blocks of 256 cells of a row, one operation at a time. The
// interpreter needs no compilation. It computes starting values and pictures, and the tests compare
// all other backends with the interpreter.
#pragma once

#include "ir/backend.h"

namespace cascade {

/// A backend that interprets its kernels. Its compile() never fails.
std::unique_ptr<Backend> make_interpreter();

/// Computes one operation on the words a, b and c. The builder calls this for operations on
/// constants, and the interpreter for uniform values. Only for operations that have payload `none`
/// and do not depend on the cell. Must be called inside a FlushDenormals.
std::uint32_t evaluate(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c);
std::uint64_t evaluate(Op op, std::uint64_t a, std::uint64_t b, std::uint64_t c,
                       Precision precision);

}  // namespace cascade
