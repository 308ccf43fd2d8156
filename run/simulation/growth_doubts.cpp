// Takes the steps of a stage again for one number, u' = -r(t) u, which dilution alone changes. The
// exact factor by which u changes is the size of the domain at the start divided by the size at the
// end.
#include "run/simulation/growth_doubts.h"

#include "ir/solver.h"
#include "lang/program/evaluate.h"
#include "lang/program/grown_lengths.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace cascade {

namespace {

constexpr double noticed_part = 0.01;  ///< The smallest relative change that is reported.
constexpr double kept_part = 0.003;  ///< Suggested steps change amounts by less than this fraction.
constexpr std::int64_t most_repeated = 200'000;

double at(const Formula& formula, double t) {
    BuiltinValues moment{};
    moment[static_cast<std::size_t>(Builtin::t)] = t;
    return evaluate(formula, moment);
}

/// Whether a value of an earlier stage may differ from cell to cell.
bool varies(const Program& program, const StageItem& item) {
    const Stage& stage = program.stages[item.stage];
    return item.item < stage.uniform.next() && !stage.uniform[item.item];
}

/// Returns the earlier stages whose cells a stage reads when it starts.
std::set<std::uint32_t> stages_read(const StageView& view) {
    std::set<std::uint32_t> read;
    for (const Formula& item : view.stage().items) {
        for (const Node& node : item.nodes) {
            const auto* const other = node.as<StageItem>();
            if (other != nullptr && varies(view.program(), *other)) read.insert(other->stage);
        }
    }
    return read;
}

/// The lengths of growing_sides() at a time.
std::vector<double> lengths_at(const Program& program, const Stage& stage, double t) {
    const auto scales = scales_at(stage, t);
    std::vector<double> lengths;
    for (const GrowingSide& side : growing_sides(program.domain)) {
        lengths.push_back(scales[side.axis] * side.start);
    }
    return lengths;
}

/// Returns the factor by which u' = -r(t) u changes u from t = 0 to `end`, in steps of the length
/// `length`. The last step may be shorter.
double diluted(const Formula& rate, int order, double length, double end) {
    double u = 1;
    const auto slope = [&](double t, double value) { return -at(rate, t) * value; };
    for (std::int64_t n = 0;; ++n) {
        const double t = length * static_cast<double>(n);
        const double h = std::min(length, end - t);
        if (!(h > 1e-6 * length)) return u;
        const double k1 = slope(t, u);
        if (order == 1) {
            u += h * k1;
        } else if (order < 4) {
            u += h / 2 * (k1 + slope(t + h, u + h * k1));
        } else {
            const double k2 = slope(t + h / 2, u + h / 2 * k1);
            const double k3 = slope(t + h / 2, u + h / 2 * k2);
            u += h / 6 * (k1 + 2 * k2 + 2 * k3 + slope(t + h, u + h * k3));
        }
    }
}

}  // namespace

std::string describe_jump_of_lengths(const StageView& view) {
    const Program& program = view.program();
    for (const std::uint32_t earlier : stages_read(view)) {
        const Stage& before = program.stages[earlier];
        if (!before.growth && !view.stage().growth) continue;
        const auto ended = lengths_at(program, before, view.states()[earlier].t);
        const auto begins = lengths_at(program, view.stage(), 0);
        const auto [from, to] = std::ranges::mismatch(ended, begins, [](double a, double b) {
            return std::abs(a - b) <= noticed_part * std::max(a, b);
        });
        if (from == ended.end()) continue;
        const bool is_uniform = (!before.growth || before.growth->is_uniform) &&
                                (!view.stage().growth || view.stage().growth->is_uniform);
        std::vector<std::string> words;
        for (const double length : ended) words.push_back(fmt::format("{:.4g}", length));
        if (is_uniform) words.resize(1);
        return fmt::format(
            "stage '{}' begins with a length of {:.4g}, but stage '{}', whose values it reads, "
            "ended with {:.4g}, so amounts jump; to continue the growth, give the stage an "
            "'extent' that is {} at t = 0",
            view.stage().name, *to, before.name, *from, fmt::join(words, ", "));
    }
    return {};
}

std::optional<AmountChanged> find_changed_amount(const StageView& view) {
    const Stage& stage = view.stage();
    const StageState& state = view.state();
    const ItemId speed = view.system().speed_item();
    const bool is_repeatable = stage.growth && !stage.time.chooses_steps() &&
                               stage.uniform[speed] &&
                               (state.time.stages <= 1 || is_stabilised(stage.time.solver)) &&
                               stage.undiluted.size() < view.system().species_count();
    if (!is_repeatable || state.steps > most_repeated) return std::nullopt;
    const double length = state.numbers[speed];
    if (!(state.t <= length * static_cast<double>(most_repeated))) return std::nullopt;
    double exact = 1;
    for (const Formula& scale : stage.growth->scale) exact *= at(scale, 0) / at(scale, state.t);
    const auto error = [&](double step) {
        const double kept =
            diluted(stage.growth->dilution, order_of(stage.time.solver), step, state.t);
        return std::abs(kept / exact - 1);
    };
    AmountChanged found{error(length), std::nullopt};
    if (found.part < noticed_part) return std::nullopt;
    for (std::int64_t parts = 2; state.steps * parts <= most_repeated && !found.speed; parts *= 2) {
        const double shorter = length / static_cast<double>(parts);
        if (error(shorter) < kept_part) found.speed = shorter;
    }
    return found;
}

}  // namespace cascade
