// Lowering of formulas: the builder of one kernel with what its slots mean (internal to lowering).
#pragma once

#include "ir/builder.h"
#include "ir/space.h"
#include "lang/lower.h"

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace cascade::lowering {

/// A value of a formula: a number in the first place, or red, green and blue.
using Value = std::array<ValueId, 3>;

/// Where the random numbers of a formula come from.
struct Noise {
    std::string origin;       ///< The item's or definition's name, or a species' with a prime.
    bool every_step = false;  ///< New numbers in each step.
};

/// One kernel in the making. It computes over the cells of `stage`, whose items are read from slots
/// unless their values are set here.
class KernelAssembly {
public:
    KernelAssembly(const Program& program, std::uint32_t stage);

    KernelBuilder& builder() { return builder_; }
    const Program& program() const { return program_; }
    const System& system() const { return program_.system_of(stage_); }
    const Stage& stage() const { return program_.stages[stage_]; }

    // What formulas may read besides slots. The frozen cells of a step are a mask, not a field.
    void set_own(std::uint32_t item, ValueId value) { own_[item] = value; }
    void set_definition(std::uint32_t index, ValueId value) { definitions_[index] = value; }
    void set_rate(std::uint32_t item, ValueId value) { rates_[item] = value; }
    void read_frozen_as_mask() { frozen_is_mask_ = true; }

    /// The value of an item of any stage.
    ValueId item(std::uint32_t stage, std::uint32_t item);
    ValueId own_item(std::uint32_t index) { return item(stage_, index); }
    std::uint32_t field_slot(std::uint32_t stage, std::uint32_t item);
    /// Complete steps when the step begins.
    ValueId step();
    /// The length of the step that is taken.
    ValueId time_step();
    /// The value of a formula; of a colour the first channel, with all three in `colour`.
    ValueId formula(const Formula& formula, const Noise& noise, Value* colour = nullptr);

    void result(const std::string& name, ValueId value) { builder_.result(name, value); }
    BoundKernel finish(std::vector<std::uint32_t> results) &&;

private:
    /// A formula while it is lowered: the values of the parts so far.
    struct Cursor {
        const Formula& formula;
        const Noise& noise;
        std::vector<Value> values;
        std::size_t occurrences = 0;  ///< Of random functions, up to the present part.

        ValueId number(const Node& node, std::size_t operand) const {
            return values[node.operands[operand]][0];
        }
    };

    std::string slot_name(std::uint32_t stage, std::uint32_t item) const;
    ValueId file(std::uint32_t text);
    ValueId mask(std::uint32_t item);
    ValueId uniform(const std::string& name, const SlotSource& source);
    ValueId builtin(Builtin builtin);
    ValueId make_builtin(Builtin builtin);
    ValueId coordinate(ValueId cell, std::int64_t side);
    Space space();
    ValueId shape(const Node& node, const Cursor& cursor);
    ValueId random(const Node& node, const Cursor& cursor);
    ValueId draw_of_cell(ValueId draw);
    ValueId white(ValueId strength, const Draw& draw);
    Value call(const Node& node, const Cursor& cursor);
    Value colour_call(const Node& node, const Cursor& cursor);
    ValueId operation(Function function, ValueId a, ValueId b);
    ValueId elementary(Function function, ValueId a);
    Value palette(const Node& node, const Cursor& cursor);

    const Program& program_;
    std::uint32_t stage_;
    KernelBuilder builder_;
    BoundKernel bound_;
    std::unordered_map<std::uint32_t, ValueId> own_, definitions_, rates_;
    std::array<std::optional<ValueId>, 8> builtins_;  ///< Those that were read already.
    bool frozen_is_mask_ = false;
};

/// The key of one occurrence of a random function: FNV-1a of the seed, the stage, the formula's origin and
/// the number of the occurrence in it, each written as text and ended by a line feed.
std::uint64_t random_key(std::uint32_t seed, std::string_view stage, std::string_view origin,
                         std::size_t occurrence);

}  // namespace cascade::lowering
