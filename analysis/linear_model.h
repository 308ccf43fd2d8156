// The rates of a stage about a flat state, in which all cells have the same values: what they are
// there, and how they change with a wave that is added.
//
// A flat state has no derivatives, so every operator is linear about it: its effect on a wave is
// its symbol. The formulas of the rates are walked once, operands first; each part becomes its flat
// value and, for each species, a sum of products of operators with coefficients. So the Jacobian of
// a wave is Σ symbol · matrix, where the matrices are formulas of the species and do not depend on
// the wave.
#pragma once

#include "analysis/start_values.h"
#include "analysis/wave_operators.h"
#include "core/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade::analysis {

/// A matrix of the Jacobian.
struct JacobianTerm {
    OperatorProduct operators;
    std::vector<NodeId> entries;  ///< By rate and then by species: rate · species_count + species.
};

struct LinearModel {
    const Program* program = nullptr;
    std::uint32_t stage = 0;
    Algebra algebra;  ///< Of all formulas below. They read species and items of `varied` alone.
    std::vector<ItemId> species;
    std::vector<ItemId> varied;
    IdVector<ItemId, StartValue> starts;
    std::vector<NodeId> rates;        ///< By species.
    std::vector<JacobianTerm> terms;  ///< The first is that of the value itself.
    std::vector<ItemId> parameters;   ///< That rates read, in order of writing.
    bool reads_time = false;          ///< `t` counts as 0.
    bool has_noise = false;           ///< Do rates draw random numbers? These count as their mean.

    std::size_t species_count() const { return species.size(); }
    const System& system() const { return program->system_of(stage); }
};

/// Fails, and says why, if a flat state makes no sense or a part of the rates has no derivative.
/// The items of `varied` are parameters that are the same in all cells. The program must outlive
/// the model.
Result<LinearModel> linear_model(const Program& program, std::uint32_t stage,
                                 std::span<const ItemId> varied = {});

}  // namespace cascade::analysis
