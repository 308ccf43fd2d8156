// The values of a kernel's body while LLVM's instructions for them are written.
//
// Internal to jit/. Scopes are nested like the levels of loops, so that values that are equal in
// all cells, or in a row, are computed outside the loop without any pass that moves code.
#pragma once

#include "jit/kernel_shape.h"
#include "jit/kernel_sources.h"

#include <map>
#include <optional>
#include <vector>

namespace cascade {

/// The type of a kernel's numbers, and of its words.
inline llvm::Type* number_type(llvm::IRBuilderBase& builder, Precision precision) {
    return precision == Precision::single ? builder.getFloatTy() : builder.getDoubleTy();
}
inline llvm::Type* word_type(llvm::IRBuilderBase& builder, Precision precision) {
    return builder.getIntNTy(static_cast<unsigned>(format_of(precision).bits));
}
/// A word as an LLVM constant.
llvm::APFloat number_constant(std::uint64_t word, Precision precision);

/// The data shared by all scopes of a kernel.
struct Body {
    const CellKernel& kernel;
    const KernelShape& shape;
    WordFormat format;
    IdVector<ValueId, LoopLevel> levels;  ///< By value.
    llvm::VectorType* number_type;        ///< <N x float>
    llvm::VectorType* bits_type;          ///< <N x i32>

    /// A constant word in all lanes, as numbers or as bits.
    llvm::Constant* number(std::uint64_t word) const;
    llvm::Constant* bits(std::uint64_t word) const;
};

/// Refers to `kernel` and `shape`.
Body body_of(const CellKernel& kernel, const KernelShape& shape, Builder& builder);

/// One value in up to three forms, which are made on request.
struct Forms {
    llvm::Value* number = nullptr;  ///< <N x float>
    llvm::Value* bits = nullptr;    ///< <N x i32>
    llvm::Value* truth = nullptr;   ///< <N x i1>
    bool is_boolean = false;        ///< It is 1 or 0, and `truth` says which.
    bool may_be_denormal = false;
    bool is_choice = false;       ///< A constant, or a choice between constants only.
    bool may_be_neutral = false;  ///< LLVM may find a constant in it, as in a branch of a choice.
};

/// The values of one loop level. Values of outer levels are looked up in the enclosing scopes,
/// which must outlive it.
class BodyScope {
public:
    /// `builder` writes at the end of this level's block, which has no terminator yet.
    BodyScope(const Body& body, LoopLevel level, Builder& builder, Sources& sources,
              BodyScope* outer)
        : body_(body),
          level_(level),
          builder_(builder),
          sources_(sources),
          outer_(outer),
          values_(body.kernel.code.size()) {}

    const Body& body() const { return body_; }
    LoopLevel level() const { return level_; }
    Builder& builder() { return builder_; }
    Sources& sources() { return sources_; }

    void define(ValueId id, const Forms& forms) { values_[id] = forms; }
    Forms& forms(ValueId id) { return owner(id).values_[id]; }

    // A value in one of its forms.
    llvm::Value* number(ValueId id);
    llvm::Value* bits(ValueId id);
    llvm::Value* truth(ValueId id);

    /// A value as an operand of arithmetic, flushed where LLVM would not flush it.
    llvm::Value* operand(ValueId id);
    /// The same if the operation is the identity when `partner`, the other operand, is the constant
    /// `neutral` or minus that.
    llvm::Value* operand(ValueId id, ValueId partner, double neutral);
    /// A value as a flushed number, however LLVM transforms its uses.
    llvm::Value* flushed_number(ValueId id) {
        return forms(id).may_be_denormal ? flushed(id) : number(id);
    }
    /// A value as one branch of a choice. `other` is the other branch.
    llvm::Value* branch(ValueId id, ValueId other);

    /// The word of a value that is the same constant in all cells, also if only LLVM knows that.
    std::optional<std::uint64_t> constant_word(ValueId id);
    /// A constant that all of LLVM takes for a variable.
    llvm::Value* hidden(std::uint64_t word);

private:
    BodyScope& owner(ValueId id);
    llvm::Value* flushed(ValueId id);

    const Body& body_;
    LoopLevel level_;
    Builder& builder_;
    Sources& sources_;
    BodyScope* outer_;
    std::map<std::uint64_t, llvm::Value*> hidden_;  ///< By word; only in the outermost scope.
    IdVector<ValueId, Forms> values_;               ///< By value; only this level's.
};

}  // namespace cascade
