// The sources from which the slots of a kernel get their values.
#pragma once

#include "core/id.h"
#include "ir/sweep_form.h"
#include "lang/program/program.h"

#include <array>
#include <compare>
#include <cstdint>
#include <string_view>
#include <variant>

namespace cascade {

using StepInvariantId = Id<struct StepInvariantTag>;  ///< A result of plan_step_invariants().
using CoefficientId = Id<struct CoefficientTag>;      ///< A coefficient of a sweep.

/// A species in an input of a sweep other than input 0. Input 0 contains the items of the stage.
struct SweepInput {
    std::uint32_t input = 0;
    ItemId item;
    bool operator==(const SweepInput&) const = default;
};

/// A plane that a function such as `field` reads by a name.
struct NamedPlane {
    Function function = Function::field;
    TextId text;
    std::uint32_t reading = 0;  ///< The index of a FileReading in Literals.
    auto operator<=>(const NamedPlane&) const = default;
};

/// Words whose bits mark the neighbouring cells that are inside the mask.
struct Neighbourhood {
    bool operator==(const Neighbourhood&) const = default;
};

/// Numbers that the time loop provides when it evaluates rates.
enum class TimeValue : std::uint8_t {
    step,    ///< The number of steps that the stage completed before this step.
    draw,    ///< The word that identifies the step in random numbers (ir/draw_of_step.h).
    time,    ///< The stage's t.
    length,  ///< The length of the step.
};
inline constexpr std::array<std::string_view, 4> time_value_names{"step", "draw", "t", "time step"};

/// The source of a field slot.
using PlaneSource =
    std::variant<StageItem, SensedItem, SweepInput, NamedPlane, SurfaceValueId, MetricPlane,
                 ModelPlane, Neighbourhood, LagPart, Unknown, StepInvariantId, TemporaryId>;
/// The source of a uniform slot.
using UniformSource =
    std::variant<StageItem, StepInvariantId, AggregateId, TimeValue, CoefficientId>;

}  // namespace cascade
