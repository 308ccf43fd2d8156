// A linear model as numbers: its rates and its matrices at given values of species and parameters.
#pragma once

#include "analysis/linear_model.h"
#include "analysis/tape.h"

#include <Eigen/Core>

#include <vector>

namespace cascade::analysis {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The matrices of a model in a state, in the order of its terms.
using Matrices = std::vector<Matrix>;
bool all_finite(const Matrices& matrices);

class LocalRates {
public:
    explicit LocalRates(const LinearModel& model);

    const LinearModel& model() const { return model_; }
    Eigen::Index species_count() const { return static_cast<Eigen::Index>(model_.species_count()); }
    /// The values of the model's varied items from here on.
    void set_varied(std::vector<double> values) { varied_ = std::move(values); }

    /// The starting values of the species.
    Vector start() const { return species_of(start_); }
    /// The standard deviation of their random numbers.
    Vector scatter() const { return species_of(scatter_); }
    Vector rates(const Vector& species) const;
    /// Of the reaction: without operators.
    Matrix jacobian(const Vector& species) const;
    Matrices matrices(const Vector& species) const;

private:
    Vector species_of(const Tape& tape) const;
    std::vector<double> run(const Tape& tape, const Vector& species) const;

    const LinearModel& model_;
    Tape start_, scatter_, rates_, jacobian_, matrices_;
    std::vector<double> varied_;
};

}  // namespace cascade::analysis
