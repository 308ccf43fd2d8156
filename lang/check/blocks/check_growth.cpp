// Checks whether stages can run in a domain that grows.
#include "lang/check/blocks/check_growth.h"

#include "lang/check/names/domain_lengths.h"
#include "lang/program/evaluate.h"
#include "lang/program/grown_lengths.h"
#include "lang/program/models.h"
#include "lang/program/stage_kinds.h"
#include "lang/vocabulary/functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace cascade::checking {

namespace {

constexpr int looks = 256;  ///< The number of times at which lengths are checked before the run.
constexpr double smallest_jump = 1e-6;  ///< As a fraction of the length.

double value_at(const Formula& formula, double t) {
    BuiltinValues moment{};
    moment[static_cast<std::size_t>(Builtin::t)] = t;
    return evaluate(formula, moment);
}

/// The time up to which it is certain that the stage runs. 0 if this is known only during the run.
double certain_end(const Program& program, std::uint32_t index) {
    const StageTime& time = program.stages[index].time;
    if (time.until || time.steady || time.open_end) return 0;
    return known_duration(program, index).value_or(0);
}

void refuse_in(const Stage& stage, Span span, std::string_view what, std::string hint,
               Diagnostics& diagnostics) {
    diagnostics.error(span,
                      fmt::format("stage '{}' runs in a domain that grows, {}", stage.name, what),
                      std::move(hint));
}

/// The reason why a node cannot be computed in a domain that grows; null if it can.
const char* obstacle(const Growth& growth, const Nodes& nodes, const Node& node) {
    if (node.calls(Function::convolve))
        return "where convolve cannot be used, because its "
               "kernel would change";
    if (growth.is_uniform) return nullptr;
    if (node.calls(Function::diffuse)) {
        return "where diffuse works only if all axes grow alike; write div(tensor(…) * grad(u)) "
               "instead";
    }
    const bool is_side_of_cell =
        node.calls(Function::grown) && nodes[node.operands[1]].is(NodeKind(double{all_axes}));
    return is_side_of_cell ? "where domain.spacing has no value, because cells do not stay square"
                           : nullptr;
}

class GrowthCheck {
public:
    GrowthCheck(const Program& program, std::uint32_t stage, Diagnostics& diagnostics)
        : program_(program),
          index_(stage),
          stage_(program.stages[stage]),
          growth_(*stage_.growth),
          diagnostics_(diagnostics) {}

    void run() {
        if (refuse_settings() || refuse_formulas() || refuse_border()) return;
        for (const GrowingSide& side : growing_sides(program_.domain)) {
            if (!is_sound_length(side)) return;
        }
        is_sound_rate();
    }

private:
    bool refuse(Span span, std::string_view what, std::string hint) {
        refuse_in(stage_, span, what, std::move(hint), diagnostics_);
        return true;
    }

    bool refuse_settings() {
        const System& system = program_.system_of(index_);
        if (stage_.size) {
            return refuse(stage_.size->span, "so its pattern has no fixed size",
                          "leave out 'size': the wavelength then follows from the equations");
        }
        if (stage_.time.coarse > 1) {
            return refuse(stage_.time.coarse_span,
                          "and such a stage cannot start on a coarser "
                          "grid",
                          "write grid: coarse(2) to run the whole stage on a coarser grid");
        }
        if (!stage_.uniform[system.speed_item()]) {
            return refuse(stage_.items[system.speed_item()].nodes.back().span,
                          "so its speed cannot differ from cell to cell",
                          "give one number as the speed of all cells");
        }
        const StencilKind stencil = program_.domain.stencil;
        if (growth_.is_uniform || stencil != StencilKind::isotropic) return false;
        return refuse(growth_.span,
                      "where the stencil isotropic cannot be used, because cells "
                      "do not stay square",
                      "write stencil: cross");
    }

    bool refuse_formulas() {
        return !std::ranges::all_of(formulas_of_stage(), [&](const Formula* formula) {
            return can_grow(program_, index_, *formula, diagnostics_);
        });
    }

    std::vector<const Formula*> formulas_of_stage() const {
        const System& system = program_.system_of(index_);
        std::vector<const Formula*> formulas{&stage_.show};
        for (const Formula& rate : system.rates) formulas.push_back(&rate);
        for (const Definition& each : system.definitions) formulas.push_back(&each.formula);
        for (const Formula& item : stage_.items) formulas.push_back(&item);
        if (stage_.time.until) formulas.push_back(&*stage_.time.until);
        return formulas;
    }

    bool refuse_border() {
        if (growth_.is_uniform) return false;
        const auto needs_length = [](const SideSettings& sides) {
            const SideKind kind = sides.back().kind;
            return kind == SideKind::slope || kind == SideKind::flux;
        };
        const auto refused = [&](const SideSettings& sides) {
            return needs_length(sides) && refuse(sides.back().span,
                                                 "where slope(…) and flux(…) at a border work only "
                                                 "if all axes grow alike",
                                                 "write border: fixed(…) or border: noflux");
        };
        return std::ranges::any_of(stage_.sides, refused) ||
               std::ranges::any_of(stage_.definition_sides, refused, &DefinitionSides::sides);
    }

