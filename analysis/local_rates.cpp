// Evaluates four tapes with the same inputs. A constraint is linear in its field, so its residuals
// for two trial fields determine the field that solves it.
#include "analysis/local_rates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade::analysis {

namespace {

std::vector<NodeKind> inputs_of_rates(const LinearModel& model) {
    std::vector<NodeKind> inputs(model.species.begin(), model.species.end());
    inputs.insert(inputs.end(), model.varied.begin(), model.varied.end());
    for (const KernelFormula& kernel : model.kernels) inputs.emplace_back(kernel.sum);
    inputs.insert(inputs.end(), model.unknowns.begin(), model.unknowns.end());
    return inputs;
}

std::vector<KernelTapes> kernel_tapes_of(const LinearModel& model) {
    std::vector<KernelTapes> tapes;
    for (const KernelFormula& kernel : model.kernels) tapes.emplace_back(model, kernel);
    return tapes;
}

std::vector<NodeId> starts_of(const LinearModel& model, NodeId StartValue::*which) {
    std::vector<NodeId> nodes;
    for (const ItemId item : model.species) nodes.push_back(model.starts[item].*which);
    return nodes;
}

std::vector<NodeId> entries_of(const LinearModel& model) {
    std::vector<NodeId> nodes;
    for (const JacobianTerm& term : model.terms) {
        nodes.insert(nodes.end(), term.entries.begin(), term.entries.end());
    }
    return nodes;
}

/// A matrix from its entries, which are stored from `first` on, by rate and then by variable.
Matrix matrix_of(const std::vector<double>& entries, std::size_t first, Eigen::Index count) {
    using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const ByRows>(entries.data() + first, count, count);
}

/// The largest coefficient of a field in a constraint.
double largest_of_unknowns(const Matrices& matrices, Eigen::Index unknowns) {
    double largest = 0;
    for (const Matrix& matrix : matrices.terms) {
        const auto corner = matrix.bottomRightCorner(unknowns, unknowns);
        largest = std::max(largest, corner.cwiseAbs().maxCoeff());
    }
    return largest;
}

}  // namespace

bool Matrices::are_finite() const {
    return std::all_of(terms.begin(), terms.end(),
                       [](const Matrix& matrix) { return matrix.allFinite(); }) &&
           std::all_of(kernels.begin(), kernels.end(),
                       [](const auto& kernel) { return kernel != nullptr; });
}

ComplexMatrix jacobian_of(const LinearModel& model, const Matrices& matrices,
                          const Lattice& lattice, const Phases& phases) {
    ComplexMatrix sum = matrices.terms[0].cast<Complex>();
    for (std::size_t k = 1; k < matrices.terms.size(); ++k) {
        sum +=
            symbol(model.terms[k].operators, lattice, matrices.kernels, phases) * matrices.terms[k];
    }
    if (model.unknowns.empty()) return sum;
    // If the field has no effect on its constraint for some wave, as for the mean of a potential,
    // the field is 0 for this wave.
    const auto species = static_cast<Eigen::Index>(model.species_count());
    const auto unknowns = static_cast<Eigen::Index>(model.unknowns.size());
    ComplexMatrix by_unknowns = sum.bottomRightCorner(unknowns, unknowns);
    const double least = 1e-14 * largest_of_unknowns(matrices, unknowns);
    by_unknowns = (by_unknowns.array().abs() < least).select(Complex(), by_unknowns);
    const ComplexMatrix fields =
        least_squares(by_unknowns, sum.bottomLeftCorner(unknowns, species));
    return sum.topLeftCorner(species, species) - sum.topRightCorner(species, unknowns) * fields;
}

LocalRates::LocalRates(const LinearModel& model)
    : model_(model),
      lattice_(lattice_of(*model.program)),
      kernel_tapes_(kernel_tapes_of(model)),
      start_(model.algebra, starts_of(model, &StartValue::value), inputs_of_rates(model)),
      scatter_(model.algebra, starts_of(model, &StartValue::scatter), inputs_of_rates(model)),
      rates_(model.algebra, model.rates, inputs_of_rates(model)),
      matrices_(model.algebra, entries_of(model), inputs_of_rates(model)),
      varied_(model.varied.size(), 0.0) {
    for (const KernelTapes& tapes : kernel_tapes_) kernels_.push_back(tapes.at(varied_));
}

void LocalRates::set_varied(std::vector<double> values) {
    varied_ = std::move(values);
    for (std::size_t k = 0; k < kernels_.size(); ++k) {
        if (kernel_tapes_[k].varies()) kernels_[k] = kernel_tapes_[k].at(varied_);
    }
}

std::vector<double> LocalRates::inputs(const Vector& species) const {
    std::vector<double> inputs(species.begin(), species.end());
    inputs.insert(inputs.end(), varied_.begin(), varied_.end());
    for (const auto& kernel : kernels_) {
        inputs.push_back(kernel ? kernel->sum() : std::numeric_limits<double>::quiet_NaN());
    }
    inputs.resize(inputs.size() + model_.unknowns.size(), 0.0);
    return inputs;
}

std::vector<double> LocalRates::solved_inputs(const Vector& species) const {
    std::vector<double> known = inputs(species);
    const std::size_t first = known.size() - model_.unknowns.size();
    for (std::size_t k = 0; k < model_.unknowns.size(); ++k) {
        const auto left_at = [&](double field) {
            known[first + k] = field;
            return rates_.run(known)[model_.species_count() + k];
        };
        const double left = left_at(0), by_field = left_at(1) - left;
        known[first + k] = by_field != 0 ? -left / by_field : 0;
    }
    return known;
}

Vector LocalRates::species_of(const Tape& tape) const {
    const std::vector<double> values = tape.run(inputs(Vector::Zero(species_count())));
    return Eigen::Map<const Vector>(values.data(), species_count());
}

Vector LocalRates::rates(const Vector& species) const {
    const std::vector<double> values = rates_.run(solved_inputs(species));
    return Eigen::Map<const Vector>(values.data(), species_count());
}

Matrix LocalRates::jacobian(const Vector& species) const {
    const Matrices all = matrices(species);
    if (!all.are_finite()) {
        return Matrix::Constant(species_count(), species_count(),
                                std::numeric_limits<double>::quiet_NaN());
    }
    return jacobian_of(model_, all, lattice_, {}).real();
}

Matrices LocalRates::matrices(const Vector& species) const {
    const std::vector<double> entries = matrices_.run(solved_inputs(species));
    const auto count = static_cast<Eigen::Index>(model_.variable_count());
    Matrices matrices;
    for (std::size_t k = 0; k < model_.terms.size(); ++k) {
        matrices.terms.push_back(
            matrix_of(entries, k * static_cast<std::size_t>(count * count), count));
    }
    matrices.kernels = kernels_;
    return matrices;
}

}  // namespace cascade::analysis
