// Puts the parts together.
#include "analysis/stage_analysis.h"

namespace cascade::analysis {

std::optional<double> fixed_step(const LinearModel& model) {
    const Stage& stage = model.program->stages[model.stage];
    const StartValue& speed = model.starts[model.system().speed_item()];
    const auto* number = model.algebra[speed.value].as<double>();
    const bool is_fixed = !stage.time.chooses_steps() && !speed.differs && !speed.is_unknown;
    if (!is_fixed || number == nullptr || !(*number > 0)) return std::nullopt;
    return *number;
}

Result<StageAnalysis> analyze_stage(const Program& program, std::uint32_t stage) {
    auto model = linear_model(program, stage);
    if (!model) return tl::unexpected(model.error());
    StageAnalysis analysis{std::move(*model), {}, false, {}, {}};
    const LocalRates rates(analysis.model);
    analysis.start = rates.start();
    analysis.step = fixed_step(analysis.model);
    FlatStates states = flat_states(rates);
    analysis.has_conserved_totals = states.conserved.rows() > 0;
    for (FlatState& state : states.found) {
        StateAnalysis each;
        each.matrices = rates.matrices(state.species);
        each.state = std::move(state);
        if (!each.matrices.are_finite()) continue;
        each.relation = dispersion(analysis.model, each.matrices);
        each.steps = stable_steps(decaying_rates(analysis.model, each.matrices));
        analysis.states.push_back(std::move(each));
    }
    return analysis;
}

const StateAnalysis& state_to_show(const StageAnalysis& analysis) {
    for (const StateAnalysis& state : analysis.states) {
        const Stability stability = state.relation.stability;
        if (stability == Stability::turing || stability == Stability::wave) return state;
    }
    return analysis.states.front();
}

}  // namespace cascade::analysis
