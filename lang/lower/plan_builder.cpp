// Builds the passes of a plan, and the targets and temporaries of each pass.
#include "lang/lower/plan_builder.h"

#include "ir/contraction.h"
#include "lang/lower/lower_expressions.h"
#include "lang/lower/plan_graph.h"
#include "lang/lower/step_plan.h"
#include "lang/program/calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

namespace cascade::lowering {

namespace {

/// The plan for a formula of a convolution's kernel. In this plan, each cell represents a lag.
std::shared_ptr<const StepPlan> plan_of_kernel(const PlanGraph& graph, const Formula& formula) {
    const std::array only{&formula};
    const PassContext context{graph.program(), graph.stage(), Extent::grid};
    const PlanGraph lags(lower_expressions(flat_formulas(only, context), context), context);
    PlanBuilder builder({lags, lags.roots(), {}});
    builder.result("value", builder.value(lags.roots()[0])[0]);
    return std::make_shared<const StepPlan>(std::move(builder).finish());
}

Convolution convolution(const PlanGraph& graph, NodeId id, const PlaneSource& operand,
                        TemporaryId target) {
    const ConvolutionKernel& kernel =
        graph.program().literals->kernel(graph[id].as<Call>()->detail);
    Convolution made{operand, target, graph.boundary(id), plan_of_kernel(graph, kernel.weight), {}};
    if (!kernel.reach.nodes.empty()) made.reach = plan_of_kernel(graph, kernel.reach);
    return made;
}

/// Calls visit(source) for every plane and number that a pass reads.
template <typename Visit>
void for_each_read(Pass& pass, const Visit& visit) {
    for (Convolution& convolution : pass.convolutions) visit(convolution.operand);
    for (Reduction& reduction : pass.reductions) visit(reduction.operand);
    for (PlaneSource& source : pass.bound.fields) visit(source);
}

// Plans of constraints. The linear part of an expression is found node by node. It is a sum of
// linear parts, or an operator applied to a linear part. Values that do not depend on the unknown
// are computed once for each solution.

using LinearParts = IdVector<NodeId, std::optional<NodeId>>;

/// Adds the linear part of a node to the graph, and returns it. nullopt if the node does not depend
/// on the unknown.
std::optional<NodeId> linear_part(ExpressionGraph& graph, NodeId id, const LinearParts& parts) {
    Node node = graph[id];
    if (node.is<Unknown>()) return id;
    bool depends = false;
    for (const NodeId operand : node.reads()) depends = depends || parts[operand].has_value();
    if (!depends) return std::nullopt;
    if (calls(node, is_sum)) {
        const auto first = parts[node.operands[0]], second = parts[node.operands[1]];
        if (!second) return first;
        if (!first && node.calls(Function::add)) return second;
        if (!first) return graph.call(Function::negate, {*second}, node.type);
    }
    const NodeId zero = graph.number(0);
    for (std::size_t k = 0; k < node.operand_count; ++k) {
        NodeId& operand = node.operands[k];
        if (parts[operand]) {
            operand = *parts[operand];
        } else if (is_jointly_linear(node.function) &&
                   is_linear_in(node.function, k, node.operand_count)) {
            operand = zero;  // Terms that do not contain the unknown are left out.
        }
    }
    return graph.add(node);
}

/// The linear part of `root`, in a separate graph.
Expressions linear_part(const Expressions& from, NodeId root) {
    Expressions linear = from;
    LinearParts parts;
    for (const NodeId id : ids_below<NodeId>(root.index() + 1)) {
        parts.push_back(linear_part(linear.graph, id, parts));
    }
    linear.roots = {parts[root] ? *parts[root] : linear.graph.number(0)};
    return linear;
}

/// The largest expressions that vary, do not depend on the unknown, and are not in a plane.
std::vector<NodeId> constant_parts(const PlanGraph& graph) {
    IdVector<NodeId, bool> depends, needed(graph.size(), false);
    for (const NodeId id : graph.ids()) {
        bool reads_it = graph[id].is<Unknown>();
        for (const NodeId operand : operands_of(graph[id])) reads_it = reads_it || depends[operand];
        depends.push_back(reads_it);
    }
    for (const NodeId root : graph.roots()) needed[root] = true;
    std::vector<NodeId> parts;
    for (const NodeId id : graph.ids_backwards()) {
        if (!needed[id]) continue;
        const bool is_kept = !depends[id] && !graph.is_uniform(id) && !graph.is_plane(id) &&
                             !graph.is_open(id) && graph[id].type == ValueType::number;
        if (is_kept) parts.insert(parts.begin(), id);
        if (is_kept) continue;
        for (const NodeId operand : operands_of(graph[id])) needed[operand] = true;
    }
    return parts;
}

/// A plan that computes the values `wanted`, which are 0 outside the mask.
std::shared_ptr<const StepPlan> plan_of(const PlanGraph& graph, std::span<const NodeId> wanted,
                                        std::span<const NodeId> known) {
    PlanBuilder builder({graph, wanted, {}, false, {}, known});
    for (const NodeId id : wanted) {
        builder.result("value", builder.last_pass().within_mask(builder.value(id)[0], 0));
    }
    StepPlan plan = std::move(builder).finish();
    std::size_t next = 0;
    for (PassTarget& target : plan.passes.back().targets) {
        if (std::holds_alternative<ResultId>(target.id)) {
            target.boundary = graph.boundary(wanted[next++]);
        }
    }
    return std::make_shared<const StepPlan>(std::move(plan));
}

/// Plans how the field that a constraint determines is found. The checker ensures that the operand
/// of `solved` is linear in the unknown field.
Solve plan_of_constraint(const PlanGraph& graph, NodeId solved, TemporaryId target) {
    const Node& node = graph[solved];
    const NodeId root = node.operands[0];
    Solve solve;
    solve.target = target;
    solve.constraint = node.as<Call>()->detail;
    solve.stage = graph.stage();
    solve.boundary = graph.boundary(solved);
    solve.wall = graph.wall(solved);
    Expressions whole = graph.expressions();
    whole.roots = {root};
    const PlanGraph of_whole(std::move(whole), graph.context());
    solve.whole = plan_of(of_whole, of_whole.roots(), {});
    const PlanGraph linear(linear_part(graph.expressions(), root), graph.context());
    const std::vector<NodeId> parts = constant_parts(linear);
    solve.linear = plan_of(linear, linear.roots(), parts);
    if (!parts.empty()) solve.parts = plan_of(linear, parts, {});
    return solve;
}

}  // namespace

PlanBuilder::PlanBuilder(const PlanRequest& request)
    : request_(request),
      graph_(request.graph),
      planner_(graph_, request.wanted, request.options.materialise, request.step_invariants),
      written_(planner_.pass_count()),
      nonlocal_(planner_.pass_count()) {
    plan_.passes.resize(planner_.pass_count());
    number_nodes();
    for (std::uint32_t pass = 0; pass < planner_.pass_count(); ++pass) {
        if (pass > 0) close(pass - 1);
        lower(pass);
    }
}

void PlanBuilder::number_nodes() {
    storage_.temporary.resize(graph_.size());
    storage_.aggregate.resize(graph_.size());
    storage_.step_invariant.resize(graph_.size());
    for (const NodeId id : request_.step_invariants) {
        storage_.step_invariant[id] = StepInvariantId(plan_.step_invariants++);
    }
    for (const NodeId id : graph_.ids()) {
        if (!planner_.is_needed(id) || planner_.is_step_invariant(id)) continue;
        if (planner_.is_written(id)) {
            storage_.temporary[id] = TemporaryId(plan_.temporaries++);
            auto& of_pass = is_nonlocal(graph_[id]) ? nonlocal_ : written_;
            of_pass[planner_.pass_of(id)].push_back(id);
        }
        if (is_aggregate(graph_[id])) {
            storage_.aggregate[id] = AggregateId(plan_.aggregates++);
            aggregates_.push_back(id);
        }
    }
}

void PlanBuilder::lower(std::uint32_t pass) {
    const bool is_last = pass + 1 == planner_.pass_count();
    last_ = std::make_unique<KernelAssembly>(graph_.context(), request_.frozen_is_mask,
                                             request_.contracts ? EqualProducts::are_several
                                                                : EqualProducts::are_one);
    std::vector<NodeId> wanted = written_[pass];
    if (is_last) {
        for (const ItemId item : request_.first_slots) {
            last_->field_slot(StageItem{graph_.stage(), item});
        }
        wanted.insert(wanted.end(), request_.wanted.begin(), request_.wanted.end());
    }
    const PassView view{graph_, planner_, storage_, pass};
    values_ = std::make_unique<PassLowering>(view, *last_, wanted);
    for (const NodeId id : written_[pass]) {
        const std::string& name = graph_.name(id);
        const TemporaryId target = storage_.temporary[id];
        result(name.empty() ? fmt::format("(temporary {})", target.index()) : name, value(id)[0]);
        plan_.passes[pass].targets.push_back({target, false, graph_.boundary(id), graph_.wall(id)});
    }
    // A nonlocal node may read whole planes that any earlier pass has written.
    const PassView after{graph_, planner_, storage_, planner_.pass_count()};
    for (const NodeId id : nonlocal_[pass]) {
        if (solved_constraint(graph_[id])) {
            plan_.passes[pass].solves.push_back(
                plan_of_constraint(graph_, id, storage_.temporary[id]));
            continue;
        }
        plan_.passes[pass].convolutions.push_back(
            convolution(graph_, id, after.plane(graph_[id].operands[0]), storage_.temporary[id]));
    }
    for (const NodeId id : aggregates_) {
        if (planner_.pass_of(id) != pass) continue;
        plan_.passes[pass].reductions.push_back({*reduction_of(graph_[id].function),
                                                 after.plane(graph_[id].operands[0]),
                                                 storage_.aggregate[id]});
    }
}

void PlanBuilder::close(std::uint32_t pass) {
    values_.reset();
    BoundKernel& bound = plan_.passes[pass].bound;
    bound = std::move(*last_).finish();
    if (request_.contracts)
        bound.kernel = std::make_shared<const CellKernel>(contracted(*bound.kernel));
}

StepPlan PlanBuilder::finish() && {
    close(planner_.pass_count() - 1);
    Pass& last = plan_.passes.back();
    while (last.targets.size() < last.bound.kernel->results.size()) {
        last.targets.push_back({ResultId(plan_.result_count++), false, {}, {}});
    }
    share_temporaries();
    plan_.is_uniform =
        std::ranges::all_of(request_.wanted, [&](NodeId id) { return graph_.is_uniform(id); });
    if (request_.options.describe) plan_.words = describe(graph_, planner_, plan_);
    return std::move(plan_);
}

/// Numbers the planes of temporaries. After the last pass that reads a temporary, its plane is used
/// for other temporaries.
void PlanBuilder::share_temporaries() {
    IdVector<TemporaryId, std::size_t> last_read(plan_.temporaries, 0);
    for (std::size_t pass = 0; pass < plan_.passes.size(); ++pass) {
        for_each_read(plan_.passes[pass], [&](PlaneSource& source) {
            if (const auto* id = std::get_if<TemporaryId>(&source)) last_read[*id] = pass;
        });
    }
    IdVector<TemporaryId, TemporaryId> plane(plan_.temporaries);
    std::vector<TemporaryId> free;
    std::vector<std::vector<TemporaryId>> freed_after(plan_.passes.size());
    std::uint32_t count = 0;
    const auto write = [&](TemporaryId& target, std::size_t pass) {
        const TemporaryId written = target;
        if (free.empty()) free.emplace_back(count++);
        target = plane[written] = free.back();
        free.pop_back();
        freed_after[std::max(last_read[written], pass)].push_back(target);
    };
    for (std::size_t pass = 0; pass < plan_.passes.size(); ++pass) {
        for (Solve& each : plan_.passes[pass].solves) write(each.target, pass);
        for (Convolution& each : plan_.passes[pass].convolutions) write(each.target, pass);
        for (PassTarget& target : plan_.passes[pass].targets) {
            if (auto* id = std::get_if<TemporaryId>(&target.id)) write(*id, pass);
        }
        for_each_read(plan_.passes[pass], [&](PlaneSource& source) {
            if (auto* id = std::get_if<TemporaryId>(&source)) *id = plane[*id];
        });
        free.insert(free.end(), freed_after[pass].begin(), freed_after[pass].end());
    }
    plan_.temporaries = count;
}

}  // namespace cascade::lowering
