// Finds the field u for which e = L u + b is 0, where L is a linear operator that kernels apply.
//
// BiCGSTAB (solvers/bicgstab.h) is preconditioned by the inverse of an operator that is the same in
// all cells. On grids the operator has a stencil, the mean of the responses of L to single cells,
// and fast Fourier transforms apply its inverse. On linked cells it is a (Δ − s), with a and s from
// the responses of L to a constant and to cells of both signs, and its factors are known. So if L
// is the same everywhere, the first iteration finds the solution up to rounding. A mask, sides or
// coefficients that vary take a few more.
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
    /// Both must outlive the solver. Throws std::bad_alloc.
    ConstraintSolver(const StepProblem::Solve& solve, const StepProblem& outer);

    /// Writes the field into `target`, including its halo. The first `threads` threads of the team
    /// call this, each with its number and otherwise the same arguments. Begins and ends with a
    /// barrier of the team. Bits depend neither on `threads` nor on earlier solutions.
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

    /// Null if all cells are alike.
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
    // Sums of the rows of successive products, which threads share between barriers.
    static constexpr std::size_t sums_in_use = 4;
    std::vector<double> row_sums_[sums_in_use];
    std::optional<StencilInverse<Number>> stencil_;  ///< The preconditioner of grids
    std::unique_ptr<LinkedLaplacian> laplacian_;     ///< and of linked cells.
    double factor_ = 0;  ///< Factor of the Laplacian; 0 if it does not precondition.
};

extern template class ConstraintSolver<float>;
extern template class ConstraintSolver<double>;

}  // namespace cascade
