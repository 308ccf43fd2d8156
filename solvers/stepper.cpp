// Stepping on a team of threads.
#include "solvers/stepper.h"

#include "core/check.h"
#include "solvers/field_norms.h"
#include "solvers/finite.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

/// Fewer values than this per thread and step cost more in meeting than they save in work (a
/// thread computes them in about 10 µs, a meeting takes about 1).
constexpr std::int64_t least_values_per_thread = 16384;

int worthwhile_threads(const Grid& grid, std::size_t species, int most) {
    const std::int64_t values = grid.cell_count() * static_cast<std::int64_t>(species);
    const std::int64_t worth = std::min(values / least_values_per_thread, grid.height * grid.depth);
    return static_cast<int>(std::clamp<std::int64_t>(worth, 1, std::max(most, 1)));
}

}  // namespace

Stepper::Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads)
    : problem_(&problem),
      layout_(problem.grid),
      team_(worthwhile_threads(problem.grid, species.size(), most_threads)),
      runner_(std::in_place, problem) {
    CHECK(problem.species_needs_halo.size() == species.size(), "a flag for every species");
    copies_[0] = std::move(species);
    for (Field& field : copies_[0]) {
        CHECK(field.layout() == layout_, "species lie as the grid says");
        const auto number = static_cast<std::size_t>(&field - copies_[0].data());
        fill_halo(field.origin(), layout_, problem.sides_of(number));
        copies_[1].emplace_back(layout_);
        copies_[2].emplace_back(layout_);
    }
    for (std::size_t copy = 0; copy < 3; ++copy) {
        for (Field& field : copies_[copy]) cells_[copy].push_back(field.origin());
    }
    for (std::uint32_t k = 2; k < problem.registers; ++k) {
        std::vector<Field>& planes = scratch_.emplace_back();
        std::vector<float*>& cells = scratch_cells_.emplace_back();
        for (std::size_t s = 0; s < copies_[0].size(); ++s) {
            cells.push_back(planes.emplace_back(layout_).origin());
        }
    }
    use_threads(team_.size());
}

void Stepper::use(const StepProblem& problem) {
    CHECK(problem.grid == problem_->grid && problem.registers <= scratch_.size() + first_scratch,
          "planes for all passes");
    if (problem_ == &problem) return;
    problem_ = &problem;
    runner_.emplace(problem);
    for (Worker& worker : workers_) {
        runner_->prepare(worker.passes, worker.passes.number, worker.passes.count);
    }
}

double Stepper::error(double tolerance) const {
    const std::vector<Field>& fields = copies_[static_cast<std::size_t>(roles_.current)];
    double largest = 0;
    for (std::size_t k = 0; k < fields.size(); ++k) {
        const double error = root_mean_square(error_planes()[k]);
        if (std::isnan(error)) return error;
        if (error == 0) continue;
        const double unit = tolerance * std::max(root_mean_square(fields[k]), 1e-30);
        largest = std::max(largest, error / unit);
    }
    return largest;
}

void Stepper::use_threads(int threads) {
    if (static_cast<std::size_t>(threads) == workers_.size()) return;
    workers_.resize(static_cast<std::size_t>(threads));
    for (int index = 0; index < threads; ++index) {
        Worker& worker = workers_[static_cast<std::size_t>(index)];
        runner_->prepare(worker.passes, index, threads);
    }
}

bool Stepper::advance(std::int64_t complete, std::int64_t count, bool look) {
    team_.run([&](int index) {
        work(workers_[static_cast<std::size_t>(index)], complete, count, look);
    }, static_cast<int>(workers_.size()));
    for (std::int64_t taken = 0; taken < count; ++taken) roles_.current = roles_.target();
    return !look || all_finite();
}

bool Stepper::is_finite() {
    team_.run([&](int index) {
        Worker& worker = workers_[static_cast<std::size_t>(index)];
        worker.finite = rows_finite(worker, roles_.current);
    }, static_cast<int>(workers_.size()));
    return all_finite();
}

void Stepper::work(Worker& worker, std::int64_t complete, std::int64_t count, bool look) {
    CopyRoles roles = roles_;
    for (std::int64_t taken = 0; taken < count; ++taken) {
        // One meeting a step is enough: behind it nobody reads the copy that the next step
        // overwrites, and every thread has filled the halo that comes from its own rows.
        if (taken > 0) team_.barrier();
        step(worker, roles, complete + taken);
        roles.current = roles.target();
    }
    if (look) worker.finite = rows_finite(worker, roles.current);
}

void Stepper::step(Worker& worker, CopyRoles roles, std::int64_t complete) {
    worker.registers.clear();  // The old step, the new one, then scratch.
    worker.registers.emplace_back(cells_[static_cast<std::size_t>(roles.current)]);
    worker.registers.emplace_back(cells_[static_cast<std::size_t>(roles.target())]);
    for (const std::vector<float*>& cells : scratch_cells_) worker.registers.emplace_back(cells);
    runner_->run(worker.passes, team_, worker.registers, {complete, clock_.at(complete), clock_.step});
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
