// From a graph of parts to a plan of passes (internal to lowering).
#pragma once

#include "lang/lower/lower_pass.h"
#include "lang/lower/step_plan.h"

#include <functional>
#include <span>
#include <string>

namespace cascade::lowering {

/// Emits the results of the last pass from the values of the parts that were wanted.
using EmitResults = std::function<void(KernelAssembly&, const PassLowering&)>;

struct PlanRequest {
    const PartGraph& graph;
    std::span<const PartId> wanted;  ///< What the results are made of, in the own cell.
    PlanOptions options;
    bool frozen_is_mask = false;
    /// Species that take the first field slots of the last pass.
    std::span<const std::uint32_t> first_slots = {};
    /// Parts that are known before the first pass, in the order of their numbers.
    std::span<const PartId> step_invariants = {};
    /// With fewer roundings. Bits do not depend on what is computed once for all steps, but may on
    /// which operands are written to planes.
    bool contracts = false;
};

/// Plans, lowers every pass, and gives temporaries that live at different times one plane.
StepPlan build_plan(const PlanRequest& request, const EmitResults& emit);

/// What the passes do and why: a line for the plan and one for each pass and each decision.
std::string describe(const PartGraph& graph, const PassPlanner& planner, const StepPlan& plan);

}  // namespace cascade::lowering
