// Lowering of formulas: the builder of one kernel with what its slots mean (internal to lowering).
#pragma once

#include "ir/builder.h"
#include "ir/space.h"
#include "lang/lower/lower.h"
#include "lang/lower/part_graph.h"
#include "lang/lower/pass_planner.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cascade::lowering {

/// A value of a formula: a number in the first place, or red, green and blue.
using Value = std::array<ValueId, 3>;

/// One kernel in the making. It computes over the cells of `stage`, whose items are read from slots
/// unless their values are set here.
class KernelAssembly {
public:
    KernelAssembly(const Program& program, std::uint32_t stage);

    KernelBuilder& builder() { return builder_; }
    const Program& program() const { return program_; }
    const System& system() const { return program_.system_of(stage_); }
    const Stage& stage() const { return program_.stages[stage_]; }

    void read_frozen_as_mask() { frozen_is_mask_ = true; }

    /// What is asked for from now on is what the cell at this offset has.
    void look_at(Offset offset) { at_ = offset; }

    /// The value of an item of any stage.
    ValueId item(std::uint32_t stage, std::uint32_t item);
    ValueId own_item(std::uint32_t index) { return item(stage_, index); }
    std::uint32_t field_slot(std::uint32_t stage, std::uint32_t item);
    /// Complete steps when the step begins.
    ValueId step();
    /// The length of the step that is taken.
    ValueId time_step();
    /// The time when rates are evaluated.
    ValueId time();
    /// A species in an input of a sweep, in the own cell. Formulas read input 0.
    ValueId input(std::uint32_t input, std::uint32_t item);
    ValueId coefficient(std::uint32_t index);
    std::uint32_t temporary_slot(std::uint32_t temporary);
    /// What the stage has computed once: a plane, or a number for all cells.
    std::uint32_t step_invariant_slot(std::uint32_t number);
    ValueId step_invariant_number(std::uint32_t number);
    ValueId aggregate(std::uint32_t index);
    ValueId beside(std::uint32_t slot) { return builder_.neighbour(slot, at_.dx, at_.dy, at_.dz); }
    /// Other than 0 where the cell at an offset is inside the mask.
    ValueId inside(Offset offset);
    /// The slot of a part that lies in a plane of its own: a species, a parameter, a file.
    std::uint32_t plane_slot(const PartGraph& graph, PartId id);

    /// A part and the values of its operands, where the assembly looks at.
    struct Cursor {
        const PartGraph& graph;
        const Part& part;
        const Noise& noise;
        std::array<Value, most_operands> values{};
        std::size_t occurrences = 0;  ///< Of random functions in its formula, up to the part.

        ValueId number(const Node&, std::size_t operand) const { return values[operand][0]; }
        const Node& operand(std::size_t k) const { return graph[part.operands[k]].node; }
    };
    /// The value of a part that is no operator and no vector; of a colour all three channels.
    Value part(const Cursor& cursor);

    void result(const std::string& name, ValueId value) { builder_.result(name, value); }
    BoundKernel finish(std::vector<std::uint32_t> results) &&;

private:
    std::string slot_name(std::uint32_t stage, std::uint32_t item) const;
    std::uint32_t input_slot(std::uint32_t input, std::uint32_t item);
    std::uint32_t file_slot(Function function, std::uint32_t text);
    std::uint32_t surface_value_slot(std::uint32_t number);
    std::uint32_t metric_slot(std::uint32_t plane);
    std::uint32_t model_slot(ModelPlane plane);
    ValueId of_model(ModelPlane plane);
    ValueId cell_content();
    ValueId wrapped(ValueId cell, int by, std::int64_t count, Boundary boundary);
    ValueId column();
    ValueId row();
    ValueId slice();
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
    ValueId elementary(Function function, ValueId a, ValueId b, ValueId c);
    Value palette(const Node& node, const Cursor& cursor);

    const Program& program_;
    std::uint32_t stage_;
    KernelBuilder builder_;
    BoundKernel bound_;
    std::map<std::pair<std::uint32_t, Builtin>, ValueId> builtins_;  ///< By offset; those read.
    Offset at_;
    bool frozen_is_mask_ = false;
};

/// The key of one occurrence of a random function: FNV-1a of the seed, the stage, the formula's
/// origin and the number of the occurrence in it, each written as text and ended by a line feed.
std::uint64_t random_key(std::uint32_t seed, std::string_view stage, std::string_view origin,
                         std::size_t occurrence);

}  // namespace cascade::lowering
