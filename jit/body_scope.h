// The values of a kernel's body, and LLVM's instructions for them.
//
// Internal to jit/. Scopes are nested like loops. So a value that is the same in all cells, or in
// all cells of a row, is computed outside the inner loops, and no LLVM pass has to move its code.
#pragma once

#include "jit/kernel_shape.h"
#include "jit/kernel_sources.h"

#include <map>
#include <optional>
#include <vector>

namespace cascade {

/// The LLVM types of a kernel's numbers and of its words.
inline llvm::Type* number_type(llvm::IRBuilderBase& builder, Precision precision) {
    return precision == Precision::single ? builder.getFloatTy() : builder.getDoubleTy();
}
inline llvm::Type* word_type(llvm::IRBuilderBase& builder, Precision precision) {
    return builder.getIntNTy(static_cast<unsigned>(format_of(precision).bits));
}
/// A word as an LLVM constant.
llvm::APFloat number_constant(std::uint64_t word, Precision precision);

/// Facts that all scopes of a kernel share.
struct Body {
    const CellKernel& kernel;
    const KernelShape& shape;
    WordFormat format;
    IdVector<ValueId, LoopLevel> levels;  ///< The level of each value.
    llvm::VectorType* number_type;        ///< <N x float>
    llvm::VectorType* bits_type;          ///< <N x i32>

    /// A constant word in all lanes, as numbers or as bits.
    llvm::Constant* number(std::uint64_t word) const;
    llvm::Constant* bits(std::uint64_t word) const;
};

/// The result refers to `kernel` and `shape`.
Body body_of(const CellKernel& kernel, const KernelShape& shape, Builder& builder);

/// One value in up to three forms. A form is made when it is first requested.
struct Forms {
    llvm::Value* number = nullptr;  ///< <N x float>
    llvm::Value* bits = nullptr;    ///< <N x i32>
    llvm::Value* truth = nullptr;   ///< <N x i1>
    bool is_boolean = false;        ///< The value is 1 or 0, as `truth` says.
    bool may_be_denormal = false;
    bool is_choice = false;  ///< A constant, or a choice among constants only.
    /// In some context, such as a branch of a choice, LLVM may find out that the value is a
    /// constant.
    bool may_be_neutral = false;
};

/// The values of one loop level. Values of outer levels are looked up in the enclosing scopes,
/// which must outlive this one.
class BodyScope {
public:
    /// `builder` writes at the end of this level's block, which must not have a terminator yet.
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

    // Return a value in one of its forms.
    llvm::Value* number(ValueId id);
    llvm::Value* bits(ValueId id);
    llvm::Value* truth(ValueId id);

    /// Returns a value as an operand of arithmetic, flushed if LLVM might not flush it in the
    /// operation.
    llvm::Value* operand(ValueId id);
    /// Returns a value as an operand of an operation that leaves the value unchanged if `partner`,
    /// the other operand, is `neutral` or −`neutral`. Flushes the value if LLVM might drop such an
    /// operation.
    llvm::Value* operand(ValueId id, ValueId partner, double neutral);
    /// Returns a value as a flushed number. LLVM cannot undo the flushing.
    llvm::Value* flushed_number(ValueId id) {
        return forms(id).may_be_denormal ? flushed(id) : number(id);
    }
    /// Returns a value for use as one branch of a choice whose other branch is `other`.
    llvm::Value* branch(ValueId id, ValueId other);

    /// The word of a value that is the same constant in all cells, including values that LLVM has
    /// found to be constants.
    std::optional<std::uint64_t> constant_word(ValueId id);
    /// A constant that LLVM treats as a variable in all its passes.
    llvm::Value* hidden(std::uint64_t word);

private:
    BodyScope& owner(ValueId id);
    llvm::Value* flushed(ValueId id);

    const Body& body_;
    LoopLevel level_;
    Builder& builder_;
    Sources& sources_;
    BodyScope* outer_;
    /// The variable for each word. Used only in the outermost scope.
    std::map<std::uint64_t, llvm::Value*> hidden_;
    IdVector<ValueId, Forms> values_;  ///< The forms of each value of this level.
};

}  // namespace cascade
