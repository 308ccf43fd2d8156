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

/// A step-invariant value (plan_step_invariants), computed once.
struct StepInvariant {
    Field plane;               ///< Empty if the value is the same in all cells …
    double number = 0;         ///< … and is this number.
    Boundaries boundary = {};  ///< How the halo of the plane is filled.
};
using StepInvariants = IdVector<StepInvariantId, StepInvariant>;

/// What a stage of cells that crawl reads instead of the planes and links of a model.
struct TissueBinding {
    std::int64_t count = 0;          ///< Cells, without the padding of the last row.
    const Links* links = nullptr;    ///< Their present neighbours.
    const Field* numbers = nullptr;  ///< ModelPlane::number: their numbers, in order of birth;
    const Field* ones = nullptr;     ///< ModelPlane::area: all cells count alike.
    /// Computes what cells sense at their places: one result for each of `sensed`.
    KernelPointer sense;
    std::vector<PlaneSource> sensed;
    std::array<StageItem, 3> place;  ///< The fields of that kernel.
};

/// Where slots get their values.
struct BindingContext {
    std::span<const StageState> states;
    const InputFiles& files;
    std::int64_t steps = 0;  ///< Complete steps of the stage the kernel belongs to.
    Grid grid;
    Precision precision = Precision::single;
    double t = 0;                                     ///< The stage's time.
    std::span<const Field> metric = {};               ///< By MetricPlane; empty without a surface.
    const ModelCells* model = nullptr;                ///< Null on grids.
    const DomainMask* mask = nullptr;                 ///< Null if all cells belong to the domain.
    SurfaceValues* surface_values = nullptr;          ///< For a model.
    const StepInvariants* step_invariants = nullptr;  ///< For the steps that are bound.
    const TissueBinding* tissue = nullptr;            ///< For a stage of cells that crawl.
    std::span<const Field> lags = {};                 ///< By LagPart; for kernels of convolutions.
    const Field* unknown = nullptr;                   ///< Of the constraint that is solved.
};

/// The plane of a slot whose values lie in one, other than a temporary.
const Field& plane_of(const PlaneSource& source, const BindingContext& context);

/// Creates a kernel that can be run. An empty function creates none: the problem then only
/// describes a step, and stages that it reads need not have planes.
using Compile = std::function<KernelPointer(const CellKernel&)>;

/// The passes of a plan with all slots bound. Species of `stage` are those of the old register,
/// and results go to the new one, in order. The halo of planes that do not change is filled here.
StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context,
                      const System& system, std::uint32_t stage);

/// The passes of all sweeps of a scheme; `plans` are those of its forms (plan_sweep). The passes of
/// `before`, if any, come first and write only temporaries.
StepProblem bind_scheme(const Scheme& scheme, std::span<const StepPlan> plans,
                        const StepPlan& before, const Compile& compile,
                        const BindingContext& context, const System& system, std::uint32_t stage);

/// The passes of a plan that is not part of a stage's steps: it reads no registers, and results go
/// to the new one.
StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context);

/// The name of species number `species`.
std::string species_name(const System& system, std::size_t species);

}  // namespace cascade
