// Computes, from the derivatives of all rates, the Jacobian that acts on a wave.
#include "analysis/linear_model.h"

#include "analysis/kernel_tapes.h"
#include "analysis/lineariser.h"
#include "lang/program/calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace cascade::analysis {

namespace {

std::vector<JacobianTerm> terms_of(const LinearModel& model, const std::vector<Slopes>& slopes,
                                   NodeId zero) {
    const std::size_t count = model.variable_count();
    std::map<OperatorProduct, std::vector<NodeId>> entries;
    entries[{}].assign(count * count, zero);
    for (std::size_t rate = 0; rate < count; ++rate) {
        for (std::size_t variable = 0; variable < count; ++variable) {
            for (const auto& [operators, coefficient] : slopes[rate][variable]) {
                auto& matrix = entries[operators];
                matrix.resize(count * count, zero);
                matrix[rate * count + variable] = coefficient;
            }
        }
    }
    std::vector<JacobianTerm> terms;
    for (auto& [operators, matrix] : entries) terms.push_back({operators, std::move(matrix)});
    return terms;
}

}  // namespace

std::vector<NodeId> LinearModel::formulas() const {
    std::vector<NodeId> all = rates;
    for (const JacobianTerm& term : terms) {
        all.insert(all.end(), term.entries.begin(), term.entries.end());
    }
    for (const KernelFormula& kernel : kernels) {
        all.push_back(kernel.weight);
        if (kernel.reach) all.push_back(*kernel.reach);
    }
    return all;
}

Result<LinearModel> linear_model(const Program& program, std::uint32_t stage,
                                 std::span<const ItemId> varied) {
    const System& system = program.system_of(stage);
    if (system.cells) return failure("its cells crawl, and have no flat state");
    LinearModel model;
    model.program = &program;
    model.stage = stage;
    model.varied.assign(varied.begin(), varied.end());
    for (const ItemId item : system.species()) model.species.push_back(item);
    if (model.species.empty()) return failure("it has no species");
    model.starts = start_values(model.algebra, program, stage, varied);
    const FlatRates rates(system, FieldSpace::of(program, system));
    std::vector<NodeId> constraints;
    for (const NodeId id : ids_below<NodeId>(rates.count)) {
        const Node& node = rates.algebra[id];
        const auto number = solved_constraint(node);
        if (!number) continue;
        model.unknowns.push_back({*number});
        constraints.push_back(node.operands[0]);
    }
    Lineariser parts(model);
    for (const NodeId id : ids_below<NodeId>(rates.count)) {
        if (auto done = parts.add(rates.algebra[id]); !done) return tl::unexpected(done.error());
    }
    std::vector<Slopes> slopes;
    const auto take = [&](NodeId rate) {
        model.rates.push_back(parts[rate].value[0]);
        slopes.push_back(parts[rate].slopes);
    };
    for (const ItemId item : model.species) take(rates.rate(item));
    for (const NodeId constraint : constraints) take(constraint);
    model.terms = terms_of(model, slopes, model.algebra.number(0));
    if (varied.empty()) {
        for (const KernelFormula& kernel : model.kernels) {
            if (!KernelTapes(model, kernel).has_too_many_lags({})) continue;
            return failure(fmt::format("its convolutions reach more than {} cells",
                                       KernelTapes::most_lags),
                           "add a distance as the third argument, as in convolve(k, e, 20)");
        }
    }
    std::sort(model.parameters.begin(), model.parameters.end());
    return model;
}

}  // namespace cascade::analysis
