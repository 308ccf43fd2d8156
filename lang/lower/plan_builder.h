// Turns a graph of expressions into a plan of passes (internal to lowering).
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
    std::span<const NodeId> wanted;  ///< The nodes from which results are made, in the cell itself.
    PlanOptions options;
    bool frozen_is_mask = false;
    /// The species in the first field slots of the last pass.
    std::span<const ItemId> first_slots = {};
    /// The nodes known before the first pass, in the order of their numbers.
    std::span<const NodeId> step_invariants = {};
    /// Compute with fewer roundings inside of nodes, too; see fuse_products().
    bool contracts = false;
};

/// Plans and lowers the passes. The last one stays open until results have been added from the
/// wanted values; then the plan is finished.
class PlanBuilder {
public:
    explicit PlanBuilder(const PlanRequest& request);

    KernelAssembly& last_pass() { return *last_; }
    /// The value of a wanted node in the last pass.
    const Value& value(NodeId id) const { return values_->value(id); }
    void result(const std::string& name, ValueId value) { last_->builder().result(name, value); }

    /// Lets temporaries that live at different times share a plane.
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
    std::vector<std::vector<NodeId>> written_;   ///< By pass.
    std::vector<std::vector<NodeId>> nonlocal_;  ///< By the pass before which they are computed.
    std::vector<NodeId> aggregates_;
    std::unique_ptr<KernelAssembly> last_;  ///< The kernel of the open pass.
    std::unique_ptr<PassLowering> values_;  ///< The values of that kernel.
    StepPlan plan_;
};

/// Describes the passes and the reasons for them: one line for the plan, for each pass and for each
/// decision.
std::string describe(const PlanGraph& graph, const PassPlanner& planner, const StepPlan& plan);

}  // namespace cascade::lowering
