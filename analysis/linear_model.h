// The rates of a stage about a flat state, in which all cells have the same values: what they are
// there, and how they change with a wave that is added.
//
// A flat state has no derivatives, so every operator is linear about it: its effect on a wave is
// its symbol. The formulas of the rates are walked once, operands first; each part becomes its flat
// value and, for each variable, a sum of products of operators with coefficients. So the Jacobian
// of a wave is Σ symbol · matrix, where the matrices are formulas of the species and do not depend
// on the wave.
//
// The fields of constraints `0 = e` are variables beside the species, and each e is a rate that is
// always 0. LocalRates eliminates them.
#pragma once

#include "analysis/start_values.h"
#include "analysis/wave_operators.h"
#include "core/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade::analysis {

/// A matrix of the Jacobian.
struct JacobianTerm {
    OperatorProduct operators;
    std::vector<NodeId>
        entries;  ///< By rate and then by variable: rate · variable_count + variable.
};

/// The kernel of a convolution, as formulas.
struct KernelFormula {
    std::uint32_t literal = 0;    ///< Its number in Literals.
    NodeId weight;                ///< Reads parts of lags and items of `varied`.
    std::optional<NodeId> reach;  ///< Reads items of `varied`; nothing: the whole domain.
    /// What stands for the sum of its weights in formulas of the model. No item of the stage has
    /// this number.
    ItemId sum;
};

struct LinearModel {
    const Program* program = nullptr;
    std::uint32_t stage = 0;
    /// Of all formulas below. They read species, items of `varied`, sums of kernels and unknowns.
    Algebra algebra;
    std::vector<ItemId> species;
    std::vector<Unknown> unknowns;  ///< The fields of constraints, each after those that it needs.
    std::vector<ItemId> varied;
    std::vector<KernelFormula> kernels;  ///< By the number that operators give for them.
    IdVector<ItemId, StartValue> starts;
    std::vector<NodeId> rates;        ///< By species, then those of constraints.
    std::vector<JacobianTerm> terms;  ///< The first is that of the value itself.
    std::vector<ItemId> parameters;   ///< That rates read, in order of writing.
    bool reads_time = false;          ///< `t` counts as 0.
    bool has_noise = false;           ///< Do rates draw random numbers? These count as their mean.

    std::size_t species_count() const { return species.size(); }
    std::size_t variable_count() const { return species.size() + unknowns.size(); }
    bool has_nonlocal_parts() const { return !unknowns.empty() || !kernels.empty(); }
    /// All that values of parameters reach the model by.
    std::vector<NodeId> formulas() const;
    const System& system() const { return program->system_of(stage); }
};

/// Fails, and says why, if a flat state makes no sense or a part of the rates has no derivative.
/// The items of `varied` are parameters that are the same in all cells. The program must outlive
/// the model.
Result<LinearModel> linear_model(const Program& program, std::uint32_t stage,
                                 std::span<const ItemId> varied = {});

}  // namespace cascade::analysis
