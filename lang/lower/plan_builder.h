// Turns an expression graph into a plan of passes (internal to lowering).
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
    /// The nodes whose values in the cell itself give the results.
    std::span<const NodeId> wanted;
    PlanOptions options;
    bool frozen_is_mask = false;
    /// The species that take the first field slots of the last pass.
    std::span<const ItemId> first_slots = {};
    /// The nodes that are known before the first pass, in the order of their step-invariant ids.
    std::span<const NodeId> step_invariants = {};
    /// Whether products and sums in operators and functions are fused, so that they are rounded
    /// less often (fuse_products()).
    bool contracts = false;
};

/// Plans and lowers the passes. The last pass stays open: the caller computes results from the
/// wanted values and adds them to this pass. finish() completes the plan.
class PlanBuilder {
public:
    explicit PlanBuilder(const PlanRequest& request);

    KernelAssembly& last_pass() { return *last_; }
    /// The value of a wanted node in the last pass.
    const Value& value(NodeId id) const { return values_->value(id); }
    void result(const std::string& name, ValueId value) { last_->builder().result(name, value); }

    /// Completes the plan. Temporaries that are not needed at the same time share a plane.
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
    std::vector<std::vector<NodeId>> written_;  ///< For each pass, the nodes that it writes.
    /// For each pass, the nodes that are computed directly before it.
    std::vector<std::vector<NodeId>> nonlocal_;
    std::vector<NodeId> aggregates_;
    std::unique_ptr<KernelAssembly> last_;  ///< The kernel of the open pass.
    std::unique_ptr<PassLowering> values_;  ///< The values in the kernel of the open pass.
    StepPlan plan_;
};

/// Describes the passes and the reasons for them, with one line for the plan, one line for each
/// pass, and one line for each decision.
std::string describe(const PlanGraph& graph, const PassPlanner& planner, const StepPlan& plan);

}  // namespace cascade::lowering
