// Finds slots by names of their contents.
#include "lang/lower/kernel_assembly.h"

#include "core/check.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

SlotSource::Kind slot_of_text(Function function) {
    switch (function) {
        case Function::image: return SlotSource::Kind::image;
        case Function::attr: return SlotSource::Kind::attribute;
        case Function::uvimage: return SlotSource::Kind::texture;
        default: return SlotSource::Kind::file;
    }
}

}  // namespace cascade

namespace cascade::lowering {

/// No name of the language contains a dot or begins with a bracket, so different kinds of names
/// cannot collide.
std::string KernelAssembly::name_of(const SlotSource& source) const {
    using Kind = SlotSource::Kind;
    const auto item_name = [&](std::uint32_t stage) {
        const std::string_view name = program_.system_of(stage).item_name(source.item);
        if (stage == stage_) return std::string(name);
        return fmt::format("{}.{}", program_.stages[stage].name, name);
    };
    const auto of_text = [&](Function function) {
        return fmt::format("{}(\"{}\")", info(function).spelling,
                           program_.literals->texts()[source.item]);
    };
    switch (source.kind) {
        case Kind::item: return item_name(source.stage);
        case Kind::file: return of_text(Function::field);
        case Kind::image: return of_text(Function::image);
        case Kind::attribute: return of_text(Function::attr);
        case Kind::texture: return of_text(Function::uvimage);
        case Kind::surface_value: {
            // A long list of numbers would not fit into a name; this one is just as distinct.
            const SurfaceValue& value = program_.literals->surface_values()[source.item];
            return fmt::format("({} {})", info(value.function).spelling, source.item);
        }
        case Kind::metric: return std::string(metric_names[source.item]);
        case Kind::model: return std::string(model_names[source.item]);
        case Kind::neighbourhood: return "(neighbourhood)";
        case Kind::step_invariant: return fmt::format("(step-invariant {})", source.item);
        case Kind::step: return "step";
        case Kind::draw: return "draw";
        case Kind::time: return "t";
        case Kind::time_step: return "time step";
        case Kind::temporary: return fmt::format("(temporary {})", source.item);
        case Kind::aggregate: return fmt::format("(aggregate {})", source.item);
        case Kind::input: return fmt::format("{} (input {})", item_name(stage_), source.stage);
        case Kind::coefficient: return fmt::format("(coefficient {})", source.item);
    }
    CHECK(false, "lowering: every slot has a name");
}

std::uint32_t KernelAssembly::field_slot(const SlotSource& source) {
    const std::uint32_t slot = builder_.field_slot(name_of(source));
    if (slot == bound_.fields.size()) bound_.fields.push_back(source);
    return slot;
}

ValueId KernelAssembly::field(const SlotSource& source, Offset at) {
    return builder_.neighbour(field_slot(source), at.dx, at.dy, at.dz);
}

ValueId KernelAssembly::uniform(const SlotSource& source) {
    const std::uint32_t slot = builder_.uniform_slot(name_of(source));
    if (slot == bound_.uniforms.size()) bound_.uniforms.push_back(source);
    return builder_.uniform(slot);
}

ValueId KernelAssembly::item(std::uint32_t stage, std::uint32_t item, Offset at) {
    const SlotSource source{SlotSource::Kind::item, stage, item};
    if (program_.stages[stage].uniform[item]) return uniform(source);
    const bool is_frozen = stage == stage_ && item == system().frozen_item();
    if (!is_frozen || !frozen_is_mask_) return field(source, at);
    const std::uint32_t slot = builder_.mask_slot(name_of(source));
    if (slot == bound_.masks.size()) bound_.masks.push_back(source);
    return builder_.mask(slot);
}

/// The stage's speed, unless the time loop chooses the length of steps.
ValueId KernelAssembly::time_step(Offset at) {
    const StageTime& time = stage().time;
    if (!time.has_duration() && !time.chooses_steps())
        return item(stage_, system().speed_item(), at);
    return uniform({SlotSource::Kind::time_step, stage_, 0});
}

/// A time that is the same in all cells comes from the time loop.
ValueId KernelAssembly::time(Offset at) {
    const std::uint32_t speed = system().speed_item();
    if (stage().uniform[speed]) return uniform({SlotSource::Kind::time, stage_, 0});
    return builder_.multiply(step(), time_step(at));
}

/// A word has one bit for each of the cells around and for the cell itself, by their offsets.
ValueId KernelAssembly::inside(Offset at) {
    const ValueId bit = builder_.word(only(at));
    const ValueId around = field({SlotSource::Kind::neighbourhood, 0, 0});
    return builder_.apply(Op::bits_to_number, builder_.apply(Op::bits_and, around, bit));
}

ValueId KernelAssembly::within_mask(ValueId value, float outside) {
    if (!program_.domain.mask) return value;
    return builder_.select(inside({}), value, builder_.number(outside));
}

BoundKernel KernelAssembly::finish() && {
    bound_.kernel = std::move(builder_).finish();
    return std::move(bound_);
}

}  // namespace cascade::lowering
