// Runs the passes of a step on a team of threads, with temporaries, aggregates and the barriers
// between passes.
//
// A *level* is a pass that is bound to planes and to a moment. A worker is the data with which one
// thread binds levels and runs them on any rows. run() runs one level after the other.
// solvers/tile_runner.h runs several levels together.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "solvers/exchange.h"
#include "solvers/leave_if.h"
#include "solvers/part_halos.h"
#include "solvers/step_problem.h"
#include "solvers/wave_filter.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace cascade {

/// The times at which a step begins and ends, and the flag that cancels it.
struct StepMoment {
    std::int64_t complete = 0;  ///< The number of steps taken before this one.
    double t = 0;               ///< The stage's time when the step begins.
    double length = 0;          ///< The time step.
    double next_t = 0;          ///< The stage's time when the next step begins.
    /// If this becomes true, the step may be abandoned.
    const std::atomic<bool>* cancel = nullptr;

    /// Abandons the step if the run was cancelled. Any thread may call it at any time.
    void leave_if_cancelled() const { leave_if(cancel); }
};

/// The planes of every register, one per species, in the problem's precision.
using Registers = std::span<const std::span<Field>>;

/// Called for rows that a pass has just written, while they are in the cache. The thread that wrote
/// the rows calls it. If the grid is cut along columns, any thread may call it.
using RowsWritten = std::function<void(RowRange)>;

template <typename Number>
class ConstraintSolver;

/// The layout of a problem's planes in this process. The planes cover the whole grid or, if
/// `others` is not null, a part of the grid and as many rows of other parts as Exchange::levels()
/// passes read. On a periodic axis these rows may be beyond the grid.
PlaneLayout layout_of(const StepProblem& problem, const Exchange* others);

class PassRunner {
public:
    /// Allocates temporaries. `others` are the other parts of the grid, or null if this process
    /// computes the whole grid. If there are other parts, all threads begin and end their work
    /// together with these parts. Fields and masks that `problem` refers to cover the whole grid.
    /// `problem` and `others` must outlive the runner.
    explicit PassRunner(const StepProblem& problem, Exchange* others = nullptr);
    ~PassRunner();

    /// How a pass runs as a level.
    struct LevelOptions {
        /// Whether the pass will find the values that it reads in the second-level cache.
        bool is_near = false;
        const RowsWritten* when_written = nullptr;  ///< May be null. Must outlive the level.
        /// The number of levels that follow before halos are exchanged. Only for a part of a grid.
        std::int64_t followers = 0;
    };
    /// A pass with all data needed to run it on some rows.
    template <typename Number>
    struct Level {
        std::size_t pass = 0;
        StepMoment moment;
        RowRange rows;  ///< The rows that the level computes. They may be beyond the grid.
        std::vector<Number> uniforms;
        std::vector<const Number*> fields;
        std::vector<const std::uint8_t*> masks;
        std::vector<Number*> results;
        std::vector<const Field*> written;  ///< The planes of the results.
        KernelArgumentsOf<Number> given;
        const RowsWritten* when_written = nullptr;  ///< May be null.
    };
    template <typename Number>
    struct Arguments {
        std::vector<Level<Number>> levels;
        /// The same levels for the rows before and after a periodic grid. Empty if no such rows are
        /// computed.
        std::vector<Level<Number>> before, after;
        std::vector<std::vector<Number>>
            uniforms;  ///< The uniforms of each pass, with the latest values of aggregates.
        IdVector<AggregateId, Number> aggregates;
    };
    /// The data of one thread.
    struct alignas(64) Worker {
        int number = 0;  ///< The thread's number among the `count` threads in use.
        int count = 1;
        RowRange rows;  ///< This thread's rows.
        /// This thread's cells. All threads have nearly equal shares even if the grid has few rows.
        Patch cells;
        std::vector<DiffusionSymbol> symbols;
        std::variant<Arguments<float>, Arguments<double>> arguments;
        std::vector<double> row_values;
    };
    /// Prepares a worker for its rows, as thread `number` of `count`.
    void prepare(Worker& worker, int number, int count) const;

    /// Does one thread's share of a step. All threads of the team in use call it with the same
    /// registers and moment. When it returns, this thread's rows of the results are written and
    /// their halo is filled. After another barrier of the team, they are visible to every thread.
    void run(Worker& worker, Team& team, Registers registers, const StepMoment& moment);

    /// Runs all passes once. The threads of the team share the rows.
    void run_once(Team& team, Registers registers, const StepMoment& moment);

    /// Does what must precede the kernel of a pass: constraints, convolutions, reductions and
    /// filters. All threads of the team call it, as they call run().
    void prepare_pass(Worker& worker, Team& team, std::size_t pass, Registers registers,
                      const StepMoment& moment);
    /// Binds a pass as level `level` of the worker. Reads `registers` during this call only.
    void bind(Worker& worker, std::size_t level, std::size_t pass, Registers registers,
              const StepMoment& moment, const LevelOptions& options);
    /// Runs a bound level on some cells, and fills the halo cells that depend on them. In a part of
    /// a grid, leaves out the rows that the level does not compute.
    void run_cells(Worker& worker, std::size_t level, const Patch& cells) const;
    /// Runs this thread's share of a bound level.
    void run_share(Worker& worker, std::size_t level) const;

