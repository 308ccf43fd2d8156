// Stepping on a team of threads.
#include "solvers/stepper.h"

#include "core/check.h"
#include "solvers/field_norms.h"
#include "solvers/finite.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {
namespace {

/// Fewer values than this per thread and step cost more in meeting than they save in work (a
/// thread computes them in about 10 µs, a meeting takes about 1). Where cells have links they take
/// longer.
constexpr std::int64_t least_values_per_thread = 16384;
constexpr std::int64_t least_linked_values_per_thread = 8192;

int worthwhile_threads(const Grid& grid, std::size_t species, int most) {
    const std::int64_t values = grid.cell_count() * static_cast<std::int64_t>(species);
    const std::int64_t least =
        grid.linked ? least_linked_values_per_thread : least_values_per_thread;
    const std::int64_t worth = std::min(values / least, grid.height * grid.depth);
    return static_cast<int>(std::clamp<std::int64_t>(worth, 1, std::max(most, 1)));
}

}  // namespace

Stepper::Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads,
                 bool keeps)
    : problem_(&problem),
      layout_(problem.grid),
      team_(worthwhile_threads(problem.grid, species.size(), most_threads)),
      runner_(std::in_place, problem) {
    CHECK(problem.species_needs_halo.size() == species.size(), "a flag for every species");
    copies_[0] = std::move(species);
    for (Field& field : copies_[0]) {
        CHECK(field.layout() == layout_ && field.precision() == problem.precision,
              "species lie as the grid says, in the precision of their problem");
        const auto number = static_cast<std::size_t>(&field - copies_[0].data());
        if (problem.has_halo()) fill_halo(field, problem.sides_of(number));
        copies_[1].emplace_back(layout_, problem.precision);
        if (keeps) copies_[2].emplace_back(layout_, problem.precision);
    }
    if (!keeps) roles_.kept = CopyRoles::none;
    for (std::size_t copy = 0; copy < 3; ++copy) {
        for (Field& field : copies_[copy]) cells_[copy].push_back(field.address());
    }
    add_scratch();
    if (problem.grid.linked) reach_ = rows_reached(problem);
    fitting_tiling_ = tiling_ = choose_tiling(problem, reach_, CacheSizes::here());
    use_threads(team_.size());
}

/// Planes for all registers of the problem.
void Stepper::add_scratch() {
    while (scratch_.size() + first_scratch < problem_->registers) {
        std::vector<Field>& planes = scratch_.emplace_back();
        std::vector<void*>& cells = scratch_cells_.emplace_back();
        for (std::size_t s = 0; s < copies_[0].size(); ++s) {
            cells.push_back(planes.emplace_back(layout_, problem_->precision).address());
        }
    }
}

void Stepper::use(const StepProblem& problem) {
    if (&problem == problem_) return;
    CHECK(problem.grid == problem_->grid, "passes of one grid");
    knows_first_rates_ = knows_first_rates_ && problem.first_rate_passes > 0 &&
                         problem.first_rate_register == problem_->first_rate_register;
    problem_ = &problem;
    add_scratch();
    runner_.emplace(problem);
    for (Worker& worker : workers_) {
        runner_->prepare(worker.passes, worker.passes.number, worker.passes.count);
    }
    fitting_tiling_ = choose_tiling(problem, reach_, CacheSizes::here());
    set_tiling(is_tiling_given_ ? tiling_ : fitting_tiling_);
}

void Stepper::use_tiling(const Tiling& tiling) {
    if (is_tiling_given_ && tiling == tiling_) return;
    is_tiling_given_ = true;
    set_tiling(tiling);
}

void Stepper::set_tiling(const Tiling& tiling) {
    tiling_ = tiling;
    Tiling reaching = tiling;
    if (layout_.depth == 1) reaching.outer_layer = std::max(reaching.outer_layer, reach_);
    tiles_.emplace(*runner_, reaching, static_cast<int>(workers_.size()));
}

double Stepper::attempt(std::int64_t complete, double tolerance) {
    squares_.resize(error_planes().size());
    for (Squares& squares : squares_) {
        squares.of_errors.resize(static_cast<std::size_t>(layout_.row_count()));
        squares.of_values.resize(squares.of_errors.size());
    }
    team_.run(
        [&](int index) {
            Worker& worker = workers_[static_cast<std::size_t>(index)];
            const std::size_t first = knows_first_rates_ ? problem_->first_rate_passes : 0;
            work(worker, {first, complete, roles_}, problem_->passes.size() - first, true);
            add_squares(worker);
        },
        static_cast<int>(workers_.size()));
    roles_.current = roles_.target();
    knows_first_rates_ = problem_->first_rate_passes > 0;
    const std::int64_t cells = problem_->counted_cells();
    double largest = 0;
    for (const Squares& squares : squares_) {
        const double error = root_mean_square(squares.of_errors, cells);
        const double size = root_mean_square(squares.of_values, cells);
        if (!std::isfinite(error) || !std::isfinite(size)) return NAN;
        if (error > 0) largest = std::max(largest, error / (tolerance * std::max(size, 1e-30)));
    }
    return largest;
}

void Stepper::accept() {
    if (problem_->first_rate_passes == 0) return;
    const std::size_t first = place_of(problem_->first_rate_register);
    const std::size_t last = place_of(problem_->last_rate_register);
    std::swap(scratch_[first], scratch_[last]);
    std::swap(scratch_cells_[first], scratch_cells_[last]);
}

