// The present state of a stage and of the stages before it, on which formulas can be evaluated.
#pragma once

#include "core/plane.h"
#include "lang/program/program.h"
#include "run/simulation/environment.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/stage_state.h"
#include "run/stage/step_advice.h"
#include "solvers/stability.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

class StageView {
public:
    /// All arguments must outlive the view. `invariants` are the step-invariants. They may be null
    /// if no steps are taken.
    StageView(const Environment& environment, std::span<const StageState> states,
              std::uint32_t stage, const StepInvariants* invariants = nullptr)
        : environment_(&environment), states_(states), number_(stage), invariants_(invariants) {}

    const Environment& environment() const { return *environment_; }
    std::uint32_t number() const { return number_; }
    std::span<const StageState> states() const { return states_; }
    /// Sets the step-invariants for the following steps. They must outlive the view.
    void use(const StepInvariants& invariants) { invariants_ = &invariants; }
    const Program& program() const { return *environment_->program; }
    const Stage& stage() const { return environment_->stage(number_); }
    const System& system() const { return program().system_of(number_); }
    const StageState& state() const { return states_[number_]; }

    /// Returns the context through which the slots of kernels are bound to present values.
    BindingContext context() const;
    /// Evaluates a plan that is not part of a step.
    std::vector<Field> evaluate(const StepPlan& plan) const { return run(plan, {}); }
    std::vector<Field> evaluate(std::span<const Formula* const> formulas) const;
    std::vector<Field> evaluate(const Formula& formula) const;
    /// Computes step-invariants by a plan of plan_step_invariants().
    StepInvariants step_invariants(const StepPlan& once) const;
    /// Returns the present rates of all species.
    std::vector<Field> rates() const;
    /// Computes the starting values of all species anew.
    std::vector<Field> starting_species() const;

    /// Estimates the stability of the rates for these values of the species.
    StabilityEstimate stability(std::span<const Field> species) const {
        return stability(species, environment_->kernels.once());
    }
    StabilityEstimate stability(std::span<const Field> species, const Compile& compile,
                                const std::atomic<bool>* cancel = nullptr) const;
    /// Whether all cells are frozen, so that no step changes anything.
    bool is_frozen() const;
    StepInUse step_in_use() const;
    /// Whether, in the present state, diffusion limits steps to a far shorter length than the
    /// reaction would.
    bool diffusion_limits() const;

private:
    std::vector<Field> run(const StepPlan& plan, std::span<const Formula* const> formulas) const;
    const Field* species_alone(const Formula& formula) const;
    template <typename Use>
    auto with_rates(const Use& use) const;

    const Environment* environment_;
    std::span<const StageState> states_;
    std::uint32_t number_;
    const StepInvariants* invariants_;
};

/// Replaces the species of a state. The destructor restores them.
class OtherSpecies {
public:
    OtherSpecies(StageState& state, std::vector<Field> species);
    ~OtherSpecies();
    OtherSpecies(const OtherSpecies&) = delete;
    OtherSpecies& operator=(const OtherSpecies&) = delete;

private:
    StageState& state_;
    std::vector<Field> own_;
};

}  // namespace cascade
