// Stepping on a team of threads.
#include "solvers/stepper.h"

#include "core/check.h"
#include "solvers/finite.h"

#include <algorithm>

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
    : problem_(problem),
      layout_(problem.grid),
      team_(worthwhile_threads(problem.grid, species.size(), most_threads)) {
    CHECK(problem.species_needs_halo.size() == species.size(), "a flag for every species");
    copies_[0] = std::move(species);
    for (Field& field : copies_[0]) {
        CHECK(field.layout() == layout_, "species lie as the grid says");
        fill_halo(field.origin(), layout_, problem.grid.boundary);
        copies_[1].emplace_back(layout_);
        copies_[2].emplace_back(layout_);
    }
    for (std::size_t copy = 0; copy < 3; ++copy) {
        for (Field& field : copies_[copy]) outputs_[copy].push_back(field.origin());
        for (const StepProblem::FieldSlot& slot : problem.fields) {
            inputs_[copy].push_back(slot.species < 0
                                        ? slot.fixed
                                        : outputs_[copy][static_cast<std::size_t>(slot.species)]);
        }
    }
    use_threads(team_.size());
}

void Stepper::use_threads(int threads) {
    if (static_cast<std::size_t>(threads) == workers_.size()) return;
    workers_.resize(static_cast<std::size_t>(threads));
    for (int index = 0; index < threads; ++index) {
        Worker& worker = workers_[static_cast<std::size_t>(index)];
        worker.rows = split_rows(layout_.row_count(), index, threads);
        worker.uniforms = problem_.uniforms;
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
    const auto from = static_cast<std::size_t>(roles.current);
    const auto to = static_cast<std::size_t>(roles.target());
    if (problem_.step_uniform >= 0) {
        worker.uniforms[static_cast<std::size_t>(problem_.step_uniform)] =
            static_cast<float>(complete);
    }
    const KernelArguments arguments{inputs_[from], problem_.masks, worker.uniforms, outputs_[to],
                                    layout_};
    // The halo's columns lie beside rows that were just written: filled a band at a time they are
    // still in the cache.
    const std::int64_t band = rows_of_a_band();
    for (std::int64_t row = worker.rows.begin; row < worker.rows.end; row += band) {
        const RowRange rows{row, std::min(row + band, worker.rows.end)};
        problem_.step->run(arguments, rows);
        for (std::size_t k = 0; k < outputs_[to].size(); ++k) {
            if (!problem_.species_needs_halo[k]) continue;
            fill_halo_from_rows(outputs_[to][k], layout_, problem_.grid.boundary, rows.begin,
                                rows.end);
        }
    }
}

std::int64_t Stepper::rows_of_a_band() const {
    constexpr std::int64_t elements_in_cache = 65536;  // A quarter of a MiB of results.
    const auto results = static_cast<std::int64_t>(outputs_[0].size());
    return std::max<std::int64_t>(8, elements_in_cache / (layout_.stride * results));
}

bool Stepper::rows_finite(const Worker& worker, int copy) const {
    const std::vector<Field>& fields = copies_[static_cast<std::size_t>(copy)];
    return std::all_of(fields.begin(), fields.end(), [&](const Field& field) {
        return rows_are_finite(field, worker.rows);
    });
}

bool Stepper::all_finite() const {
    return std::all_of(workers_.begin(), workers_.end(),
                       [](const Worker& worker) { return worker.finite; });
}

}  // namespace cascade
