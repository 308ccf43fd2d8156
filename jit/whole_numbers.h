// Operations that some processors have as an instruction and others do not.
//
// Internal to jit/.
#pragma once

#include "jit/body_scope.h"

namespace cascade {

/// The operations `round_to_even` and `scale_by_power`: an instruction where the processor has one,
/// the sequence of ir/word_operations.h elsewhere, with the same bits.
llvm::Value* rounded_to_even(BodyScope& scope, ValueId a);
llvm::Value* scaled_by_power(BodyScope& scope, ValueId a, ValueId b);

}  // namespace cascade
