// Translates a cell kernel to LLVM's instructions, which form the body of the loops that a skeleton
// builds.
//
// Internal to jit/. While kernels run, the processor flushes denormal inputs and results. LLVM does
// not respect this in two cases. First, it drops operations such as x * 1, which flush. So words
// that may be denormal numbers are flushed by integer operations. Second, it evaluates operations
// on constants without flushing, also if the constants are branches of a choice. (LLVM 19 also got
// such a choice wrong: 0 / (c ? 1 : 0) was NaN for both values of c.) So operations on constants
// are evaluated here, as the interpreter evaluates them. A constant that is a branch of a choice is
// loaded from a variable whose value LLVM cannot assume.
#pragma once

#include "jit/body_scope.h"

namespace cascade {

/// Writes all instructions of the scope's loop level. Instructions of enclosing levels must have
/// been written.
void emit_body(BodyScope& scope);
/// Writes the instructions of the given values, in this order, and calls `after` after each value.
void emit_values(
    BodyScope& scope, llvm::ArrayRef<ValueId> values,
    llvm::function_ref<void(ValueId)> after = [](ValueId) {});

}  // namespace cascade
