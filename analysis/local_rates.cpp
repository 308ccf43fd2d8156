// Five tapes with the same inputs.
#include "analysis/local_rates.h"

#include <algorithm>

namespace cascade::analysis {

namespace {

std::vector<ItemId> inputs_of(const LinearModel& model) {
    std::vector<ItemId> inputs = model.species;
    inputs.insert(inputs.end(), model.varied.begin(), model.varied.end());
    return inputs;
}

std::vector<NodeId> starts_of(const LinearModel& model, NodeId StartValue::*which) {
    std::vector<NodeId> nodes;
    for (const ItemId item : model.species) nodes.push_back(model.starts[item].*which);
    return nodes;
}

std::vector<NodeId> entries_of(const LinearModel& model, std::size_t terms) {
    std::vector<NodeId> nodes;
    for (std::size_t k = 0; k < terms; ++k) {
        nodes.insert(nodes.end(), model.terms[k].entries.begin(), model.terms[k].entries.end());
    }
    return nodes;
}

/// Entries are by rate, then by species.
Matrix matrix_of(const std::vector<double>& entries, std::size_t first, Eigen::Index count) {
    using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const ByRows>(entries.data() + first, count, count);
}

}  // namespace

bool all_finite(const Matrices& matrices) {
    return std::all_of(matrices.begin(), matrices.end(),
                       [](const Matrix& matrix) { return matrix.allFinite(); });
}

LocalRates::LocalRates(const LinearModel& model)
    : model_(model),
      start_(model.algebra, starts_of(model, &StartValue::value), inputs_of(model)),
      scatter_(model.algebra, starts_of(model, &StartValue::scatter), inputs_of(model)),
      rates_(model.algebra, model.rates, inputs_of(model)),
      jacobian_(model.algebra, entries_of(model, 1), inputs_of(model)),
      matrices_(model.algebra, entries_of(model, model.terms.size()), inputs_of(model)),
      varied_(model.varied.size(), 0.0) {}

std::vector<double> LocalRates::run(const Tape& tape, const Vector& species) const {
    std::vector<double> inputs(species.begin(), species.end());
    inputs.insert(inputs.end(), varied_.begin(), varied_.end());
    return tape.run(inputs);
}

Vector LocalRates::species_of(const Tape& tape) const {
    const std::vector<double> values = run(tape, Vector::Zero(species_count()));
    return Eigen::Map<const Vector>(values.data(), species_count());
}

Vector LocalRates::rates(const Vector& species) const {
    const std::vector<double> values = run(rates_, species);
    return Eigen::Map<const Vector>(values.data(), species_count());
}

Matrix LocalRates::jacobian(const Vector& species) const {
    return matrix_of(run(jacobian_, species), 0, species_count());
}

Matrices LocalRates::matrices(const Vector& species) const {
    const std::vector<double> entries = run(matrices_, species);
    const auto size = static_cast<std::size_t>(species_count() * species_count());
    Matrices matrices;
    for (std::size_t k = 0; k < model_.terms.size(); ++k) {
        matrices.push_back(matrix_of(entries, k * size, species_count()));
    }
    return matrices;
}

}  // namespace cascade::analysis
