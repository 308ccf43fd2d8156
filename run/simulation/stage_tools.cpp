// Binds the passes of steps, and computes the numbers that determine the length of steps.
#include "run/simulation/stage_tools.h"

#include "core/counted_cells.h"
#include "lang/calculus/diffusion.h"
#include "lang/lower/lower.h"
#include "lang/lower/step_plan.h"
#include "run/domain/field_values.h"
#include "run/stage/forcing.h"
#include "run/stage/plan_runner.h"
#include "solvers/step_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace cascade {
namespace {

constexpr std::int64_t fewest_moments = 16;
/// The largest number of evaluations of a formula in a cell, over all moments together. They take a
/// fraction of a second.
constexpr std::int64_t most_cells_of_moments = std::int64_t{1} << 23;

/// Returns the sum of |a − b| over the cells. Differences that are not finite count as 0.
double sum_of_changes(const Field& a, const Field& b, const Mask* counted) {
    double sum = 0;
    with_number(a.precision(), [&](auto zero) {
        using Number = decltype(zero);
        const auto &before = a.plane<Number>(), &after = b.plane<Number>();
        for_each_counted(before.layout(), counted, [&](std::int64_t row, std::int64_t i) {
            const double change = std::abs(double{after.row(row)[i]} - before.row(row)[i]);
            if (std::isfinite(change)) sum += change;
        });
    });
    return sum;
}

/// Returns the sum of |a − mean| over the cells. Values that are not finite are left out.
double sum_of_differences(const Field& a, const Mask* counted) {
    double sum = 0, cells = 0, differences = 0;
    a.visit([&](const auto& plane) {
        const auto for_each = [&](auto use) {
            for_each_counted(plane.layout(), counted, [&](std::int64_t row, std::int64_t i) {
                if (const double value = plane.row(row)[i]; std::isfinite(value)) use(value);
            });
        };
        for_each([&](double value) {
            sum += value;
            ++cells;
        });
        const double mean = cells > 0 ? sum / cells : 0;
        for_each([&](double value) { differences += std::abs(value - mean); });
    });
    return differences;
}

/// Returns the values, as a function of time, of a formula that contains only constants and `t`.
/// The view must outlive the result.
ValueAt values_at(const StageView& view, const Formula& formula) {
    const Grid one{1, 1, Boundary::periodic};
    const auto runner =
        std::make_shared<PlanRunner>(plan_view(view.program(), formula, view.number()),
                                     view.environment().kernels.interpreted_on(one));
    const auto alone = std::make_shared<Team>(1);
    return [view, runner, alone, one](double t) -> double {
        BindingContext context = view.context();
        context.grid = one;
        context.t = t;
        return runner->run(context, *alone)[0].number_at(0, 0);
    };
}

/// Returns how much a formula of constants, positions and `t` changes within 1/1000 of the
/// duration, at up to 1000 evenly spread moments. On large grids, there are fewer moments. Each
/// result is a sum of |change| over the cells, divided by a sum over the cells of |difference from
/// the mean|, which is taken at the moment at which it is largest.
std::vector<double> motion_over(const StageView& view, const Formula& formula, double duration) {
    const Environment& here = view.environment();
    const Formula* const formulas[] = {&formula};
    if (here.model) here.model->values->prepare(formulas);
    PlanRunner runner(plan_view(view.program(), formula, view.number()), here.kernels.once());
    const auto at = [&](double t) {
        BindingContext context = view.context();
        context.t = t;
        return runner.run(context, here.team)[0].clone();
    };
    constexpr auto most_moments = static_cast<std::int64_t>(Forcing::intervals_of_motion);
    const std::int64_t moments =
        std::clamp(most_cells_of_moments / here.grid.cell_count(), fewest_moments, most_moments);
    const double apart = duration / static_cast<double>(most_moments);
    std::vector<double> changes;
    double largest = 0;
    Field next;
    for (std::int64_t m = 0; m < moments; ++m) {
        const double t = duration * static_cast<double>(m) / static_cast<double>(moments);
        Field now = moments == most_moments && m > 0 ? std::move(next) : at(t);
        next = at(t + apart);
        changes.push_back(sum_of_changes(now, next, here.counted()));
        largest = std::max(largest, sum_of_differences(now, here.counted()));
    }
    for (double& change : changes) change = largest > 0 ? change / largest : 0;
    return changes;
}

/// Writes the plan's results to new temporaries, and returns these temporaries.
std::vector<TemporaryId> results_to_temporaries(StepPlan& plan) {
    std::vector<TemporaryId> planes;
    for (PassTarget& target : plan.passes.back().targets) {
        if (!std::holds_alternative<ResultId>(target.id)) continue;
        target = {planes.emplace_back(plan.temporaries++)};
    }
    plan.result_count = 0;
    return planes;
}

/// Stores the diffusion of a stage's species for the filters of semi-implicit solvers. Constant
/// factors are computed only once. A factor that changes is computed again in each step, as the
/// largest value of a plane.
class BoundDiffusion {
public:
    /// Returns the largest value of each formula over the cells, at the present state.
    using Largest = std::function<std::vector<double>(std::span<const Formula* const>)>;

    BoundDiffusion(const Program& program, std::uint32_t stage, const Largest& largest);

    /// Returns the passes that write the changing factors to temporary planes, before the passes of
    /// a step. There are no passes if no factor changes.
    const StepPlan& before() const { return before_; }

