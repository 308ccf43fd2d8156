// Finds the slots of a kernel by the names of their contents.
#include "lang/lower/kernel_assembly.h"

#include "core/overloaded.h"

#include <fmt/format.h>

#include <utility>

namespace cascade::lowering {

std::string KernelAssembly::name_of(StageItem item) const {
    const std::string_view name = program_.system_of(item.stage).item_name(item.item);
    if (item.stage == stage_) return std::string(name);
    return fmt::format("{}.{}", program_.stages[item.stage].name, name);
}

/// The name of a source. No name in the language contains a dot or begins with a bracket, so the
/// names of different kinds of sources cannot be equal.
template <typename... Sources>
std::string KernelAssembly::name_of(const std::variant<Sources...>& source) const {
    const auto of = [](const auto& names, auto key) {
        return std::string(names[static_cast<std::size_t>(key)]);
    };
    const auto numbered = [](std::string_view kind, auto id) {
        return fmt::format("({} {})", kind, id.index());
    };
    const Overloaded name{
        [&](StageItem each) { return name_of(each); },
        [&](SensedItem each) { return name_of(each.item) + " (sensed)"; },
        [&](SweepInput each) {
            return fmt::format("{} (input {})", name_of(StageItem{stage_, each.item}), each.input);
        },
        [&](NamedPlane each) {
            // The name contains the unique index of the reading and not its arguments, because
            // these may be long.
            const std::string read = fmt::format("{}(\"{}\")", info(each.function).spelling,
                                                 program_.literals->text(each.text));
            return each.reading == 0 ? read : fmt::format("{} (reading {})", read, each.reading);
        },
        [&](SurfaceValueId id) {
            // The name contains the unique index of the value and not its numbers, because the list
            // of numbers may be long.
            const SurfaceValue& value = program_.literals->surface_value(id);
            return numbered(info(value.function).spelling, id);
        },
        [&](MetricPlane plane) { return of(metric_names, plane); },
        [&](Unknown each) {
            return program_.literals->constraint(each.number).unknown + " (unknown)";
        },
        [&](LagPart part) { return of(lag_part_names, part); },
        [&](ModelPlane plane) { return of(model_names, plane); },
        [&](Neighbourhood) { return std::string("(neighbourhood)"); },
        [&](StepInvariantId id) { return numbered("step-invariant", id); },
        [&](TemporaryId id) { return numbered("temporary", id); },
        [&](AggregateId id) { return numbered("aggregate", id); },
        [&](CoefficientId id) { return numbered("coefficient", id); },
        [&](TimeValue value) { return of(time_value_names, value); },
    };
    return std::visit(name, source);
}

FieldSlot KernelAssembly::field_slot(const PlaneSource& source) {
    const FieldSlot slot = builder_.field_slot(name_of(source));
    if (slot == bound_.fields.next()) bound_.fields.push_back(source);
    return slot;
}

ValueId KernelAssembly::field(const PlaneSource& source, Offset at) {
    return builder_.neighbour(field_slot(source), at.dx, at.dy, at.dz);
}

ValueId KernelAssembly::uniform(const UniformSource& source) {
    const UniformSlot slot = builder_.uniform_slot(name_of(source));
    if (slot == bound_.uniforms.next()) bound_.uniforms.push_back(source);
    return builder_.uniform(slot);
}

ValueId KernelAssembly::item(StageItem item, Offset at) {
    if (program_.stages[item.stage].uniform[item.item]) return uniform(item);
    const bool is_frozen = item == StageItem{stage_, system().frozen_item()};
    if (!is_frozen || !frozen_is_mask_) return field(item, at);
    const MaskSlot slot = builder_.mask_slot(name_of(item));
    if (slot == bound_.masks.next()) bound_.masks.push_back(item);
    return builder_.mask(slot);
}

/// The length of the step. It is the stage's speed, unless the time loop chooses the length.
ValueId KernelAssembly::time_step(Offset at) {
    const StageTime& time = stage().time;
    if (!time.has_duration() && !time.chooses_steps())
        return item({stage_, system().speed_item()}, at);
    return uniform(TimeValue::length);
}

/// The time. If the time is the same in all cells, the time loop provides it.
ValueId KernelAssembly::time(Offset at) {
    const ItemId speed = system().speed_item();
    if (stage().uniform[speed]) return uniform(TimeValue::time);
    return builder_.multiply(step(), time_step(at));
}

/// Tests whether the cell at an offset is inside the mask. The word (Neighbourhood) has a bit for
/// the cell itself and a bit for each neighbour, in the order of the offsets' numbers.
ValueId KernelAssembly::inside(Offset at) {
    const ValueId bit = builder_.word(only(at));
    const ValueId around = field(Neighbourhood{});
    return builder_.apply(Op::bits_to_number, builder_.apply(Op::bits_and, around, bit));
}

ValueId KernelAssembly::within_mask(ValueId value, float outside) {
    if (!context_.has_mask()) return value;
    return builder_.select(inside({}), value, builder_.number(outside));
}

BoundKernel KernelAssembly::finish() && {
    bound_.kernel = std::make_shared<const CellKernel>(std::move(builder_).finish());
    return std::move(bound_);
}

}  // namespace cascade::lowering
