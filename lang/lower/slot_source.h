// Where the values of a kernel's slots come from.
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

using StepInvariantId = Id<struct StepInvariantTag>;  ///< A result of plan_step_invariants.
using CoefficientId = Id<struct CoefficientTag>;      ///< A coefficient of a sweep.

/// A species in an input of a sweep other than the first, which holds the items of the stage.
struct SweepInput {
    std::uint32_t input = 0;
    ItemId item;
    bool operator==(const SweepInput&) const = default;
};

/// What a function such as `field` reads by a name.
struct NamedPlane {
    Function function = Function::field;
    TextId text;
    std::uint32_t reading = 0;  ///< The number of a FileReading in Literals.
    auto operator<=>(const NamedPlane&) const = default;
};

/// Which of the cells around are inside the mask, as words.
struct Neighbourhood {
    bool operator==(const Neighbourhood&) const = default;
};

/// What the time loop knows when it evaluates rates.
enum class TimeValue : std::uint8_t {
    step,    ///< Complete steps of the stage when the step begins.
    draw,    ///< The number of that step as a word for draws (ir/draw_of_step.h).
    time,    ///< The stage's t.
    length,  ///< How long the step is.
};
inline constexpr std::array<std::string_view, 4> time_value_names{"step", "draw", "t", "time step"};

/// Of a field slot.
using PlaneSource =
    std::variant<StageItem, SensedItem, SweepInput, NamedPlane, SurfaceValueId, MetricPlane,
                 ModelPlane, Neighbourhood, LagPart, Unknown, StepInvariantId, TemporaryId>;
/// Of a uniform slot.
using UniformSource =
    std::variant<StageItem, StepInvariantId, AggregateId, TimeValue, CoefficientId>;

}  // namespace cascade
