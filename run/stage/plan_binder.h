// Resolves the slots of a plan's passes to registers, planes and numbers. Records which planes need
// a halo and for which moments.
#pragma once

#include "run/stage/bound_kernel.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

/// Returns the number of cells over which means are taken. 0 stands for all cells.
std::int64_t cells_inside(const BindingContext& context);

/// Returns the links of cells, with all weights that the kernels of these plans read. Returns null
/// on grids.
const Links* links_of(const BindingContext& context, std::span<const StepPlan* const> plans);

/// Sets the rules at the sides for the steps of a stage. Marks no species as needing a halo.
void take_sides(StepProblem& problem, const BindingContext& context, const System& system,
                std::uint32_t stage);

/// Binds one plan. bind() may be called only once. All arguments must outlive the binder.
class PlanBinder {
public:
    PlanBinder(const StepPlan& plan, const BindingContext& context, const System* system,
               std::uint32_t stage, const SweepForm* form = nullptr, const Sweep* sweep = nullptr,
               std::vector<double> read_at = {});

    /// Writes the results of the plan to the last temporaries of the problem.
    void keep_results() { keeps_results_ = true; }
    /// For each species, whether it is read at neighbours. May be extended by the entries that
    /// other plans of the same step need.
    std::vector<bool>& species_needs_halo() { return problem_.species_needs_halo; }
    /// Says for each register of the scheme whether a sweep reads it at neighbours.
    void set_halo_registers(const IdVector<RegisterId, bool>& registers) {
        halo_registers_ = registers;
    }

    StepProblem bind(const Compile& compile);

private:
    using PlaneRef = StepProblem::PlaneRef;
    using SpeciesPlane = StepProblem::SpeciesPlane;
    bool is_species(StageItem item) const {
        return system_ != nullptr && item.stage == stage_ && system_->is_species(item.item);
    }

    std::optional<TemporaryId> sensed(const PlaneSource& source) const;
    bool reads_what_is_sensed() const;

    /// The values that the plans of a constraint read and write, and the binders of these plans.
    struct OfConstraint {
        BindingContext context;
        std::shared_ptr<Field> unknown;
        std::shared_ptr<StepInvariants> constant;
        /// A binder for each of the plans `whole`, `linear` and, if it exists, `parts`.
        std::vector<PlanBinder> binders;
    };
    void add_constraint(const Solve& solve);
    StepProblem::Solve bind_constraint(const Solve& solve, const Compile& compile);
    StepProblem::Pass sense();
    PlaneRef bind_plane(const PlaneSource& source) const;

    /// Returns the register from which rates read a species.
    RegisterId register_of(SpeciesId species) const {
        if (sweep_ == nullptr) return old_register;
        return species.index() < sweep_->renewed ? new_register : sweep_->inputs[0];
    }

    SideRules sides_of(const PlaneSource& source) const;
    void find_halos(const Pass& pass);
    StepProblem::Pass bind_pass(const Pass& pass) const;
    static void check_overwritten(const CellKernel& kernel, const StepProblem::Pass& bound);
    void bind_uniform(const UniformSource& source, StepProblem::Pass& bound) const;
    StepProblem::Result bind_result(const PassTarget& target) const;

    const StepPlan& plan_;
    const BindingContext& context_;
    const System* system_;  ///< If null, no species is bound to a register.
    std::uint32_t stage_;
    const SweepForm* form_;  ///< The form of the sweep. Null for a plan outside of a scheme.
    const Sweep* sweep_;
    /// For each output of the sweep, the moment at which rates read it.
    std::vector<double> read_at_;
    bool senses_ = false;  ///< Whether passes read values that cells sense at their positions.
    bool keeps_results_ = false;
    std::map<const Solve*, std::unique_ptr<OfConstraint>> constraints_;
    StepProblem problem_;
    IdVector<TemporaryId, bool> temporary_needs_halo_;
    IdVector<RegisterId, bool> halo_registers_;
};

}  // namespace cascade
