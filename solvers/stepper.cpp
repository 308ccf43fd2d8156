// Takes steps, checks values and estimates errors.
#include "solvers/stepper.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "solvers/field_norms.h"
#include "solvers/finite.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

std::vector<Field> with_halo(const StepProblem& problem, std::vector<Field> species) {
    CHECK(problem.species_needs_halo.size() == species.size(), "a flag for every species");
    // Values may have changed since the problem was bound.
    const FlushDenormals environment;
    problem.fill_halos(species);
    return species;
}

}  // namespace

Stepper::Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads,
                 bool keeps)
    : planes_(PlaneLayout(problem.grid), problem.precision, with_halo(problem, std::move(species)),
              keeps),
      team_(problem, planes_.current().size(), most_threads),
      finite_(static_cast<std::size_t>(team_.most_threads())) {
    planes_.make_registers(problem.registers);
}

void Stepper::use(const StepProblem& problem) {
    const StepProblem& before = team_.problem();
    if (&problem == &before) return;
    knows_first_rates_ = knows_first_rates_ && problem.first_rate_passes > 0 &&
                         problem.rate_registers == before.rate_registers;
    planes_.make_registers(problem.registers);
    team_.use(problem);
}

bool Stepper::advance(std::int64_t complete, std::int64_t count, bool look) {
    knows_first_rates_ = false;
    CopyRoles roles = planes_.roles();
    for (std::int64_t taken = 0; taken < count; ++taken) roles.go_on();
    team_.run(planes_, clock_, {0, complete, planes_.roles()},
              static_cast<std::size_t>(count) * problem().passes.size(),
              look ? look_at(roles.current) : nullptr, count == 1 ? cancel_ : nullptr);
    planes_.set_roles(roles);
    return !look || all_finite();
}

bool Stepper::is_finite() {
    team_.run(look_at(planes_.roles().current));
    return all_finite();
}

/// What threads do while they check values.
PassTeam::OwnCells Stepper::look_at(int copy) {
    std::fill(finite_.begin(), finite_.end(), std::uint8_t{1});
    return [this, copy](int thread, const Patch& cells) {
        for (const Field& field : planes_.copy(copy)) {
            if (!are_finite(field, cells)) finite_[static_cast<std::size_t>(thread)] = 0;
        }
    };
}

bool Stepper::all_finite() const {
    return std::all_of(finite_.begin(), finite_.end(), [](std::uint8_t is) { return is != 0; });
}

double Stepper::attempt(std::int64_t complete, double tolerance) {
    squares_.resize(error_planes().size());
    for (Squares& squares : squares_) {
        squares.of_errors.resize(static_cast<std::size_t>(planes_.layout().row_count()));
        squares.of_values.resize(squares.of_errors.size());
    }
    const std::size_t first_rate_passes = problem().first_rate_passes;
    const std::size_t first = knows_first_rates_ ? first_rate_passes : 0;
    CopyRoles roles = planes_.roles();
    team_.run_step(
        planes_, clock_, {first, complete, roles}, [this](RowRange rows) { add_squares(rows); },
        cancel_);
    roles.go_on();
    planes_.set_roles(roles);
    knows_first_rates_ = first_rate_passes > 0;
    const std::int64_t cells = problem().counted_cells();
    // Close to the least normal numbers errors are those of rounding.
    const double least = problem().precision == Precision::single ? 1e-30 : 1e-150;
    double largest = 0;
    for (const Squares& squares : squares_) {
        const double error = root_mean_square(squares.of_errors, cells);
        const double size = root_mean_square(squares.of_values, cells);
        if (!std::isfinite(error) || !std::isfinite(size)) return NAN;
        if (error > 0) largest = std::max(largest, error / (tolerance * std::max(size, least)));
    }
    return largest;
}

void Stepper::accept() {
    const std::optional<RateRegisters>& rates = problem().rate_registers;
    if (rates) planes_.exchange(rates->first, rates->last);
}

/// Sums the squares of some rows of the step just computed.
void Stepper::add_squares(RowRange rows) {
    const std::vector<Field>& values = planes_.copy(planes_.roles().target());
    for (std::size_t k = 0; k < squares_.size(); ++k) {
        for (std::int64_t row = rows.begin; row < rows.end; ++row) {
            const auto place = static_cast<std::size_t>(row);
            const std::int64_t cells = problem().counted_in_row(row);
            squares_[k].of_errors[place] = sum_of_squares(error_planes()[k], row, cells);
            squares_[k].of_values[place] = sum_of_squares(values[k], row, cells);
        }
    }
}

}  // namespace cascade
