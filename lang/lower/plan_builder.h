// From a graph of expressions to a plan of passes (internal to lowering).
#pragma once

#include "lang/lower/lower_pass.h"
#include "lang/lower/step_plan.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cascade::lowering {

struct PlanRequest {
    const PlanGraph& graph;
    std::span<const NodeId> wanted;  ///< What the results are made of, in the own cell.
    PlanOptions options;
    bool frozen_is_mask = false;
    /// Species that take the first field slots of the last pass.
    std::span<const std::uint32_t> first_slots = {};
    /// What is known before the first pass, in the order of the numbers.
    std::span<const NodeId> step_invariants = {};
    /// With fewer roundings. Bits do not depend on what is computed once for all steps, but may on
    /// which operands are written to planes.
    bool contracts = false;
};

/// Plans and lowers the passes. The last one stays open for results, which are made of the values
/// that were wanted; then the plan is finished.
class PlanBuilder {
public:
    explicit PlanBuilder(const PlanRequest& request);

    KernelAssembly& last_pass() { return *last_; }
    /// The value that was wanted of a node, in the last pass.
    const Value& value(NodeId id) const { return values_->value(id); }
    void result(const std::string& name, ValueId value) { last_->builder().result(name, value); }

    /// Gives temporaries that live at different times one plane.
    StepPlan finish() &&;

private:
    void number_nodes();
    void lower(std::uint32_t pass);
    void close(std::uint32_t pass);
    void share_temporaries();

    PlanRequest request_;
    const PlanGraph& graph_;
    PassPlanner planner_;
    Storage storage_;
    std::vector<std::vector<NodeId>> written_;  ///< By pass.
    std::vector<NodeId> aggregates_;
    std::unique_ptr<KernelAssembly> last_;  ///< The kernel of the pass that is open.
    std::unique_ptr<PassLowering> values_;  ///< Its values.
    StepPlan plan_;
};

/// What the passes do and why: a line for the plan and one for each pass and each decision.
std::string describe(const PlanGraph& graph, const PassPlanner& planner, const StepPlan& plan);

}  // namespace cascade::lowering
