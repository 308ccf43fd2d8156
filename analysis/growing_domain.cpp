// For each time, analyses the stage with this number in place of t.
#include "analysis/growing_domain.h"

#include "analysis/stage_analysis.h"
#include "analysis/wave_operators.h"
#include "lang/program/grown_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace cascade::analysis {

namespace {

/// The parts into which the duration of a stage is divided.
constexpr int parts_of_duration = 4;

/// A copy of the program in which the given time replaces `t` in the rates of a stage.
Program at_moment(const Program& program, std::uint32_t stage, double t) {
    Program result = program;
    System& system = result.systems[result.stages[stage].system];
    const auto set = [&](Formula& formula) {
        for (Node& node : formula.nodes) {
            if (node.is(Builtin::t)) node.kind = t;
        }
    };
    for (Definition& each : system.definitions) set(each.formula);
    for (Formula& rate : system.rates) set(rate);
    return result;
}

std::string lengths_text(const Program& program, std::uint32_t stage, double t) {
    const Grid& grid = program.domain.grid;
    const auto scales = scales_at(program.stages[stage], t);
    const std::array cells{grid.width, grid.height, grid.depth};
    std::string text;
    for (std::size_t axis = 0; axis < cells.size(); ++axis) {
        if (cells[axis] == 1) continue;
        text += fmt::format("{}{:.4g}", text.empty() ? "" : " x ",
                            static_cast<double>(cells[axis]) * grid.spacing * scales[axis]);
    }
    return text;
}

/// Counts waves along x: whole waves between periodic sides, otherwise half waves.
class WaveCount {
public:
    explicit WaveCount(const Grid& grid)
        : is_periodic_(grid.boundary.x == Boundary::periodic),
          per_phase_(static_cast<double>(grid.width) /
                     ((is_periodic_ ? 2 : 1) * std::numbers::pi)) {}

    double of(double phase) const { return phase * per_phase_; }
    const char* name(bool is_one) const {
        return is_periodic_ ? (is_one ? "wave" : "waves") : (is_one ? "half wave" : "half waves");
    }

    /// A text such as "3 to 5 half waves grow along x, 4 fastest".
    std::string text(const Dispersion& relation) const {
        if (!relation.has_growing_waves() || relation.bands.empty()) return "no wave grows";
        const double least = std::max(1.0, std::ceil(of(relation.bands.front().least) - 1e-9));
        const double most = std::floor(of(relation.bands.back().most) + 1e-9);
        if (most < least) return "none of the growing waves fits along x";
        if (most == 1) return fmt::format("1 {} grows along x", name(true));
        if (most == least) return fmt::format("{:.0f} {} grow along x", most, name(false));
        const double fastest = std::max(1.0, std::round(of(relation.fastest.phase)));
        return fmt::format("{:.0f} to {:.0f} {} grow along x, {:.0f} fastest", least, most,
                           name(false), std::min(std::max(fastest, least), most));
    }

private:
    bool is_periodic_;
    double per_phase_;
};

}  // namespace

std::string waves_of_growing_domain(const Program& program, std::uint32_t stage) {
    const auto end = known_duration(program, stage);
    const Grid& grid = program.domain.grid;
    if (!program.stages[stage].growth || !end || grid.width == 1) return "";
    const WaveCount count(grid);
    std::string text = "\nas the domain grows\n";
    for (int part = 0; part <= parts_of_duration; ++part) {
        const double t = *end * part / parts_of_duration;
        const Program moment = at_moment(program, stage, t);
        const auto analysis = analyze_stage(moment, stage);
        if (!analysis) return "";
        const std::string waves = analysis->states.empty()
                                      ? "no flat state found"
                                      : count.text(state_to_show(*analysis).relation);
        text += fmt::format("  {:<20}{}: {}\n", fmt::format("t = {:.4g}", t),
                            lengths_text(program, stage, t), waves);
    }
    return text;
}

}  // namespace cascade::analysis