    /// Adds the factors to a problem that begins with the passes of before(). Each plane of a
    /// factor is reduced to its largest value.
    void add_to(StepProblem& problem) const;

private:
    std::vector<DiffusionTerms<StepProblem::DiffusionFactor>> factors_;
    StepPlan before_;
    std::vector<TemporaryId> planes_;  ///< The temporary that contains each changing factor.
};

BoundDiffusion::BoundDiffusion(const Program& program, std::uint32_t stage,
                               const Largest& largest) {
    const std::vector<SpeciesDiffusion> diffusion = diffusion_of(program, stage);
    factors_.resize(diffusion.size());
    std::vector<const Formula*> changing, constant;
    std::vector<StepProblem::DiffusionFactor*> found_once;
    for (std::size_t s = 0; s < diffusion.size(); ++s) {
        for (std::size_t k = 0; k < diffusion_terms; ++k) {
            const Formula& formula = diffusion[s][k];
            if (formula.nodes.empty()) continue;
            StepProblem::DiffusionFactor& factor = factors_[s][k];
            if (changes_in_time(program, stage, formula)) {
                factor.aggregate = AggregateId(changing.size());
                changing.push_back(&formula);
            } else {
                found_once.push_back(&factor);
                constant.push_back(&formula);
            }
        }
    }
    if (!constant.empty()) {
        const std::vector<double> values = largest(constant);
        for (std::size_t n = 0; n < values.size(); ++n) {
            found_once[n]->value = values[n];
        }
    }
    if (changing.empty()) return;
    before_ = plan_view(program, changing, stage);
    planes_ = results_to_temporaries(before_);
}

void BoundDiffusion::add_to(StepProblem& problem) const {
    problem.diffusion = factors_;
    for (auto& species : problem.diffusion) {
        for (StepProblem::DiffusionFactor& factor : species) {
            if (!factor.aggregate) continue;
            factor.aggregate = AggregateId(factor.aggregate->index() + problem.aggregates);
        }
    }
    for (const TemporaryId plane : planes_) {
        problem.passes[before_.passes.size()].reductions.push_back(
            {ReductionKind::largest, plane, AggregateId(problem.aggregates++)});
    }
}

NumberSource numbers_of(const StageView& view, std::span<const Formula* const> formulas) {
    const auto runner =
        std::make_shared<PlanRunner>(plan_view(view.program(), formulas, view.number()),
                                     view.environment().kernels.often());
    return [view, runner] {
        return first_values(runner->run(view.context(), view.environment().team));
    };
}

StepProblem bind_steps(const StageView& view, const Scheme& scheme, const Compile& compile) {
    const Environment& here = view.environment();
    const std::uint32_t k = view.number();
    const TimeAccount::Scope spent(here.account, Spent::compiling);
    std::vector<StepPlan> sweeps;
    for (const SweepForm& form : scheme.forms) sweeps.push_back(here.plans.sweep(k, form));
    const auto bind = [&](const StepPlan& before) {
        return bind_scheme(scheme, sweeps, before, compile, view.context(), view.system(), k);
    };
    if (!is_semi_implicit(view.stage().time.solver)) return bind({});
    const auto largest = [&](std::span<const Formula* const> formulas) {
        std::vector<double> values;
        for (const Field& field : view.evaluate(formulas)) {
            values.push_back(largest_value(field, here.inside()));
        }
        return values;
    };
    const BoundDiffusion diffusion(view.program(), k, largest);
    StepProblem problem = bind(diffusion.before());
    diffusion.add_to(problem);
    return problem;
}

}  // namespace

StageTools stage_tools(const StageView& view, Compile steps) {
    const Environment& here = view.environment();
    StageTools tools;
    tools.bind = [view, compile = std::move(steps)](const Scheme& scheme) {
        return bind_steps(view, scheme, compile);
    };
    tools.numbers = [view](std::span<const Formula* const> formulas) {
        return numbers_of(view, formulas);
    };
    tools.at_time = [view](const Formula& formula) { return values_at(view, formula); };
    tools.motion = [view](const Formula& formula, double duration) {
        return motion_over(view, formula, duration);
    };
    tools.condition_holds = [view, condition = NumberSource()]() mutable {
        if (!condition) {
            const Formula* const until[] = {&*view.stage().time.until};
            condition = numbers_of(view, until);
        }
        return condition()[0] != 0;
    };
    tools.estimate = [view, compile = here.kernels.often()] {
        const auto limit = view.stability(view.state().species(), compile).largest_speed;
        return limit ? 2 / *limit : 0;
    };
    tools.inside = here.counted();
    tools.model = here.model_facts();
    return tools;
}

StepInvariants find_step_invariants(const StageView& view) {
    const Environment& here = view.environment();
    const TimeAccount::Scope spent(here.account, Spent::starting);
    return view.step_invariants(here.plans.step_invariants(view.number()));
}

StepWork step_work(Simulation& simulation, std::uint32_t k) {
    StepWork work;
    simulation.change_stage(k, [&](StageState& state) {
        CHECK(state.started, "a stage is started before its steps are counted");
        StageView view = simulation.own_view(k);
        const StepInvariants invariants = find_step_invariants(view);
        view.use(invariants);
        StageTimer timer(view.program(), k, state,
                         stage_tools(view, {}));  // Passes are only bound. None is run.
        work = work_of(timer.problem());
    });
    return work;
}

}  // namespace cascade
