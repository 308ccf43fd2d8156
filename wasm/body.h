// Translates every operation of ir/operations.def to WebAssembly's instructions.
//
// Internal to wasm/. Each operation on words and numbers has the same result as in the interpreter
// (ir/word_operations.h), bit for bit, also with denormal numbers.
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

    /// Writes the code of the values of a loop level. Must be called for each level, outer levels
    /// first. The level of cells needs one call for each vector of the group, and every other level
    /// needs one call. The calls for cells also write the stores of results.
    void write(LoopLevel level);

private:
    /// A value in up to three forms. Each form is made when it is first needed.
    struct Value {
        std::optional<Local> number;   ///< The word, unchanged.
        std::optional<Local> operand;  ///< The word, flushed. Only in exact kernels.
        std::optional<Local> truth;    ///< For each lane, all bits set or all clear.
        bool is_boolean = false;       ///< The value was computed as `truth`.
        bool is_of_source = false;     ///< `number` is a local that Cells owns.
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

    // Return a local with one form of the value. Its code is written at the value's own loop level.
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
    /// Pushes the operands, as numbers, as words or as truths, and writes an instruction.
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
    IdVector<ValueId, int> readers_;  ///< The number of instructions that read each value.
    /// The number of reads of each value that have yet to be written in the present vector.
    IdVector<ValueId, int> readers_to_come_;
    /// The values of cells that the present loop over links reads.
    std::vector<ValueId> read_in_loop_;
    IdVector<ValueId, Value> values_;
    LoopLevel level_ = LoopLevel::call;  ///< The level that is being written.
};

}  // namespace cascade::wasm
