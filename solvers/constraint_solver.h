// Finds the field u for which e = L u + b is 0, where L is a linear operator that kernels apply.
//
// BiCGSTAB (solvers/bicgstab.h) is preconditioned by the inverse of an operator that is the same in
// all cells. On grids, this operator is a stencil: the mean of the responses of L to single cells.
// Fast Fourier transforms apply its inverse. On linked cells, the operator is a (Δ − s), with a and
// s from the responses of L to a constant and to an alternating field. A factorisation applies its
// inverse. So if L is the same everywhere, the first iteration finds the solution up to rounding.
// If the domain has a mask, or if sides or coefficients vary, a few more iterations are needed.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "solvers/linked_laplacian.h"
#include "solvers/pass_runner.h"
#include "solvers/stencil_inverse.h"
#include "solvers/step_problem.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cascade {

template <typename Number>
class ConstraintSolver {
public:
    /// `solve` and `outer` must outlive the solver. Throws std::bad_alloc.
    ConstraintSolver(const StepProblem::Solve& solve, const StepProblem& outer);

    /// Writes the field into `target`, including its halo. The first `threads` threads of the team
    /// call this, each with its number and otherwise the same arguments. Begins and ends with a
    /// barrier of the team. The result is the same bit for bit with any number of threads and after
    /// any earlier solutions.
    void solve(Team& team, int thread, int threads, Registers registers, const StepMoment& moment,
               Field& target);

private:
    struct Worker;
    struct System;

    void apply(Worker& worker, PassRunner& runner, PassRunner::Worker& of_runner,
               std::vector<Field*> results);
    void apply_linear(Worker& worker, Field& result);
    SideRules sides_at(const Worker& worker) const;
    void fill_halo_of_unknown(Worker& worker, bool is_linear);
    void find_stencil(Worker& worker);
    void find_shift(Worker& worker, double constant);
    void precondition(Worker& worker, const Field& from);
    double dot(Worker& worker, const Field& a, const Field& b);
    double subtract_mean(Worker& worker, Field& from);
    template <typename Value>
    void respond(Worker& worker, const Value& value);
    bool probe(Worker& worker);
    void iterate(Worker& worker, Field& solution);
    void pad(Number* cells) const;

    /// The areas of the cells; null if all cells have the same area.
    const Number* areas_of_cells() const {
        return problem_.areas ? problem_.areas->template origin<Number>() : nullptr;
    }
    template <typename Act>
    void each_cell(const Worker& worker, const Act& act) const;
    template <typename Act>
    void each_row(const Worker& worker, const Act& act) const;

    const StepProblem::Solve& problem_;
    const StepProblem& outer_;
    PlaneLayout layout_;
    PassRunner whole_, linear_;
    std::optional<PassRunner> parts_;
    Field residual_, shadow_, direction_, image_, other_image_;
    // The number of arrays for sums of rows. All threads read an array until the next barrier, so
    // successive products use the arrays in turn.
    static constexpr std::size_t sums_in_use = 4;
    std::vector<double> row_sums_[sums_in_use];
    std::optional<StencilInverse<Number>> stencil_;  ///< The preconditioner on grids.
    std::unique_ptr<LinkedLaplacian> laplacian_;     ///< The preconditioner on linked cells.
    /// The factor a of the Laplacian; 0 if the Laplacian is not the preconditioner.
    double factor_ = 0;
};

extern template class ConstraintSolver<float>;
extern template class ConstraintSolver<double>;

}  // namespace cascade
