// The meaning of every operation of ir/operations.def in WebAssembly's instructions.
//
// Internal to wasm/. Operations on words and numbers match the interpreter's
// (ir/word_operations.h), one by one, so that both have the same bits with denormal numbers, too.
#pragma once

#include "ir/kernel_parts.h"
#include "wasm/cells.h"

#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace cascade::wasm {

class Body {
public:
    Body(const KernelPart& part, Function& function, Cells& cells, bool is_exact);

    /// Writes the values of a loop level, outer levels first. Cells' values are written once for
    /// each vector, with the stores of results.
    void write(LoopLevel level);

private:
    /// A value in up to three forms, made when needed.
    struct Value {
        std::optional<Local> number;   ///< The word as it is.
        std::optional<Local> operand;  ///< The same, flushed. Only in exact kernels.
        std::optional<Local> truth;    ///< All bits of a lane are set or clear.
        bool is_boolean = false;       ///< It was computed as truth.
        bool is_of_source = false;     ///< The local of the first form belongs to the source.
        bool may_be_denormal = false;
    };

    bool is_bound(const Instruction& instruction) const;
    std::span<const ValueId> operands_of(const Instruction& instruction) const;
    void define(ValueId id);
    void write_loop(const LinkLoop& loop);
    Local beginning_of(Op op);
    void reduce(ValueId id);
    void store(std::size_t result);
    void release(ValueId id);
    void give_back(ValueId id);

    // The forms of a value, made at the value's own loop level.
    Local number(ValueId id);
    Local operand(ValueId id);
    Local truth(ValueId id);

    Value value_of(const Instruction& instruction);
    std::optional<Local> source(const Instruction& instruction);
    void push(const Instruction& instruction);
    void push_operands(ValueId a, ValueId b) {
        code().get(operand(a));
        code().get(operand(b));
    }
    /// Pushes an instruction on operands as numbers, as words or as truths.
    void push_numbers(Lanes instruction, std::initializer_list<ValueId> operands) {
        for (const ValueId id : operands) code().get(operand(id));
        code().write(instruction);
    }
    template <typename Vector>
    void push_words(Vector instruction, std::initializer_list<ValueId> operands) {
        for (const ValueId id : operands) code().get(number(id));
        code().write(instruction);
    }
    void push_truths(Whole instruction, std::initializer_list<ValueId> operands) {
        for (const ValueId id : operands) code().get(truth(id));
        code().write(instruction);
    }
    void push_choice(const Instruction& instruction);
    void push_scaled(ValueId a, ValueId b);
    void push_shift(Lanes shift, int amount);
    void push_shifted(const Instruction& instruction);
    void push_converted(ValueId a);

    Code& code() { return function_.at(level_); }
    Arithmetic arithmetic() { return {function_, level_, is_exact_}; }
    Local keep() { return function_.keep(level_); }

    const KernelPart& part_;
    const CellKernel& kernel_;
    Function& function_;
    Cells& cells_;
    bool is_exact_;
    IdVector<ValueId, LoopLevel> levels_;
    CellSchedule schedule_;
    IdVector<ValueId, int> readers_;          ///< In the kernel.
    IdVector<ValueId, int> readers_to_come_;  ///< In the vector that is being written.
    std::vector<ValueId> read_in_loop_;       ///< Values of cells.
    IdVector<ValueId, Value> values_;
    LoopLevel level_ = LoopLevel::call;  ///< The level being written.
};

}  // namespace cascade::wasm
