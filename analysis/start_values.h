// The starting values of a stage as numbers instead of planes: the mean of random numbers, and
// their standard deviation.
#pragma once

#include "lang/calculus/algebra.h"
#include "lang/program/program.h"

#include <cstdint>
#include <span>

namespace cascade::analysis {

/// The start of an item. Random numbers count as their mean, noise and shapes as 0, and positions
/// as the middle of the domain.
struct StartValue {
    NodeId value;
    /// The standard deviation due to random numbers, to first order.
    NodeId scatter;
    /// Whether it differs between positions other than by random numbers.
    bool differs = false;
    /// Whether it comes from a file, so that `value` means nothing.
    bool is_unknown = false;
};

/// One for each item of the stage. Items of `varied` stay items. All others become numbers or
/// formulas of these.
IdVector<ItemId, StartValue> start_values(Algebra& algebra, const Program& program,
                                          std::uint32_t stage, std::span<const ItemId> varied);

/// The start of a formula in the rates of a stage, from its start_values() in the same algebra.
StartValue start_value(Algebra& algebra, const Program& program, const Formula& formula,
                       const IdVector<ItemId, StartValue>& starts);

}  // namespace cascade::analysis
