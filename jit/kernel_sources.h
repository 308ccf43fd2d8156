// The sources of ir/operations.def: the operations of a kernel without operands.
//
// Internal to jit/. The emitter of a kernel's body knows no grids or links. It asks Sources for all
// values that depend on where the cells lie.
#pragma once

#include "ir/loop_levels.h"

#include <llvm/Analysis/InstSimplifyFolder.h>
#include <llvm/IR/IRBuilder.h>

#include <vector>

namespace cascade {

/// The folder knows LLVM's algebra and does not fold if a denormal is involved.
using Builder = llvm::IRBuilder<llvm::InstSimplifyFolder>;

/// The sources of one loop level. Asking for a source of another level is a bug. N is the number of
/// lanes. In kernels of binary64, read double for float and i64 for i32, here and below.
class Sources {
public:
    virtual ~Sources() = default;
    // Sources of the call.
    virtual llvm::Value* uniform(UniformSlot slot);   ///< <N x float>
    virtual llvm::Value* hidden(std::uint64_t word);  ///< <N x float>; see BodyScope::hidden
    // Sources of the row.
    virtual llvm::Value* cell_row();    ///< <N x i32>
    virtual llvm::Value* cell_slice();  ///< <N x i32>
    // Sources of the cells.
    virtual llvm::Value* field(FieldSlot slot);             ///< <N x float>
    virtual llvm::Value* laplacian(FieldSlot slot);         ///< <N x float>
    virtual llvm::Value* neighbour(Neighbour at);           ///< <N x float>
    virtual llvm::Value* link_sum(const Instruction& sum);  ///< <N x float>; all but `laplacian`
    virtual llvm::Value* mask(MaskSlot slot);               ///< <N x i1>
    virtual llvm::Value* cell_column();                     ///< <N x i32>
    // Sources of the links.
    virtual llvm::Value* theirs(FieldSlot slot);  ///< <N x float>
};

}  // namespace cascade