    /// Reports a length that is not above 0, leaves the range of lengths, or jumps.
    bool is_sound_length(const GrowingSide& side) {
        const Formula& scale = growth_.scale[side.axis];
        const double end = certain_end(program_, index_);
        double before = value_at(scale, 0), last_but_one = before;
        for (int look = 0; look <= (end > 0 ? looks : 0); ++look) {
            const double t = end * look / looks, here = value_at(scale, t);
            const double cell = here * program_.domain.grid.spacing;
            if (!(cell >= least_spacing && cell <= 1 / least_spacing)) {
                diagnostics_.error(growth_.span,
                                   fmt::format("{} would be {:.6g} at t = {:.6g}", side.name,
                                               here * side.start, t),
                                   fmt::format("stage '{}' runs until t = {:.6g}: a length must "
                                               "stay above 0 and finite",
                                               stage_.name, end));
                return false;
            }
            if (look > 0 && jumps(scale, end * (look - 1) / looks, before, t, here)) {
                diagnostics_.error(growth_.span,
                                   fmt::format("{} jumps near t = {:.6g}", side.name, t),
                                   "the length of a side must not jump");
                return false;
            }
            const bool is_least = look > 1 && before <= last_but_one && before <= here &&
                                  (before < last_but_one || before < here);
            if (is_least && vanishes(scale, end * (look - 2) / looks, t)) {
                diagnostics_.error(growth_.span,
                                   fmt::format("{} would be 0 near t = {:.6g}", side.name,
                                               end * (look - 1) / looks),
                                   fmt::format("stage '{}' runs until t = {:.6g}: a length must "
                                               "stay above 0 and finite",
                                               stage_.name, end));
                return false;
            }
            last_but_one = std::exchange(before, here);
        }
        return true;
    }

    /// Whether the length becomes 0 between two times. A ternary search finds the smallest length.
    static bool vanishes(const Formula& scale, double from, double to) {
        const double largest = std::max(value_at(scale, from), value_at(scale, to));
        for (int third = 0; third < 100; ++third) {
            const double a = from + (to - from) / 3, b = to - (to - from) / 3;
            if (value_at(scale, a) < value_at(scale, b)) to = b;
            else from = a;
        }
        return !(value_at(scale, from) > smallest_jump * largest);
    }

    /// Whether the formula jumps between two times. Halves the interval again and again, and each
    /// time continues with the half in which the formula changes more.
    static bool jumps(const Formula& scale, double t0, double at0, double t1, double at1) {
        const auto change = [&] { return std::abs(at1 - at0); };
        const double limit = smallest_jump * std::max(at0, at1);
        for (double last = t1 - t0; change() > limit && t1 - t0 > 0x1p-40 * last;) {
            const double middle = t0 + (t1 - t0) / 2, value = value_at(scale, middle);
            if (std::abs(value - at0) > std::abs(at1 - value)) {
                t1 = middle;
                at1 = value;
            } else {
                t0 = middle;
                at0 = value;
            }
        }
        return change() > limit;
    }

    void is_sound_rate() {
        const double end = certain_end(program_, index_);
        for (int look = 0; look <= (end > 0 ? looks : 0); ++look) {
            const double t = end * look / looks, rate = value_at(growth_.dilution, t);
            if (std::isfinite(rate)) continue;
            diagnostics_.error(growth_.span,
                               fmt::format("the domain grows infinitely fast at t = {:.6g}", t),
                               "the derivative of a length must be finite");
            return;
        }
    }

    const Program& program_;
    std::uint32_t index_;
    const Stage& stage_;
    const Growth& growth_;
    Diagnostics& diagnostics_;
};

}  // namespace

bool can_grow(const Program& program, std::uint32_t stage, const Formula& formula,
              Diagnostics& diagnostics) {
    const Stage& its = program.stages[stage];
    if (!its.growth) return true;
    for (const Node& node : formula.nodes) {
        const char* const why = obstacle(*its.growth, formula.nodes, node);
        if (why == nullptr) continue;
        refuse_in(its, node.span, why, "", diagnostics);
        return false;
    }
    return true;
}

void check_growth(const Program& program, Diagnostics& diagnostics) {
    for (std::uint32_t stage = 0; stage < program.stages.size(); ++stage) {
        if (is_of_cells(program, stage) && program.domain.growth) {
            diagnostics.error(program.domain.growth->span,
                              fmt::format("stage '{}' consists of cells that crawl, but cells "
                                          "cannot crawl in a domain that grows",
                                          program.stages[stage].name));
        }
        if (program.stages[stage].growth) GrowthCheck(program, stage, diagnostics).run();
    }
}

}  // namespace cascade::checking
