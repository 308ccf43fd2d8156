// The sources of a kernel: its operations without operands (ir/operations.def).
//
// Internal to jit/. The code that emits a kernel's body is the same for all kinds of cells. All
// values that depend on the cells' positions or neighbours come from Sources.
#pragma once

#include "ir/loop_levels.h"

#include <llvm/Analysis/InstSimplifyFolder.h>
#include <llvm/IR/IRBuilder.h>

#include <vector>

namespace cascade {

/// A builder of instructions. InstSimplifyFolder simplifies them by algebraic rules, but evaluates
/// no operation in which a denormal number is involved.
using Builder = llvm::IRBuilder<llvm::InstSimplifyFolder>;

/// The sources of one loop level. Only sources of this level may be requested. N is the number of
/// lanes. In kernels of binary64, read double for float and i64 for i32, here and below.
class Sources {
public:
    virtual ~Sources() = default;
    // Sources that all cells of a call share.
    virtual llvm::Value* uniform(UniformSlot slot);   ///< <N x float>
    virtual llvm::Value* hidden(std::uint64_t word);  ///< <N x float>; see BodyScope::hidden.
    // Sources that all cells of a row share.
    virtual llvm::Value* cell_row();    ///< <N x i32>
    virtual llvm::Value* cell_slice();  ///< <N x i32>
    // Sources that differ from cell to cell.
    virtual llvm::Value* field(FieldSlot slot);      ///< <N x float>
    virtual llvm::Value* laplacian(FieldSlot slot);  ///< <N x float>
    virtual llvm::Value* neighbour(Neighbour at);    ///< <N x float>
    /// <N x float>; all sums except `laplacian`.
    virtual llvm::Value* link_sum(const Instruction& sum);
    virtual llvm::Value* mask(MaskSlot slot);  ///< <N x i1>
    virtual llvm::Value* cell_column();        ///< <N x i32>
    // Sources that differ from link to link.
    virtual llvm::Value* theirs(FieldSlot slot);  ///< <N x float>
};

}  // namespace cascade
