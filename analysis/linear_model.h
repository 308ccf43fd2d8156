// The rates of a stage around a flat state, in which all cells have the same values: the rates in
// this state, and their response to an added wave.
//
// In a flat state all derivatives are 0. So every operator is linear around it and multiplies a
// wave by a factor, the operator's symbol. The formulas of the rates are visited once, operands
// first. Each subexpression is turned into its value in the flat state and, for each variable, into
// a sum of products of operators with coefficients. So the Jacobian of a wave is Σ symbol · matrix,
// where the matrices are formulas of the species and do not depend on the wave.
//
// The fields of constraints `0 = e` are variables in addition to the species, and each e is a rate
// that is always 0. LocalRates eliminates them.
#pragma once

#include "analysis/start_values.h"
#include "analysis/wave_operators.h"
#include "core/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade::analysis {

/// A term of the Jacobian: a matrix, and the operators by whose symbols it is multiplied.
struct JacobianTerm {
    OperatorProduct operators;
    /// The entry for a rate and a variable has the index rate · variable_count + variable.
    std::vector<NodeId> entries;
};

/// The kernel of a convolution, as formulas.
struct KernelFormula {
    std::uint32_t literal = 0;  ///< The index of the convolution in Literals.
    NodeId weight;              ///< A formula of components of lags and items of `varied`.
    /// A formula of items of `varied`. Empty if the kernel covers the whole domain.
    std::optional<NodeId> reach;
    /// In the model's formulas, this item represents the sum of the weights. No item of the stage
    /// has this id.
    ItemId sum;
};

struct LinearModel {
    const Program* program = nullptr;
    std::uint32_t stage = 0;
    /// Contains all formulas of the members below. Their leaves are species, `varied`, sums of
    /// kernels, and unknowns.
    Algebra algebra;
    std::vector<ItemId> species;
    /// The fields of constraints. A field comes after the fields on which it depends.
    std::vector<Unknown> unknowns;
    std::vector<ItemId> varied;
    std::vector<KernelFormula> kernels;  ///< Operators refer to kernels by index.
    IdVector<ItemId, StartValue> starts;
    std::vector<NodeId> rates;  ///< The rates of species, then of constraints.
    /// The first term is the response to the value itself, without operators.
    std::vector<JacobianTerm> terms;
    std::vector<ItemId> parameters;  ///< The parameters that rates read, in order of writing.
    bool reads_time = false;         ///< Whether rates read `t`, which counts as 0.
    bool has_noise = false;  ///< Whether rates draw random numbers, which count as their mean.

    std::size_t species_count() const { return species.size(); }
    std::size_t variable_count() const { return species.size() + unknowns.size(); }
    bool has_nonlocal_parts() const { return !unknowns.empty() || !kernels.empty(); }
    /// All formulas that depend on parameters.
    std::vector<NodeId> formulas() const;
    const System& system() const { return program->system_of(stage); }
};

/// Makes the model of a stage. The items of `varied` are parameters with the same value in all
/// cells. Fails with the reason if the stage can have no flat state or a part of the rates has no
/// derivative. The program must outlive the model.
Result<LinearModel> linear_model(const Program& program, std::uint32_t stage,
                                 std::span<const ItemId> varied = {});

}  // namespace cascade::analysis