/// Of the worker's rows of the step just computed.
void Stepper::add_squares(const Worker& worker) {
    const std::vector<Field>& values = copies_[static_cast<std::size_t>(roles_.target())];
    for (std::size_t k = 0; k < squares_.size(); ++k) {
        for (std::int64_t row = worker.passes.rows.begin; row < worker.passes.rows.end; ++row) {
            const auto place = static_cast<std::size_t>(row);
            const std::int64_t cells = problem_->counted_in_row(row);
            squares_[k].of_errors[place] = sum_of_squares(error_planes()[k], row, cells);
            squares_[k].of_values[place] = sum_of_squares(values[k], row, cells);
        }
    }
}

void Stepper::use_threads(int threads) {
    if (static_cast<std::size_t>(threads) == workers_.size()) return;
    workers_.resize(static_cast<std::size_t>(threads));
    for (int index = 0; index < threads; ++index) {
        Worker& worker = workers_[static_cast<std::size_t>(index)];
        runner_->prepare(worker.passes, index, threads);
    }
    set_tiling(tiling_);
}

bool Stepper::advance(std::int64_t complete, std::int64_t count, bool look) {
    knows_first_rates_ = false;
    CopyRoles new_roles = roles_;
    for (std::int64_t taken = 0; taken < count; ++taken) new_roles.current = new_roles.target();
    team_.run(
        [&](int index) {
            Worker& worker = workers_[static_cast<std::size_t>(index)];
            work(worker, {0, complete, roles_},
                 static_cast<std::size_t>(count) * problem_->passes.size(), look);
            if (look) worker.finite = rows_finite(worker, new_roles.current);
        },
        static_cast<int>(workers_.size()));
    roles_ = new_roles;
    return !look || all_finite();
}

bool Stepper::is_finite() {
    team_.run(
        [&](int index) {
            Worker& worker = workers_[static_cast<std::size_t>(index)];
            worker.finite = rows_finite(worker, roles_.current);
        },
        static_cast<int>(workers_.size()));
    return all_finite();
}

/// Runs so many levels from `level` on. `meets`: each thread's own rows are complete at the end.
void Stepper::work(Worker& worker, Level level, std::size_t left, bool meets) {
    while (left > 0) {
        const std::size_t levels = levels_from(level, left);
        run_levels(worker, level, levels);
        left -= levels;
        // One meeting is enough: after it nobody reads the copy that the next level overwrites, and
        // every thread has filled the halo that comes from its own rows. Tiles end in any thread's
        // rows.
        if (left > 0 || (meets && tiles_->levels() > 1)) team_.barrier();
    }
}

void Stepper::Level::go_on(std::size_t passes) {
    if (++pass < passes) return;
    pass = 0;
    ++complete;
    roles.current = roles.target();
}

/// How many levels to run together where `left` are to be run: tiles of nearly equal heights, up to
/// a pass that needs all rows.
std::size_t Stepper::levels_from(const Level& level, std::size_t left) const {
    const auto most = static_cast<std::size_t>(tiles_->levels());
    const std::size_t passes = problem_->passes.size();
    std::size_t free = 1;
    while (free < left && !needs_all_rows(problem_->passes[(level.pass + free) % passes])) {
        if (++free > 2 * most) return most;
    }
    const std::size_t tiles = (free + most - 1) / most;
    return (free + tiles - 1) / tiles;
}

void Stepper::run_levels(Worker& worker, Level& level, std::size_t count) {
    const std::size_t passes = problem_->passes.size();
    for (std::size_t number = 0; number < count; ++number) {
        if (number == 0 || level.pass == 0) set_registers(worker, level.roles);
        const StepMoment moment = moment_of(level.complete);
        if (number == 0) {
            runner_->prepare_pass(worker.passes, team_, level.pass, worker.registers, moment);
        }
        // The first level of a tile brings what the others read.
        runner_->bind(worker.passes, number, level.pass, worker.registers, moment,
                      tiling_.is_near && number > 0);
        level.go_on(passes);
    }
    if (count == 1) {
        runner_->run_rows(worker.passes, 0, worker.passes.rows);
    } else {
        tiles_->run(worker.passes, team_, static_cast<int>(count));
    }
}

/// The old step, the new one, then scratch.
void Stepper::set_registers(Worker& worker, CopyRoles roles) const {
    worker.registers.clear();
    worker.registers.emplace_back(cells_[static_cast<std::size_t>(roles.current)]);
    worker.registers.emplace_back(cells_[static_cast<std::size_t>(roles.target())]);
    for (const std::vector<void*>& cells : scratch_cells_) worker.registers.emplace_back(cells);
}

StepMoment Stepper::moment_of(std::int64_t complete) const {
    return {complete, clock_.at(complete), clock_.step, clock_.at(complete + 1)};
}

bool Stepper::rows_finite(const Worker& worker, int copy) const {
    const std::vector<Field>& fields = copies_[static_cast<std::size_t>(copy)];
    return std::all_of(fields.begin(), fields.end(), [&](const Field& field) {
        return rows_are_finite(field, worker.passes.rows);
    });
}

bool Stepper::all_finite() const {
    return std::all_of(workers_.begin(), workers_.end(),
                       [](const Worker& worker) { return worker.finite; });
}

}  // namespace cascade
