// Takes steps and judges their errors.
#include "solvers/stepper.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>

namespace cascade {

Stepper::Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads,
                 bool keeps, const MakeExecutor& make) {
    CHECK(problem.species_needs_halo.size() == species.size(), "a flag for every species");
    executor_ = make(problem, std::move(species), most_threads, keeps);
    if (!keeps) roles_.kept = CopyRoles::none;
    // Values may have changed since the problem was bound.
    executor_->fill_halos(roles_.current, problem.sides_moment);
}

void Stepper::use(const StepProblem& problem) {
    const StepProblem& before = executor_->problem();
    if (&problem == &before) return;
    knows_first_rates_ = knows_first_rates_ && problem.first_rate_passes > 0 &&
                         problem.rate_registers == before.rate_registers;
    executor_->prepare(problem);
}

void Stepper::back() {
    CHECK(roles_.keeps(), "there is a copy to go back to");
    roles_.back();
    knows_first_rates_ = false;
}

bool Stepper::advance(std::int64_t complete, std::int64_t count, bool look) {
    knows_first_rates_ = false;
    const bool is_finite = executor_->run(clock_, {0, complete, roles_},
                                          static_cast<std::size_t>(count) * problem().passes.size(),
                                          look, count == 1 ? cancel_ : nullptr);
    for (std::int64_t taken = 0; taken < count; ++taken) roles_.go_on();
    return is_finite;
}

double Stepper::attempt(std::int64_t complete, double tolerance) {
    const std::size_t first_rate_passes = problem().first_rate_passes;
    const std::size_t first = knows_first_rates_ ? first_rate_passes : 0;
    const std::vector<ErrorOfStep> errors =
        executor_->run_judged(clock_, {first, complete, roles_}, cancel_);
    roles_.go_on();
    knows_first_rates_ = first_rate_passes > 0;
    // Smaller values than this are close to the smallest normal numbers, where errors are only
    // rounding errors.
    const double least = problem().precision == Precision::single ? 1e-30 : 1e-150;
    double largest = 0;
    for (const auto& [error, size] : errors) {
        if (!std::isfinite(error) || !std::isfinite(size)) return NAN;
        if (error > 0) largest = std::max(largest, error / (tolerance * std::max(size, least)));
    }
    return largest;
}

void Stepper::accept() {
    const std::optional<RateRegisters>& rates = problem().rate_registers;
    if (rates) executor_->exchange(rates->first, rates->last);
}

std::vector<Field> Stepper::curve() const {
    std::vector<Field> sums;
    const std::optional<RateRegisters>& exchanged = problem().rate_registers;
    for (const CurveRate& term : problem().curve) {
        RegisterId rate = term.rate;
        if (exchanged && (rate == exchanged->first || rate == exchanged->last)) {
            rate = rate == exchanged->first ? exchanged->last : exchanged->first;
        }
        const std::vector<Field>& rates = scratch(rate);
        const bool is_first = sums.empty();
        for (std::size_t k = 0; k < rates.size(); ++k) {
            if (is_first) sums.emplace_back(rates[k].layout(), rates[k].precision());
            sums[k].visit([&]<typename Number>(Plane<Number>& sum) {
                const auto weight = static_cast<Number>(term.factor);
                for (std::int64_t row = 0; row < sum.layout().row_count(); ++row) {
                    Number* const to = sum.row(row);
                    const Number* const from = rates[k].row<Number>(row);
                    for (std::int64_t i = 0; i < sum.layout().width; ++i) {
                        to[i] = (is_first ? Number{0} : to[i]) + weight * from[i];
                    }
                }
            });
        }
    }
    return sums;
}

void Stepper::pass_jump(SideMoment moment) {
    knows_first_rates_ = false;
    executor_->fill_halos(roles_.current, moment);
}

}  // namespace cascade
