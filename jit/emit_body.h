// Translates cell kernels to LLVM instructions: the body of the loops that a skeleton builds.
//
// Internal to jit/. The kernel runs with denormal inputs and results flushed, and LLVM takes two
// liberties there. It drops operations such as x * 1, which flush. So words that may be denormal
// numbers are flushed by integer operations. And it computes with constants, also in the branches
// of a choice between them, without flushing (or, LLVM 19, wrongly: 0 / (c ? 1 : 0) was NaN for
// both). So operations on constants are evaluated here, by the interpreter's own definition, and
// constants to choose from are loaded from memory that is opaque to LLVM.
#pragma once

#include "jit/body_scope.h"

namespace cascade {

/// Writes all instructions of the scope's loop level, after the instructions of enclosing levels.
void emit_body(BodyScope& scope);
/// Writes some of them, in this order, and calls `after` after each.
void emit_values(
    BodyScope& scope, llvm::ArrayRef<ValueId> values,
    llvm::function_ref<void(ValueId)> after = [](ValueId) {});

}  // namespace cascade
