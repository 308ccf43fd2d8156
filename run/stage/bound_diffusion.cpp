// Constant factors are computed once. A factor that changes is the largest value of a plane, an
// aggregate of each step.
#include "run/stage/bound_diffusion.h"

#include "lang/lower/lower.h"

namespace cascade {

namespace {

/// Turns the plan's results into temporaries after its own; returns them.
std::vector<TemporaryId> results_to_temporaries(StepPlan& plan) {
    std::vector<TemporaryId> planes;
    for (PassTarget& target : plan.passes.back().targets) {
        if (!std::holds_alternative<ResultId>(target.id)) continue;
        target = {planes.emplace_back(plan.temporaries++)};
    }
    plan.result_count = 0;
    return planes;
}

}  // namespace

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

}  // namespace cascade
