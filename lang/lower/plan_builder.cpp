// Passes, targets and temporaries of a plan.
#include "lang/lower/plan_builder.h"

#include "core/check.h"
#include "ir/contraction.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::lowering {

namespace {

ReductionKind kind_of(Function function) {
    switch (function) {
        case Function::domain_sum: return ReductionKind::sum;
        case Function::domain_mean: return ReductionKind::mean;
        case Function::domain_min: return ReductionKind::least;
        default: return ReductionKind::largest;
    }
}

class PlanBuilder {
public:
    PlanBuilder(const PlanRequest& request, const EmitResults& emit)
        : request_(request),
          graph_(request.graph),
          emit_(emit),
          planner_(graph_, request.wanted, request.options.materialise, request.step_invariants) {}

    StepPlan build() {
        plan_.passes.resize(planner_.pass_count());
        written_.resize(planner_.pass_count());
        number_parts();
        for (std::uint32_t pass = 0; pass < planner_.pass_count(); ++pass) lower(pass);
        share_temporaries();
        plan_.is_uniform = std::all_of(request_.wanted.begin(), request_.wanted.end(),
                                       [&](PartId id) { return graph_[id].is_uniform; });
        plan_.result_count = static_cast<std::uint32_t>(std::count_if(
            plan_.passes.back().targets.begin(), plan_.passes.back().targets.end(),
            [](const PassTarget& target) { return target.kind == PassTarget::Kind::result; }));
        if (request_.options.describe) plan_.words = describe(graph_, planner_, plan_);
        return std::move(plan_);
    }

private:
    void number_parts() {
        storage_.temporary.assign(graph_.size(), 0);
        storage_.aggregate.assign(graph_.size(), 0);
        storage_.step_invariants.assign(graph_.size(), 0);
        plan_.step_invariants = static_cast<std::uint32_t>(request_.step_invariants.size());
        for (std::uint32_t k = 0; k < plan_.step_invariants; ++k)
            storage_.step_invariants[request_.step_invariants[k]] = k;
        for (PartId id = 0; id < graph_.size(); ++id) {
            if (!planner_.is_needed(id) || planner_.is_step_invariant(id)) continue;
            if (planner_.is_written(id)) {
                storage_.temporary[id] = plan_.temporaries++;
                written_[planner_.pass_of(id)].push_back(id);
            }
            const Part& part = graph_[id];
            if (part.node.kind == NodeKind::call && info(part.node.function).is_aggregate) {
                storage_.aggregate[id] = plan_.aggregates++;
                aggregates_.push_back(id);
            }
        }
    }

    void lower(std::uint32_t pass) {
        Pass& result = plan_.passes[pass];
        const bool is_last = pass + 1 == planner_.pass_count();
        KernelAssembly assembly(graph_.program(), graph_.stage());
        if (request_.frozen_is_mask) assembly.read_frozen_as_mask();
        if (is_last) {
            for (const std::uint32_t item : request_.first_slots) {
                assembly.field_slot(graph_.stage(), item);
            }
        }
        PassLowering lowering(graph_, planner_, storage_, pass, assembly);
        std::vector<PartId> wanted = written_[pass];
        if (is_last) wanted.insert(wanted.end(), request_.wanted.begin(), request_.wanted.end());
        lowering.compute(wanted);
        for (const PartId id : written_[pass]) {
            const std::string& name = graph_.name(id);
            const std::uint32_t number = storage_.temporary[id];
            assembly.result(name.empty() ? fmt::format("(temporary {})", number) : name,
                            lowering.value(id)[0]);
            result.targets.push_back(
                {PassTarget::Kind::temporary, number, false, graph_.boundary(id)});
        }
        if (is_last) emit_(assembly, lowering);
        result.bound = std::move(assembly).finish({});
        CellKernel& kernel = result.bound.kernel;
        if (request_.contracts) kernel = contracted(kernel);
        if (is_last) {
            for (std::uint32_t k = 0; result.targets.size() < result.bound.kernel.results.size();
                 ++k) {
                result.targets.push_back({PassTarget::Kind::result, k, false, {}});
            }
        }
        add_reductions(pass);
    }

    void add_reductions(std::uint32_t pass) {
        for (const PartId id : aggregates_) {
            if (planner_.pass_of(id) != pass) continue;
            const Part& part = graph_[id];
            plan_.passes[pass].reductions.push_back(
                {kind_of(part.node.function), source_of(part.operands[0]), storage_.aggregate[id]});
        }
    }

    SlotSource source_of(PartId id) const {
        const Part& part = graph_[id];
        if (planner_.is_step_invariant(id)) {
            return {SlotSource::Kind::step_invariant, graph_.stage(), storage_.step_invariants[id]};
        }
        if (planner_.is_written(id)) {
            return {SlotSource::Kind::temporary, 0, storage_.temporary[id]};
        }
        if (part.node.kind == NodeKind::call) {
            return {slot_of_text(part.node.function), 0, graph_[part.operands[0]].node.index};
        }
        if (part.node.kind == NodeKind::metric) {
            return {SlotSource::Kind::metric, 0, part.node.index};
        }
        if (part.node.kind == NodeKind::surface_value) {
            return {SlotSource::Kind::surface_value, 0, part.node.index};
        }
        if (part.node.kind == NodeKind::model) return {SlotSource::Kind::model, 0, part.node.index};
        const bool is_own = part.node.kind == NodeKind::own;
        return {SlotSource::Kind::item, is_own ? graph_.stage() : part.node.stage, part.node.index};
    }

    /// Calls visit(source) for all that a pass reads.
    template <typename Visit>
    void for_each_read(Pass& pass, const Visit& visit) {
        for (Reduction& reduction : pass.reductions) visit(reduction.operand);
        for (SlotSource& source : pass.bound.fields) visit(source);
    }

    /// Temporaries get the numbers of planes; a plane is free after the last pass that reads it.
    void share_temporaries() {
        std::vector<std::size_t> last_read(plan_.temporaries, 0);
        for (std::size_t pass = 0; pass < plan_.passes.size(); ++pass) {
            for_each_read(plan_.passes[pass], [&](SlotSource& source) {
                if (source.kind == SlotSource::Kind::temporary) last_read[source.item] = pass;
            });
        }
        std::vector<std::uint32_t> plane(plan_.temporaries), free;
        std::vector<std::vector<std::uint32_t>> freed_after(plan_.passes.size());
        std::uint32_t count = 0;
        for (std::size_t pass = 0; pass < plan_.passes.size(); ++pass) {
            for (PassTarget& target : plan_.passes[pass].targets) {
                if (target.kind != PassTarget::Kind::temporary) continue;
                const std::uint32_t number = target.index;
                if (free.empty()) free.push_back(count++);
                plane[number] = free.back();
                free.pop_back();
                target.index = plane[number];
                freed_after[std::max(last_read[number], pass)].push_back(plane[number]);
            }
            for_each_read(plan_.passes[pass], [&](SlotSource& source) {
                if (source.kind == SlotSource::Kind::temporary) source.item = plane[source.item];
            });
            free.insert(free.end(), freed_after[pass].begin(), freed_after[pass].end());
        }
        plan_.temporaries = count;
    }

    const PlanRequest& request_;
    const PartGraph& graph_;
    const EmitResults& emit_;
    PassPlanner planner_;
    Storage storage_;
    std::vector<std::vector<PartId>> written_;  ///< By pass.
    std::vector<PartId> aggregates_;
    StepPlan plan_;
};

}  // namespace

StepPlan build_plan(const PlanRequest& request, const EmitResults& emit) {
    return PlanBuilder(request, emit).build();
}

}  // namespace cascade::lowering
