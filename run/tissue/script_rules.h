// Evaluates the equations of a stage of crawling cells for the time loop of a tissue.
#pragma once

#include "run/stage/stage_plans.h"
#include "run/tissue/tissue_binding.h"
#include "tissue/tissue_rules.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace cascade {

/// Returns the formula of a component of a vector. `number` is 0, 1 or 2 for x, y or z.
Formula component_of(const Formula& vector, int number);

/// Binds the plans of a stage to the planes of its tissue.
class ScriptRules : public TissueRules {
public:
    struct Makers {
        StagePlans& plans;
        Compile steps;   ///< Compiles kernels for steps and rates.
        Compile seldom;  ///< Compiles kernels for formulas that are evaluated at divisions.
    };
    ScriptRules(TissueStage stage, Makers makers, std::shared_ptr<NearTriangles> near);

    void bind(const Tissue& tissue, const Links& links) override;
    TissueStep step(std::uint32_t stages) override;
    CellValues rates() override { return values_of(rates_, makers_.steps); }
    Conditions conditions() override;
    CellValues along() override { return values_of(along_, makers_.seldom); }
    Restarts restarts() override { return {values_of(restarts_, makers_.seldom), restarted_}; }

private:
    /// A group of formulas whose values are read together. Their plan is bound when the values are
    /// first needed.
    struct Values {
        std::optional<StepPlan> plan;
        std::unique_ptr<StepProblem> problem;
    };
    CellValues values_of(Values& values, const Compile& compile);
    std::vector<const StepPlan*> all_plans();
    BindingContext context() const;

    TissueStage stage_;
    Makers makers_;
    std::shared_ptr<NearTriangles> near_;
    TissueBinding binding_;
    Grid grid_;
    Values rates_, conditions_, along_, restarts_;
    /// Describes each result of `restarts_`. The results belong to planes that are kept from step
    /// to step: species, which are described by their indices, and other items, which are described
    /// by the number of species plus their indices.
    std::vector<std::size_t> restarted_;
    struct Step {
        std::unique_ptr<StepProblem> problem;
        std::vector<RegisterId> states;
    };
    std::map<std::uint32_t, Step> steps_;  ///< The bound step for each number of stages of a step.
};

}  // namespace cascade
