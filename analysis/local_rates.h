// A linear model as numbers: its rates and matrices at given values of species and parameters.
#pragma once

#include "analysis/kernel_tapes.h"
#include "analysis/linear_algebra.h"
#include "analysis/linear_model.h"
#include "analysis/tape.h"

#include <vector>

namespace cascade::analysis {

/// The Jacobian of all waves around a state.
struct Matrices {
    std::vector<Matrix> terms;  ///< The matrices of the model's terms, in their order.
    WaveKernels kernels;        ///< The model's convolutions.

    bool are_finite() const;
};

/// The Jacobian of a wave: the derivatives of the species' rates by the species. The fields of
/// constraints follow each change of the species instantly.
ComplexMatrix jacobian_of(const LinearModel& model, const Matrices& matrices,
                          const Lattice& lattice, const Phases& phases);

class LocalRates {
public:
    explicit LocalRates(const LinearModel& model);

    const LinearModel& model() const { return model_; }
    Eigen::Index species_count() const { return static_cast<Eigen::Index>(model_.species_count()); }
    /// Sets the values of the model's varied items for all later calls.
    void set_varied(std::vector<double> values);

    /// The starting values of the species.
    Vector start() const { return species_of(start_); }
    /// The standard deviation of the random numbers in the starting values.
    Vector scatter() const { return species_of(scatter_); }
    Vector rates(const Vector& species) const;
    /// The Jacobian for changes that are the same in all cells.
    Matrix jacobian(const Vector& species) const;
    Matrices matrices(const Vector& species) const;

private:
    Vector species_of(const Tape& tape) const;
    /// The inputs of tapes: species, varied items, sums of kernels, unknowns.
    std::vector<double> inputs(const Vector& species) const;
    std::vector<double> solved_inputs(const Vector& species) const;

    const LinearModel& model_;
    Lattice lattice_;
    std::vector<KernelTapes> kernel_tapes_;
    Tape start_, scatter_, rates_, matrices_;
    std::vector<double> varied_;
    WaveKernels kernels_;
};

}  // namespace cascade::analysis
