// Vectors that one iteration of a loop leaves in registers for the next iteration.
//
// Internal to jit/.
#pragma once

#include "jit/kernel_sources.h"

#include <llvm/ADT/STLFunctionalExtras.h>

#include <map>

namespace cascade {

class CarriedVectors {
public:
    /// `header` is the first block of the loop. `outside` writes to the block before the loop.
    CarriedVectors(llvm::BasicBlock& header, Builder& outside)
        : header_(header), outside_(outside) {}

    /// A field's vector from the previous iteration. In the first iteration it is the vector that
    /// `first` computes before the loop.
    llvm::Value* take(FieldSlot slot, llvm::function_ref<llvm::Value*(Builder& outside)> first);
    /// Sets the vector for the next iteration. Must be called after take().
    void give(FieldSlot slot, llvm::Value* vector);
    llvm::Value* given(FieldSlot slot) { return carried_[slot].next; }
    /// Completes the phi nodes at the head of the loop. `before` is the block that enters the loop,
    /// and `latch` the block that repeats it.
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
