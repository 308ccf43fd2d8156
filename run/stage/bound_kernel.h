// Binds the slots of plans to the values of a run.
#pragma once

#include "core/plane.h"
#include "ir/backend.h"
#include "lang/lower/lower.h"
#include "run/domain/domain_mask.h"
#include "run/domain/input_files.h"
#include "run/domain/model_cells.h"
#include "run/domain/surface_values.h"
#include "run/stage/stage_state.h"
#include "solvers/advance.h"
#include "solvers/scheme.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// A value that is the same in all steps (plan_step_invariants), so that it is computed only once.
struct StepInvariant {
    Field plane;               ///< Empty if the value is uniform.
    double number = 0;         ///< The value, if it is uniform.
    Boundaries boundary = {};  ///< The boundary that fills the halo of the plane.
};
using StepInvariants = IdVector<StepInvariantId, StepInvariant>;

/// The data of a stage of crawling cells. They replace the planes and links of a model.
struct TissueBinding {
    std::int64_t count = 0;  ///< The number of cells, without the unused positions of the last row.
    const Links* links = nullptr;  ///< The present neighbours of the cells.
    /// The plane for ModelPlane::number. It contains the cells' numbers, which are in order of
    /// birth.
    const Field* numbers = nullptr;
    /// The plane for ModelPlane::area. It contains 1 for each cell, because all cells have the same
    /// weight.
    const Field* ones = nullptr;
    /// Computes the values of the domain's planes at the cells: a result for each element of
    /// `sensed`.
    KernelPointer sense;
    std::vector<PlaneSource> sensed;
    /// The items that the kernel `sense` reads as a cell's position.
    std::array<StageItem, 3> place;
};

/// The values to which the slots of kernels are bound.
struct BindingContext {
    std::span<const StageState> states;
    const InputFiles& files;
    std::int64_t steps = 0;  ///< Complete steps of the stage to which the kernels belong.
    Grid grid;
    Precision precision = Precision::single;
    double t = 0;  ///< The stage's time.
    /// The planes of the metric, indexed by MetricPlane. Empty if the domain has no surface.
    std::span<const Field> metric = {};
    const ModelCells* model = nullptr;  ///< Null on grids.
    const DomainMask* mask = nullptr;   ///< Null if there is no mask.
    /// The values of a model that formulas read. Null on grids.
    SurfaceValues* surface_values = nullptr;
    /// The step-invariants. Null for steps that read none.
    const StepInvariants* step_invariants = nullptr;
    /// The data of a stage of crawling cells. Null for other stages.
    const TissueBinding* tissue = nullptr;
    /// The planes of lags, indexed by LagPart. Only given for kernels of convolutions.
    std::span<const Field> lags = {};
    /// The unknown of the constraint that is being solved. Null if none is being solved.
    const Field* unknown = nullptr;
};

/// Returns the plane of a slot. The source of the slot must have a plane and must not be a
/// temporary.
const Field& plane_of(const PlaneSource& source, const BindingContext& context);

/// Makes a kernel that can be run. May be empty if the problem only describes a step. Stages that
/// the step reads then need not have planes.
using Compile = std::function<KernelPointer(const CellKernel&)>;

/// Binds all slots of the passes of a plan. Species of `stage` are read from the old register.
/// Results go to the new register, in order. Also fills the halo of planes that never change.
StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context,
                      const System& system, std::uint32_t stage);

/// Binds the passes of all sweeps of a scheme. `plans` are the plans of the scheme's forms
/// (plan_sweep). The passes of `before`, if it has any, run first and write only temporaries.
StepProblem bind_scheme(const Scheme& scheme, std::span<const StepPlan> plans,
                        const StepPlan& before, const Compile& compile,
                        const BindingContext& context, const System& system, std::uint32_t stage);

/// Binds the passes of a plan that is not part of the steps of a stage. The plan reads no
/// registers, and writes its results to the new register.
StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context);

/// Returns the name of species number `species`.
std::string species_name(const System& system, std::size_t species);

}  // namespace cascade
