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

/// A step-invariant value (plan_step_invariants), which is computed once.
struct StepInvariant {
    Field plane;               ///< Empty if the value is uniform.
    double number = 0;         ///< The value if it is uniform.
    Boundaries boundary = {};  ///< The rules that fill the halo of the plane.
};
using StepInvariants = IdVector<StepInvariantId, StepInvariant>;

/// The data of a stage of crawling cells, which replace the planes and links of a model.
struct TissueBinding {
    std::int64_t count = 0;  ///< The number of cells, without the unused positions of the last row.
    const Links* links = nullptr;  ///< The present neighbours of the cells.
    /// The plane of ModelPlane::number. It contains the cells' numbers, in order of birth.
    const Field* numbers = nullptr;
    /// The plane of ModelPlane::area. It contains 1 for each cell, because all cells have the same
    /// weight.
    const Field* ones = nullptr;
    /// Computes the values of the domain's planes at the cells: one result for each of `sensed`.
    KernelPointer sense;
    std::vector<PlaneSource> sensed;
    /// The items that the kernel `sense` reads as a cell's position.
    std::array<StageItem, 3> place;
};

/// The values to which the slots of kernels are bound.
struct BindingContext {
    std::span<const StageState> states;
    const InputFiles& files;
    std::int64_t steps = 0;  ///< Complete steps of the stage to which the kernel belongs.
    Grid grid;
    Precision precision = Precision::single;
    double t = 0;  ///< The stage's time.
    /// Indexed by MetricPlane. Empty if the domain has no surface.
    std::span<const Field> metric = {};
    const ModelCells* model = nullptr;                ///< Null on grids.
    const DomainMask* mask = nullptr;                 ///< Null if all cells belong to the domain.
    SurfaceValues* surface_values = nullptr;          ///< Given on models.
    const StepInvariants* step_invariants = nullptr;  ///< Given for the steps that read them.
    const TissueBinding* tissue = nullptr;            ///< Given for stages of crawling cells.
    /// Indexed by LagPart. Given for kernels of convolutions.
    std::span<const Field> lags = {};
    /// The unknown of the constraint that is being solved.
    const Field* unknown = nullptr;
};

/// The plane of a slot. The source must have a plane and must not be a temporary.
const Field& plane_of(const PlaneSource& source, const BindingContext& context);

/// Makes a kernel that can be run. If the function is empty, the problem only describes a step, and
/// stages that the step reads need not have planes.
using Compile = std::function<KernelPointer(const CellKernel&)>;

/// The passes of a plan with all slots bound. Species of `stage` are read from the old register.
/// Results go to the new register, in order. The halo of planes that never change is filled here.
StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context,
                      const System& system, std::uint32_t stage);

/// The passes of all sweeps of a scheme. `plans` are the plans of the scheme's forms (plan_sweep).
/// The passes of `before`, if any, run first and write only temporaries.
StepProblem bind_scheme(const Scheme& scheme, std::span<const StepPlan> plans,
                        const StepPlan& before, const Compile& compile,
                        const BindingContext& context, const System& system, std::uint32_t stage);

/// The passes of a plan outside of the steps of a stage. It reads no registers, and writes its
/// results to the new register.
StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context);

/// The name of species number `species`.
std::string species_name(const System& system, std::size_t species);

}  // namespace cascade
