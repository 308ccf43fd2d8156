// What a kernel's operations without operands read: the sources of ir/operations.def.
//
// Internal to jit/. The emitter of a kernel's body knows nothing of grids and links; it asks
// Sources for everything that depends on where the cells lie.
#pragma once

#include "ir/loop_levels.h"

#include <llvm/Analysis/InstSimplifyFolder.h>
#include <llvm/IR/IRBuilder.h>

#include <vector>

namespace cascade {

/// The folder knows LLVM's algebra and does not fold where a denormal is involved.
using Builder = llvm::IRBuilder<llvm::InstSimplifyFolder>;

/// The sources of one loop level; to ask for one of another level is a mistake of ours. N is the
/// number of lanes. Of kernels of binary64, read double for float and i64 for i32, here and below.
class Sources {
public:
    virtual ~Sources() = default;
    // Of the call.
    virtual llvm::Value* uniform(UniformSlot slot);   ///< <N x float>
    virtual llvm::Value* hidden(std::uint64_t word);  ///< <N x float>; see BodyScope::hidden
    // Of the row.
    virtual llvm::Value* cell_row();    ///< <N x i32>
    virtual llvm::Value* cell_slice();  ///< <N x i32>
    // Of the cells.
    virtual llvm::Value* field(FieldSlot slot);             ///< <N x float>
    virtual llvm::Value* laplacian(FieldSlot slot);         ///< <N x float>
    virtual llvm::Value* neighbour(Neighbour at);           ///< <N x float>
    virtual llvm::Value* link_sum(const Instruction& sum);  ///< <N x float>; all but `laplacian`
    virtual llvm::Value* mask(MaskSlot slot);               ///< <N x i1>
    virtual llvm::Value* cell_column();                     ///< <N x i32>
    // Of the links.
    virtual llvm::Value* theirs(FieldSlot slot);  ///< <N x float>
};

}  // namespace cascade
