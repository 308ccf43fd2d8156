// Assembles one kernel and records where the values of its slots come from (internal to lowering).
#pragma once

#include "ir/builder.h"
#include "lang/lower/pass_planner.h"
#include "lang/lower/step_plan.h"

#include <string>

namespace cascade::lowering {

/// The kernel computes the cells of a stage.
class KernelAssembly {
public:
    /// If `frozen` varies, it is read as a mask, or as a plane like other items.
    KernelAssembly(const PassContext& context, bool frozen_is_mask, EqualProducts products)
        : context_(context),
          program_(context.program),
          stage_(context.stage),
          builder_(program_.domain.precision, products),
          frozen_is_mask_(frozen_is_mask) {}

    KernelBuilder& builder() { return builder_; }
    const PassContext& context() const { return context_; }
    const Program& program() const { return program_; }
    const System& system() const { return program_.system_of(stage_); }
    const Stage& stage() const { return program_.stages[stage_]; }

    FieldSlot field_slot(const PlaneSource& source);
    /// The value of a plane in the cell at an offset.
    ValueId field(const PlaneSource& source, Offset at = {});
    ValueId uniform(const UniformSource& source);

    /// The value of an item of any stage, and of one of this stage.
    ValueId item(StageItem item, Offset at = {});
    ValueId item(ItemId item) { return this->item({stage_, item}); }
    /// Complete steps when the step begins.
    ValueId step() { return uniform(TimeValue::step); }
    /// The number of that step as a word for draws.
    ValueId draw_word() { return builder_.draw_word(uniform(TimeValue::draw)); }
    /// The length of the current step.
    ValueId time_step(Offset at);
    /// The time when rates are evaluated.
    ValueId time(Offset at);
    /// Not 0 if the cell at an offset is inside the mask.
    ValueId inside(Offset at);
    /// A value inside the mask, and another one outside of it.
    ValueId within_mask(ValueId value, float outside);

    BoundKernel finish() &&;

private:
    std::string name_of(StageItem item) const;
    template <typename... Sources>
    std::string name_of(const std::variant<Sources...>& source) const;

    PassContext context_;
    const Program& program_;
    std::uint32_t stage_;
    KernelBuilder builder_;
    BoundKernel bound_;
    bool frozen_is_mask_;
};

}  // namespace cascade::lowering
