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

/// The index of a result of plan_step_invariants().
using StepInvariantId = Id<struct StepInvariantTag>;
using CoefficientId = Id<struct CoefficientTag>;  ///< The index of a coefficient of a sweep.

/// A species in one of a sweep's inputs, which is not input 0. Input 0 contains the items of the
/// stage.
struct SweepInput {
    std::uint32_t input = 0;
    ItemId item;
    bool operator==(const SweepInput&) const = default;
};

/// A plane that a function such as `field` reads and that a text in the script names.
struct NamedPlane {
    Function function = Function::field;
    TextId text;
    std::uint32_t reading = 0;  ///< The index of the FileReading in Literals.
    auto operator<=>(const NamedPlane&) const = default;
};

/// A plane of words. Each bit of a word says whether one neighbouring cell is inside the mask.
struct Neighbourhood {
    bool operator==(const Neighbourhood&) const = default;
};

/// Numbers that the time loop provides when it evaluates rates.
enum class TimeValue : std::uint8_t {
    step,    ///< The number of steps that the stage completed before this step.
    draw,    ///< The word by which random numbers depend on the step (ir/draw_of_step.h).
    time,    ///< The time t of the stage.
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
