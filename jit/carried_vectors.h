// Vectors that the next execution of a loop needs again: they stay in registers.
//
// Internal to jit/.
#pragma once

#include "jit/emit_body.h"

#include <llvm/ADT/STLFunctionalExtras.h>

#include <map>

namespace cascade {

class CarriedVectors {
public:
    /// `header` is the first block of the loop and `outside` writes in the one before it.
    CarriedVectors(llvm::BasicBlock& header, Builder& outside)
        : header_(header), outside_(outside) {}

    /// Of a field: what the execution before this one has given, or, in the first, what `first`
    /// makes before the loop.
    llvm::Value* take(std::uint32_t slot, llvm::function_ref<llvm::Value*(Builder& outside)> first);
    /// What the next execution takes; after take().
    void give(std::uint32_t slot, llvm::Value* vector);
    llvm::Value* given(std::uint32_t slot) { return carried_[slot].next; }
    /// Closes the loop, which is entered from `before` and goes back from `latch`.
    void close(llvm::BasicBlock* before, llvm::BasicBlock* latch);

private:
    struct Carried {
        llvm::PHINode* entering = nullptr;
        llvm::Value* first = nullptr;
        llvm::Value* next = nullptr;
    };

    llvm::BasicBlock& header_;
    Builder& outside_;
    std::map<std::uint32_t, Carried> carried_;
};

}  // namespace cascade
