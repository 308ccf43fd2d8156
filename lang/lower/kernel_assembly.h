// One kernel in the making, whose slots say where their values come from (internal to lowering).
#pragma once

#include "ir/builder.h"
#include "lang/lower/pass_planner.h"
#include "lang/lower/step_plan.h"

#include <string>

namespace cascade::lowering {

/// The kernel computes over the cells of a stage.
class KernelAssembly {
public:
    /// Where `frozen` varies it is read as a mask, or as a plane like other items.
    KernelAssembly(const Program& program, std::uint32_t stage, bool frozen_is_mask)
        : program_(program),
          stage_(stage),
          builder_(program.domain.precision),
          frozen_is_mask_(frozen_is_mask) {}

    KernelBuilder& builder() { return builder_; }
    const Program& program() const { return program_; }
    const System& system() const { return program_.system_of(stage_); }
    const Stage& stage() const { return program_.stages[stage_]; }

    std::uint32_t field_slot(const SlotSource& source);
    /// What the cell at an offset has in a plane.
    ValueId field(const SlotSource& source, Offset at = {});
    ValueId uniform(const SlotSource& source);

    /// The value of an item of any stage, and of this one.
    ValueId item(std::uint32_t stage, std::uint32_t item, Offset at = {});
    ValueId item(std::uint32_t item) { return this->item(stage_, item); }
    /// Complete steps when the step begins.
    ValueId step() { return uniform({SlotSource::Kind::step, stage_, 0}); }
    /// The word of that step in draws.
    ValueId draw_word() { return builder_.draw_word(uniform({SlotSource::Kind::draw, stage_, 0})); }
    /// The length of the step that is taken.
    ValueId time_step(Offset at);
    /// The time when rates are evaluated.
    ValueId time(Offset at);
    /// Other than 0 where the cell at an offset is inside the mask.
    ValueId inside(Offset at);
    /// A value inside the mask, and what is said outside of it.
    ValueId within_mask(ValueId value, float outside);

    BoundKernel finish() &&;

private:
    std::string name_of(const SlotSource& source) const;

    const Program& program_;
    std::uint32_t stage_;
    KernelBuilder builder_;
    BoundKernel bound_;
    bool frozen_is_mask_;
};

}  // namespace cascade::lowering
