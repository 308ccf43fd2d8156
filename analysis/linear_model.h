// The rates of a stage about a flat state, in which all cells have the same values: their values
// there, and their response to an added wave.
//
// A flat state has no derivatives, so every operator is linear about it: its effect on a wave is
// its symbol. A single walk over the formulas of the rates, operands first, turns each part into
// its flat value and, for each variable, a sum of products of operators with coefficients. So the
// Jacobian of a wave is Σ symbol · matrix, where the matrices are formulas of the species and do
// not depend on the wave.
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
    std::optional<NodeId> reach;  ///< Reads items of `varied`. Empty: the whole domain.
    /// Represents the sum of its weights in formulas of the model. No item of the stage has this
    /// number.
    ItemId sum;
};

struct LinearModel {
    const Program* program = nullptr;
    std::uint32_t stage = 0;
    /// Contains all formulas below. They read species, `varied`, sums of kernels and unknowns.
    Algebra algebra;
    std::vector<ItemId> species;
    std::vector<Unknown> unknowns;  ///< The fields of constraints, each after those that it needs.
    std::vector<ItemId> varied;
    std::vector<KernelFormula> kernels;  ///< Indexed as in operators.
    IdVector<ItemId, StartValue> starts;
    std::vector<NodeId> rates;        ///< The rates of species, then of constraints.
    std::vector<JacobianTerm> terms;  ///< The first term is the value itself.
    std::vector<ItemId> parameters;   ///< Parameters read by rates, in order of writing.
    bool reads_time = false;          ///< `t` counts as 0.
    bool has_noise = false;           ///< Rates draw random numbers, which count as their mean.

    std::size_t species_count() const { return species.size(); }
    std::size_t variable_count() const { return species.size() + unknowns.size(); }
    bool has_nonlocal_parts() const { return !unknowns.empty() || !kernels.empty(); }
    /// All formulas that depend on parameters.
    std::vector<NodeId> formulas() const;
    const System& system() const { return program->system_of(stage); }
};

/// Fails with the reason if a flat state makes no sense or a part of the rates has no derivative.
/// The items of `varied` are parameters with the same value in all cells. The program must outlive
/// the model.
Result<LinearModel> linear_model(const Program& program, std::uint32_t stage,
                                 std::span<const ItemId> varied = {});

}  // namespace cascade::analysis
