// Puts the values of a run into the slots of plans.
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

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// What no step of a stage changes (plan_step_invariants), computed once.
struct StepInvariants {
    std::vector<Field> planes;           ///< Where it varies; empty where it does not,
    std::vector<double> numbers;         ///< and is one number.
    std::vector<Boundaries> boundaries;  ///< How the halo of each plane is filled.
};

/// Where slots find their values.
struct BindingContext {
    std::span<const StageState> states;
    const InputFiles& files;
    std::int64_t steps = 0;  ///< Complete steps of the stage the kernel belongs to.
    Grid grid;
    Precision precision = Precision::single;
    double t = 0;                             ///< Its time.
    std::span<const Field> metric = {};       ///< By MetricPlane; empty without a surface.
    const ModelCells* model = nullptr;        ///< None on grids.
    const DomainMask* mask = nullptr;         ///< None where all cells belong to the domain.
    SurfaceValues* surface_values = nullptr;  ///< Of a model.
    const StepInvariants* step_invariants = nullptr;  ///< Of the steps that are bound.
};

/// The plane of a slot that lies in one and is no temporary.
const Field& plane_of(const SlotSource& source, const BindingContext& context);

/// Makes a kernel runnable.
using Compile = std::function<KernelPointer(const CellKernel&)>;

/// The passes of a plan with all their slots. Species of `stage` are those of register 0 and
/// results go to register 1, in order; planes that do not change have their halo filled here.
StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context,
                      const System& system, std::uint32_t stage);

/// The passes of all sweeps of a scheme; `plans` are those of its forms (plan_sweep). Those of
/// `before`, which may have none, come first: they write temporaries alone.
StepProblem bind_scheme(const Scheme& scheme, std::span<const StepPlan> plans,
                        const StepPlan& before, const Compile& compile,
                        const BindingContext& context, const System& system, std::uint32_t stage);

/// The passes of a plan that is no part of a stage's steps: no species is a register of it, and
/// results go to register 1.
StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context);

/// The name of species number `species`.
std::string species_name(const System& system, std::size_t species);

}  // namespace cascade