    // The next functions are for parts of a grid only. One thread calls them when all threads have
    // written their rows.

    bool is_part() const { return others_ != nullptr; }
    /// Adds to `reads` the planes that a pass reads if it runs on these registers.
    void add_reads(std::size_t pass, Registers registers, HaloReads& reads);
    /// Fills the halos of planes that the next levels read.
    void share_reads(const HaloReads& reads) const;
    /// Fills the halos beyond the sides of the grid for a moment.
    void fill_sides(std::span<Field> species, SideMoment moment) const;

    /// Fills the halos of all results of a pass with values from other parts.
    void share_results(std::size_t pass, Registers registers);
    /// Fills the halos of all species of one register with values from other parts.
    void share_species(std::span<Field> species) const;

    const StepProblem& problem() const { return problem_; }
    const Field& temporary(TemporaryId id) const { return temporaries_[id]; }
    const PlaneLayout& layout() const { return layout_; }

private:
    /// The cells whose values a kernel copies to the halo columns; nullopt if the rule at one of
    /// the sides prescribes a value.
    static std::optional<HaloColumns> copied_columns(const SideRules& sides, std::int64_t width);
    /// Whole planes, on which the root of all parts does the computations that need all cells.
    struct WholeGrid;
    /// Calls `work` with the runner, the worker and the registers of the whole grid.
    template <typename Work>
    void on_whole_grid(Worker& worker, Team& team, Registers registers, const Work& work);
    void share(std::span<const Exchange::Shared> planes) const;
    bool wraps(const SideRules& sides) const;
    const Field& read(const StepProblem::PlaneRef& ref, Registers registers) const;
    Field& written(const StepProblem::PlaneRef& ref, Registers registers);
    template <typename Number>
    void reduce(Worker& worker, Arguments<Number>& arguments, std::size_t pass_number, Team& team,
                Registers registers);
    template <typename Number>
    void solve(const Worker& worker, std::size_t pass_number, Team& team, Registers registers,
               const StepMoment& moment);
    template <typename Number>
    void convolve(const Worker& worker, std::size_t pass_number, Team& team, Registers registers,
                  const StepMoment& moment);
    template <typename Number>
    void filter(Worker& worker, Arguments<Number>& arguments, const SweepFilter& filter, Team& team,
                Registers registers, const StepMoment& moment) const;
    template <typename Number>
    void set_uniforms(std::vector<Number>& uniforms, const StepProblem::Pass& pass,
                      const StepMoment& moment) const;
    template <typename Number>
    void bind_as(Arguments<Number>& arguments, std::size_t level, std::size_t pass,
                 Registers registers, const StepMoment& moment, const LevelOptions& options);
    /// Binds a pass as a level for rows of the grid (`beyond` = 0), before it (−1) or after it (1).
    template <typename Number>
    void bind_level(Level<Number>& level, Arguments<Number>& arguments, std::size_t pass,
                    Registers registers, const StepMoment& moment, const LevelOptions& options,
                    int beyond);
    /// The rows that a level computes, if `followers` more levels run before halos are exchanged.
    RowRange rows_with(std::int64_t followers) const;
    template <typename Number>
    void run_level(const Level<Number>& level, const Patch& cells) const;
    template <typename Number>
    bool has_copied_columns(const Level<Number>& level, std::size_t result) const;
    template <typename Number>
    void fill_halo_of(const Level<Number>& level, std::size_t result, const Patch& cells) const;

    const StepProblem& problem_;
    Exchange* others_;
    std::unique_ptr<WholeGrid> whole_;  ///< Null until it is needed.
    PlaneLayout layout_;
    RowRange rows_;  ///< This part's own rows.
    /// Whether this is a part of a grid whose first and last part are neighbours.
    bool wraps_ = false;
    std::int64_t reach_ = 1;  ///< The number of rows or slices that a pass reaches.
    /// The objects that passes need besides kernels.
    template <typename Number>
    struct Helpers {
        /// The filters of waves. nullopt if the problem has no such filters.
        std::optional<WaveFilter<Number>> waves;
        /// The runners by pass, one for each convolution of the pass. Equal convolutions share a
        /// runner.
        std::vector<std::vector<std::shared_ptr<ConvolutionRunner<Number>>>> convolutions;
        /// The solvers by pass, one for each constraint of the pass.
        std::vector<std::vector<std::unique_ptr<ConstraintSolver<Number>>>> solvers;
    };
    std::variant<Helpers<float>, Helpers<double>> helpers_;
    struct PassSides {
        std::vector<SideRules> rules;       ///< The rules of each result before any side changes.
        std::optional<HaloColumns> copied;  ///< The columns that a kernel copies to the halo.
    };
    std::vector<PassSides> sides_;  ///< One per pass.
    IdVector<TemporaryId, Field> temporaries_;
    /// One value per row for each aggregate.
    IdVector<AggregateId, std::vector<double>> row_values_;
};

}  // namespace cascade
