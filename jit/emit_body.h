// Cell kernels to LLVM instructions: the body of the loops that a skeleton builds.
//
// Internal to jit/. The emitter knows the operations of ir/operations.def and nothing of grids; it
// asks a Lane for what depends on where the cells lie. A skeleton opens one scope per level of its
// loops, so that what is the same in all cells, or in a row, is computed outside of the loop
// without any pass that moves code.
//
// Denormals. The kernel runs with denormal inputs and results flushed, and LLVM takes two liberties
// there. It drops operations such as x * 1, which flush: wherever a word may be a denormal number
// the emitter flushes it in integer operations. And it computes with constants, also in the
// branches of a choice between them, without flushing (or, LLVM 19, wrongly: 0 / (c ? 1 : 0) was
// NaN for both): operations on constants are evaluated here, by the interpreter's own definition,
// and constants to choose from are loaded from memory that LLVM does not look into.
#pragma once

#include "ir/cell_kernel.h"
#include "jit/kernel_shape.h"

#include <llvm/Analysis/InstSimplifyFolder.h>
#include <llvm/IR/IRBuilder.h>

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The folder knows LLVM's algebra and does not fold where a denormal is involved.
using Builder = llvm::IRBuilder<llvm::InstSimplifyFolder>;

/// How often a value is computed.
enum class Level : std::uint8_t {
    call,  ///< Once: it depends on constants and uniforms alone.
    row,   ///< Once a row.
    cell,  ///< For each vector of cells.
};

/// The level of every instruction of a kernel.
std::vector<Level> levels_of(const CellKernel& kernel);

/// The cells that one execution of the body computes; N of them make a vector. A skeleton has a
/// lane for each level, which is asked only for what belongs to this level. Of kernels of binary64,
/// read double for float and i64 for i32, here and below.
class Lane {
public:
    virtual ~Lane() = default;
    // Of the call.
    virtual llvm::Value* uniform(std::uint32_t slot);  ///< <N x float>
    virtual llvm::Value* hidden(std::uint64_t word);   ///< <N x float>, a hidden constant
    // Of the row.
    virtual llvm::Value* cell_row();    ///< <N x i32>
    virtual llvm::Value* cell_slice();  ///< <N x i32>
    // Of the cells.
    virtual llvm::Value* field(std::uint32_t slot);         ///< <N x float>
    virtual llvm::Value* laplacian(std::uint32_t slot);     ///< <N x float>
    virtual llvm::Value* neighbour(Neighbour at);           ///< <N x float>
    virtual llvm::Value* link_sum(const Instruction& sum);  ///< <N x float>, but for a laplacian
    virtual llvm::Value* mask(std::uint32_t slot);          ///< <N x i1>
    virtual llvm::Value* cell_column();                     ///< <N x i32>
};

/// The values of one level, at one place of the code. Values of lower levels are looked up in the
/// scopes outside of it, which must outlive it.
class BodyScope {
public:
    /// `builder` writes at the end of this level's block, which is still without a terminator.
    BodyScope(const CellKernel& kernel, std::span<const Level> levels, Level level,
              Builder& builder, Lane& lane, const KernelShape& shape, BodyScope* outer);

    /// Emits all instructions of this level.
    void emit();

    /// A value as <N x float>, <N x i32>, or as the truth of it in <N x i1>.
    llvm::Value* number(ValueId id);
    llvm::Value* bits(ValueId id);
    llvm::Value* truth(ValueId id);

private:
    /// One value in up to three forms; forms that nobody asked for are not made.
    struct Forms {
        llvm::Value* number = nullptr;
        llvm::Value* bits = nullptr;
        llvm::Value* truth = nullptr;
        bool is_boolean = false;  ///< It is 1 or 0, and `truth` says which.
        bool may_be_denormal = false;
        bool is_choice = false;       ///< Between constants, in all branches.
        bool may_be_neutral = false;  ///< It chooses between a constant and something else.
    };

    BodyScope& owner(ValueId id);
    Forms& forms(ValueId id) { return owner(id).values_[id]; }

    Forms emit(const Instruction& instruction);
    bool is_evaluated(const Instruction& instruction, Forms& value);
    Forms emit_source(const Instruction& instruction);
    Forms emit_arithmetic(const Instruction& instruction);
    Forms emit_multiply_add(const Instruction& instruction);
    Forms emit_comparison(const Instruction& instruction);
    Forms emit_logic(const Instruction& instruction);
    Forms emit_select(const Instruction& instruction);
    Forms emit_word(const Instruction& instruction);
    llvm::Value* rounded_to_even(ValueId a);
    llvm::Value* scaled_by_power(ValueId a, ValueId b);
    llvm::Value* scaled_by_instruction(llvm::Value* a, llvm::Value* b);
    std::optional<std::uint64_t> constant_word(ValueId id);
    llvm::Value* branch(ValueId id, ValueId other);
    llvm::Value* hidden(std::uint64_t word);
    llvm::Value* operand(ValueId id);
    llvm::Value* operand(ValueId id, ValueId partner, double neutral);
    llvm::Value* flushed(ValueId id);
    llvm::Constant* splat(std::uint64_t word) const;
    llvm::Constant* word_splat(std::uint64_t word) const;

    const CellKernel& kernel_;
    WordFormat format_;
    std::span<const Level> levels_;
    Level level_;
    const KernelShape& shape_;
    Builder& builder_;
    Lane& lane_;
    BodyScope* outer_;
    llvm::VectorType* number_type_;
    llvm::VectorType* bits_type_;
    std::map<std::uint64_t, llvm::Value*> hidden_;
    std::vector<Forms> values_;  ///< By value; only those of this level are filled in.
};

/// The type of a kernel's numbers, and of its words.
inline llvm::Type* number_type(llvm::IRBuilderBase& builder, Precision precision) {
    return precision == Precision::single ? builder.getFloatTy() : builder.getDoubleTy();
}
inline llvm::Type* word_type(llvm::IRBuilderBase& builder, Precision precision) {
    return builder.getIntNTy(static_cast<unsigned>(format_of(precision).bits));
}
/// A word as a constant of LLVM.
llvm::APFloat number_constant(std::uint64_t word, Precision precision);

}  // namespace cascade
