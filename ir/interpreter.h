// The block interpreter: runs a cell kernel over blocks of 256 cells of a row, an operation at a
// time. Needs no compiling; starting values and pictures are computed by it, and it is the oracle
// against which every other backend is tested.
#pragma once

#include "ir/backend.h"

namespace cascade {

/// A backend whose kernels are interpreted. compile() never fails.
std::unique_ptr<Backend> make_interpreter();

/// The value of one operation on given words: the meaning that folding and the interpreter share.
/// Only operations with payload `none` and no cell dependence. Call inside a FlushDenormals.
std::uint32_t evaluate(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c);
std::uint64_t evaluate(Op op, std::uint64_t a, std::uint64_t b, std::uint64_t c,
                       Precision precision);

}  // namespace cascade
