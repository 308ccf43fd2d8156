// Computes stable steps, and the analysis of each flat state.
#include "analysis/stage_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace cascade::analysis {

namespace {

struct StepPolynomial {
    Solver solver;
    std::array<double, 7> coefficients;
};
constexpr std::array<StepPolynomial, 5> polynomials{
    {{Solver::euler, {1, 1, 0, 0, 0, 0, 0}},
     {Solver::rk2, {1, 1, 1.0 / 2, 0, 0, 0, 0}},
     {Solver::rk4, {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 0, 0}},
     {Solver::rk23, {1, 1, 1.0 / 2, 1.0 / 6, 0, 0, 0}},
     {Solver::rk45, {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 600}}}};

bool is_stable(const StepPolynomial& polynomial, Complex z) {
    Complex sum = 0;
    for (std::size_t k = polynomial.coefficients.size(); k-- > 0;) {
        sum = sum * z + polynomial.coefficients[k];
    }
    return std::norm(sum) <= 1 + 1e-12;
}

/// The distance from 0 at which a ray leaves the region of stability. The ray begins at 0, and
/// `angle` is its angle to the negative axis, 0 … π/2.
double reach(const StepPolynomial& polynomial, double angle) {
    const Complex direction = std::polar(1.0, std::numbers::pi - angle);
    constexpr double most = 8;
    double inside = 0, outside = most;
    for (double radius = 0.02; radius < most; radius += 0.02) {
        if (!is_stable(polynomial, radius * direction)) {
            outside = radius;
            break;
        }
        inside = radius;
    }
    // On the imaginary axis, euler and rk2 amplify every wave slightly, so no step is stable.
    if (inside == 0 && angle > std::numbers::pi / 2 - 1e-9) return 0;
    for (int round = 0; round < 40; ++round) {
        const double middle = (inside + outside) / 2;
        (is_stable(polynomial, middle * direction) ? inside : outside) = middle;
    }
    return inside;
}

}  // namespace

std::vector<StableStep> stable_steps(std::span<const Complex> rates) {
    // The number of ranges of angles. In each range, only the largest rate limits the step.
    constexpr std::size_t sectors = 512;
    std::array<Complex, sectors + 1> largest{};
    for (const Complex rate : rates) {
        const double angle = std::atan2(std::abs(rate.imag()), std::max(-rate.real(), 0.0));
        auto& known = largest[static_cast<std::size_t>(
            std::min(angle / (std::numbers::pi / 2), 1.0) * sectors)];
        if (std::abs(rate) > std::abs(known)) known = rate;
    }
    std::vector<StableStep> steps;
    for (const StepPolynomial& polynomial : polynomials) {
        StableStep step{polynomial.solver, std::numeric_limits<double>::infinity()};
        for (const Complex rate : largest) {
            if (rate == Complex()) continue;
            const double angle = std::atan2(std::abs(rate.imag()), std::max(-rate.real(), 0.0));
            step.step = std::min(step.step, reach(polynomial, angle) / std::abs(rate));
        }
        steps.push_back(step);
    }
    return steps;
}

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
