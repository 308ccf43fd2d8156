// The starting values of a stage as numbers instead of planes: their means over random numbers, and
// their standard deviations.
#pragma once

#include "lang/calculus/algebra.h"
#include "lang/program/program.h"

#include <cstdint>
#include <span>

namespace cascade::analysis {

/// The starting value of an item. Random numbers count as their mean, noise and shapes as 0, and
/// positions as the middle of the domain.
struct StartValue {
    NodeId value;
    /// The standard deviation of the value due to random numbers, to first order.
    NodeId scatter;
    /// Whether the value depends on the position, apart from random numbers.
    bool differs = false;
    /// Whether the value comes from a file, so that `value` means nothing.
    bool is_unknown = false;
};

/// The starting value of each item of the stage. Items of `varied` remain items. All others become
/// numbers or formulas of these items.
IdVector<ItemId, StartValue> start_values(Algebra& algebra, const Program& program,
                                          std::uint32_t stage, std::span<const ItemId> varied);

/// The starting value of a formula in the rates of a stage. `starts` are start_values() in the same
/// algebra.
StartValue start_value(Algebra& algebra, const Program& program, const Formula& formula,
                       const IdVector<ItemId, StartValue>& starts);

}  // namespace cascade::analysis
