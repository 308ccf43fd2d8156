// Assembles a kernel, and records from which sources its slots get their values (internal to
// lowering).
#pragma once

#include "ir/builder.h"
#include "lang/lower/pass_planner.h"
#include "lang/lower/step_plan.h"

#include <string>

namespace cascade::lowering {

/// Assembles a kernel for the cells of a stage.
class KernelAssembly {
public:
    /// If `frozen` varies by cell, it is read as a mask if `frozen_is_mask` is true. Otherwise it
    /// is read as a plane of numbers like other items.
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

    /// The value of an item: of any stage (StageItem), or of this stage (ItemId).
    ValueId item(StageItem item, Offset at = {});
    ValueId item(ItemId item) { return this->item({stage_, item}); }
    /// The number of steps that were completed before the current step.
    ValueId step() { return uniform(TimeValue::step); }
    /// The word by which random numbers depend on the current step.
    ValueId draw_word() { return builder_.draw_word(uniform(TimeValue::draw)); }
    /// The length of the current step.
    ValueId time_step(Offset at);
    /// The time at which rates are evaluated.
    ValueId time(Offset at);
    /// A number other than 0 if the cell at an offset is inside the mask, else 0.
    ValueId inside(Offset at);
    /// `value` inside the mask, and `outside` elsewhere.
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
