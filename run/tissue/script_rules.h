// The equations of a stage of crawling cells, for the time loop of a tissue.
#pragma once

#include "run/stage/stage_plans.h"
#include "run/tissue/tissue_binding.h"
#include "tissue/tissue_rules.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace cascade {

/// One component, 0 to 2, of a vector.
Formula component_of(const Formula& vector, int number);

/// Binds the plans of a stage to the planes of its tissue.
class ScriptRules : public TissueRules {
public:
    struct Makers {
        StagePlans& plans;
        Compile steps;   ///< For steps and rates.
        Compile seldom;  ///< For formulas evaluated at divisions.
    };
    ScriptRules(TissueStage stage, Makers makers, std::shared_ptr<NearTriangles> near);

    void bind(const Tissue& tissue, const Links& links) override;
    TissueStep step(std::uint32_t stages) override;
    CellValues rates() override { return values_of(rates_, makers_.steps); }
    Conditions conditions() override;
    CellValues along() override { return values_of(along_, makers_.seldom); }
    Restarts restarts() override { return {values_of(restarts_, makers_.seldom), restarted_}; }

private:
    /// Values of formulas, bound on the first request.
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
    std::vector<std::size_t> restarted_;  ///< Species, then kept planes.
    struct Step {
        std::unique_ptr<StepProblem> problem;
        std::vector<RegisterId> states;
    };
    std::map<std::uint32_t, Step> steps_;  ///< By number of stages.
};

}  // namespace cascade
