// The weights are computed as in run/stage/bind_convolution.cpp, but not rounded to single
// precision.
#include "analysis/kernel_tapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade::analysis {

namespace {

std::vector<NodeKind> inputs_of_kernels(const LinearModel& model) {
    std::vector<NodeKind> inputs{LagPart::distance, LagPart::direction_x, LagPart::direction_y,
                                 LagPart::direction_z};
    inputs.insert(inputs.end(), model.varied.begin(), model.varied.end());
    return inputs;
}

std::vector<double> inputs_of_lag(const std::array<double, lag_part_count>& lag,
                                  std::span<const double> varied) {
    std::vector<double> inputs(lag.begin(), lag.end());
    inputs.insert(inputs.end(), varied.begin(), varied.end());
    return inputs;
}

Tape tape_of(const LinearModel& model, NodeId root) {
    return {model.algebra, std::array{root}, inputs_of_kernels(model)};
}

bool reads_items(const LinearModel& model, NodeId root) {
    const Formula formula = model.algebra.formula(root);
    return std::any_of(formula.nodes.begin(), formula.nodes.end(),
                       [](const Node& node) { return node.is<ItemId>(); });
}

}  // namespace

KernelTapes::KernelTapes(const LinearModel& model, const KernelFormula& kernel)
    : model_(model), weight_(tape_of(model, kernel.weight)) {
    if (kernel.reach) reach_ = tape_of(model, *kernel.reach);
    varies_ =
        reads_items(model, kernel.weight) || (kernel.reach && reads_items(model, *kernel.reach));
}

std::optional<double> KernelTapes::reach(std::span<const double> varied) const {
    if (!reach_) return std::nullopt;
    const double value = reach_->run(inputs_of_lag({}, varied)).front();
    return value > 0 ? value : 0;
}

bool KernelTapes::has_too_many_lags(std::span<const double> varied) const {
    return lags_in_box(model_.program->domain.grid, reach(varied)) > most_lags;
}

std::shared_ptr<const WaveKernel> KernelTapes::at(std::span<const double> varied) const {
    if (has_too_many_lags(varied)) return nullptr;
    const Grid& grid = model_.program->domain.grid;
    WeightedLags weighted;
    weighted.lags = lags_within(grid, reach(varied)).value();
    const double content = std::pow(grid.spacing, grid.stencil().axes());
    for (const Lag& lag : weighted.lags) {
        const std::array parts{static_cast<double>(lag.x), static_cast<double>(lag.y),
                               static_cast<double>(lag.z)};
        const double length = std::hypot(parts[0], parts[1], parts[2]);
        const double each = length > 0 ? 1 / length : 0;
        const std::array seen{length * grid.spacing, parts[0] * each, parts[1] * each,
                              parts[2] * each};
        weighted.weights.push_back(content * weight_.run(inputs_of_lag(seen, varied)).front());
    }
    return std::make_shared<const WaveKernel>(weighted);
}

}  // namespace cascade::analysis
