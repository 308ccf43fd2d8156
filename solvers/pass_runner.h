// Runs the passes of a step on a team of threads: temporaries, aggregates and the barriers between
// passes.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "solvers/step_problem.h"
#include "solvers/wave_filter.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// When a step is taken.
struct StepMoment {
    std::int64_t complete = 0;  ///< Steps taken before it.
    double t = 0;               ///< The stage's time as it begins.
    double length = 0;          ///< The time step.
};

/// The planes of every register, one address per species.
using Registers = std::span<const std::span<float* const>>;

class PassRunner {
public:
    /// Allocates temporaries. `problem` must outlive the runner.
    explicit PassRunner(const StepProblem& problem);

    /// What one thread needs of its own.
    struct alignas(64) Worker {
        int number = 0;                            ///< Of the `count` threads in use.
        int count = 1;
        RowRange rows;
        std::vector<std::vector<float>> uniforms;  ///< By pass.
        std::vector<float> aggregates;             ///< As they were computed last.
        std::vector<DiffusionSymbol> symbols;
        std::vector<const float*> fields;
        std::vector<float*> results;
        std::vector<double> row_values;
    };
    /// Prepares a worker for its rows, being thread `number` of `count`.
    void prepare(Worker& worker, int number, int count) const;

    /// One thread's part of a step, from pass `first_pass` on. All threads of the team in use call it
    /// with the same registers and moment. When it returns, this thread's rows of the results are written and their halo
    /// filled; another meeting of the team makes them everybody's.
    void run(Worker& worker, Team& team, Registers registers, const StepMoment& moment,
             std::size_t first_pass = 0);

private:
    float* plane(const StepProblem::PlaneRef& ref, Registers registers) const;
    void reduce(Worker& worker, const StepProblem::Pass& pass, Team& team, Registers registers,
                std::size_t pass_number);
    void filter(Worker& worker, const SweepFilter& filter, Team& team, Registers registers,
                const StepMoment& moment) const;
    void set_uniforms(std::vector<float>& uniforms, const StepProblem::Pass& pass,
                      const StepMoment& moment) const;
    void run_kernel(Worker& worker, const StepProblem::Pass& pass, std::size_t number,
                    Registers registers);

    const StepProblem& problem_;
    PlaneLayout layout_;
    std::optional<WaveFilter<float>> wave_filter_;  ///< Where a pass has a filter.
    std::vector<Field> temporaries_;
    std::vector<float*> temporary_cells_;
    std::vector<std::vector<double>> row_values_;  ///< By aggregate and row.
};

/// Runs a problem once, its rows shared by the team; results go to register 1.
void run_once(const StepProblem& problem, Team& team, Registers registers,
              const StepMoment& moment);

}  // namespace cascade
