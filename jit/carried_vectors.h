// Loop-carried vectors, which one iteration of a loop leaves in registers for the next.
//
// Internal to jit/.
#pragma once

#include "jit/kernel_sources.h"

#include <llvm/ADT/STLFunctionalExtras.h>

#include <map>

namespace cascade {

class CarriedVectors {
public:
    /// `header` is the first block of the loop. `outside` writes to the block before it.
    CarriedVectors(llvm::BasicBlock& header, Builder& outside)
        : header_(header), outside_(outside) {}

    /// A field's vector from the previous iteration or, in the first iteration, the one that
    /// `first` writes before the loop.
    llvm::Value* take(FieldSlot slot, llvm::function_ref<llvm::Value*(Builder& outside)> first);
    /// Sets the vector for the next iteration. Must be called after take().
    void give(FieldSlot slot, llvm::Value* vector);
    llvm::Value* given(FieldSlot slot) { return carried_[slot].next; }
    /// Completes the phi nodes of the loop, which is entered from `before` and repeated from
    /// `latch`.
    void close(llvm::BasicBlock* before, llvm::BasicBlock* latch);

private:
    struct Carried {
        llvm::PHINode* entering = nullptr;
        llvm::Value* first = nullptr;
        llvm::Value* next = nullptr;
    };

    llvm::BasicBlock& header_;
    Builder& outside_;
    std::map<FieldSlot, Carried> carried_;
};

}  // namespace cascade
