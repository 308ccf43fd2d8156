// Passes a stage's equations to the time loop of tissues, and reports the outcome in the words of
// the script.
#include "run/simulation/tissue_run.h"

#include "core/with_commas.h"
#include "lang/print/print_formula.h"
#include "run/domain/free_memory.h"
#include "run/simulation/tissue_stage.h"
#include "run/tissue/script_rules.h"
#include "solvers/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// A rate as scripts name it, and its formula. If the rate belongs to a component of a position or
/// frame, it has the name and the formula of the whole vector.
struct NamedRate {
    std::string_view name;
    const Formula* formula = nullptr;
};

NamedRate rate_of(const System& system, ItemId item) {
    const CellRules& rules = *system.cells;
    if (!rules.has_component(item)) return {system.item_name(item), &system.rates[item]};
    if (item < rules.frame) return {"p", &system.definitions[rules.velocity].formula};
    return {"turn", &system.definitions[rules.spin].formula};
}

/// Returns the terms of a sum in their order, without their signs.
std::vector<Formula> terms_of(const Formula& sum) {
    std::vector<Formula> terms;
    std::vector<NodeId> open{NodeId(sum.nodes.size() - 1)};
    while (!open.empty()) {
        const NodeId root = open.back();
        open.pop_back();
        const Node& node = sum.nodes[root];
        const bool is_sum = node.calls(Function::add) || node.calls(Function::subtract) ||
                            node.calls(Function::negate);
        if (!is_sum) {
            terms.push_back(formula_of(sum.nodes, root));
            continue;
        }
        const auto reads = node.reads();
        open.insert(open.end(), reads.rbegin(), reads.rend());
    }
    return terms;
}

std::optional<std::size_t> find_cell(const Tissue& tissue, std::uint32_t number) {
    for (std::size_t cell = 0; cell < tissue.count(); ++cell) {
        if (tissue.numbers()[cell] == number) return cell;
    }
    return std::nullopt;
}

/// Returns the absolute value of a number, or the length of a vector, in a cell. Returns infinity
/// if this is not finite.
double size_of(const Formula& term, const StageView& view, std::size_t cell) {
    std::vector<Formula> parts;
    if (term.nodes.back().type == ValueType::vector) {
        for (int axis = 0; axis < 3; ++axis) parts.push_back(component_of(term, axis));
    } else {
        parts.push_back(term);
    }
    std::vector<const Formula*> formulas;
    for (const Formula& part : parts) formulas.push_back(&part);
    double square = 0;
    for (const Field& values : view.evaluate(formulas)) {
        const double value = value_in(values, *view.state().tissue(), cell);
        square += value * value;
    }
    return std::isfinite(square) ? std::sqrt(square) : INFINITY;
}

/// Names the term with the largest magnitude in a species' rate, at the present state of the cell
/// with this number: "the largest term of p' is …, 3.2e+09". A term that is not finite counts as
/// the largest. Returns an empty string if the rate has only one term, if the cell is not alive, or
/// if all terms are 0.
std::string largest_term(const StageView& view, SpeciesId species, std::uint32_t number) {
    const Tissue& tissue = *view.state().tissue();
    const System& system = view.system();
    const NamedRate rate = rate_of(system, system.species()[species]);
    const std::optional<std::size_t> cell = find_cell(tissue, number);
    const std::vector<Formula> terms = terms_of(*rate.formula);
    if (!cell || terms.size() < 2) return "";
    std::size_t largest = 0;
    double size = 0;
    for (std::size_t k = 0; k < terms.size() && std::isfinite(size); ++k) {
        const double own = size_of(terms[k], view, *cell);
        if (own <= size) continue;
        largest = k;
        size = own;
    }
    if (size == 0) return "";
    const std::string text = print_formula(view.program(), system, terms[largest]);
    return std::isfinite(size)
               ? fmt::format("the largest term of {}' is {}, {:.3g}", rate.name, text, size)
               : fmt::format("a term of {}' is not finite: {}", rate.name, text);
}

ScriptRules::Makers makers(const Environment& here, StepKernels& kernels,
                           std::function<void(const Failure&)> refused) {
    const KernelMaker& maker = here.crawling->kernels;
    return {here.plans, maker.steps(TieredBackend::When::when_used, kernels, std::move(refused)),
            maker.often()};
}

TissueSpecies species_of(const TissueStage& stage) {
    TissueSpecies species;
    species.place = stage.species_of(stage.rules().place).index();
    species.radius = stage.species_of(stage.rules().radius).index();
    // If p' has no terms, its rate is a single number.
    const Formula& rate = stage.system().rates[stage.rules().place];
    species.crawls = rate.nodes.size() != 1 || !rate.nodes.back().is<double>();
    species.restless = {stage.species_of(stage.rules().age).index()};
    return species;
}

/// Returns the words for a species. Scripts have no names for the components of positions and
/// frames.
std::string name_of(const System& system, ItemId item) {
    if (!system.cells->has_component(item)) return std::string(system.item_name(item));
    return item < system.cells->frame ? "the place" : "the axes";
}

/// Returns a remark on a tissue in which as many cells are born as die.
std::string describe(const Turnover& turnover, const Stage& stage) {
    return fmt::format(
        "stage '{}' divides and dies without end: {} births and {} deaths from t = {:.4g} to "
        "{:.4g}, "
        "while the number of cells stays near {}",
        stage.name, turnover.births, turnover.deaths, turnover.from, turnover.to, turnover.cells);
}

}  // namespace

TissueRun::TissueRun(const Environment& environment, std::span<StageState> states,
                     std::uint32_t stage, const Keeping& keeping)
    : environment_(environment),
      states_(states),
      stage_(stage),
      state_(states[stage]),
      kernels_(environment.stage(stage).name),
      rules_(tissue_stage(environment, states, stage),
             makers(environment, kernels_,
                    [this](const Failure& refusal) {
                        if (control_ != nullptr) kernels_.warn(refusal, *control_);
                    }),
             near_) {
    CHECK(state_.started && state_.tissue(), "a stage is started before it advances");
    near_->begin(state_.tissue()->triangles);
    const TissueStage here = tissue_stage(environment, states, stage);
    loop_.emplace(rules_, *state_.ground()->surroundings(), *state_.tissue(), near_,
                  species_of(here), schedule(keeping), progress_of(environment, stage));
}

TissueSchedule TissueRun::schedule(const Keeping& keeping) {
    const StageView view(environment_, states_, stage_);
    const StageTime& time = view.stage().time;
    TissueSchedule schedule;
    schedule.solver = time.solver;
    schedule.tolerance = time.step_tolerance();
    if (time.largest_step) schedule.largest_step = *time.largest_step;
    if (time.duration) schedule.end_time = *time.duration;
    schedule.every = time.every;
    schedule.steady = time.steady.value_or(0);
    schedule.seed = environment_.program->domain.seed;
    schedule.stage = stage_;
    const TissueStage stage = tissue_stage(environment_, states_, stage_);
    schedule.neighbours = neighbours_of(stage, widest_near(view));
    schedule.threads = environment_.tools.threads;
    reaches_all_ = schedule.neighbours.near >= length(state_.ground()->surroundings()->extent());
    schedule.most_cells = most_cells_in_memory(view.system(), environment_.precision());
    schedule.most_list_bytes = static_cast<double>(available_memory()) / 4;
    if (time.until) {
        schedule.check = time.steps_between_looks();
        schedule.ends = [this](const Tissue& tissue) {
            follow(tissue);
            const bool holds = condition_holds();
            if (!holds) warn_of_waiting(tissue);
            return holds;
        };
    }
    schedule.next_moment = [this](double t) {
        const bool is_observed = observation_.next_moment && control_ && !control_->cancel;
        return is_observed ? observation_.next_moment(t) : std::numeric_limits<double>::infinity();
    };
    schedule.at_moment = [this](const Tissue& tissue) {
        follow(tissue);
        observation_.observe();
    };
    schedule.turns_over = [this](const Turnover& turnover) {
        if (control_->warn) control_->warn(describe(turnover, environment_.stage(stage_)));
    };
    schedule.keep_is_due = keeping.is_due;
    schedule.keep = [this, &keeping](const Tissue& tissue) {
        follow(tissue);
        keeping.keep();
    };
    return schedule;
}

/// Warns, but only once, that a stage has stopped growing although the condition of its `until` is
/// still false.
void TissueRun::warn_of_waiting(const Tissue& tissue) {
    constexpr double times_of_growth = 4;
    constexpr std::int64_t fewest_steps = 1000;
    const Stage& stage = environment_.stage(stage_);
    const double last = tissue.time.last_event;
    const bool waits = !stage.time.duration && tissue.births > 0 && state_.steps >= fewest_steps &&
                       state_.t > times_of_growth * last;
    if (!waits || is_waiting_ || !control_->warn) return;
    is_waiting_ = true;
    control_->warn(fmt::format(
        "stage '{}': no cell has divided or died since t = {:.4g}, and 'until', which is not "
        "true at t = {:.4g}, may never become true",
        stage.name, last, state_.t));
}

/// Whether the condition of `until` is true. The condition is uniform, so its value in the first
/// cell is used.
bool TissueRun::condition_holds() {
    const StageView view(environment_, states_, stage_);
    return view.evaluate(*view.stage().time.until)[0].number_at(0, 0) != 0;
}

/// Copies the last complete step of the tissue to the state.
void TissueRun::follow(const Tissue& tissue) {
    state_.steps = tissue.time.steps;
    state_.t = tissue.time.t;
}

Result<StageEnd> TissueRun::advance(std::int64_t last_step, RunControl& control,
                                    const Observation& observation) {
    const Stage& stage = environment_.stage(stage_);
    if (StageView(environment_, states_, stage_).is_frozen()) {
        can_go_on_ = false;
        state_.done = true;
        return StageEnd::finished;
    }
    control_ = &control;
    observation_ = observation;
    if (std::exchange(reaches_all_, false) && control.warn) {
        control.warn(
            fmt::format("stage '{}': 'near' reaches all cells, so the time of each step grows "
                        "with the square of the number of cells",
                        stage.name));
    }
    can_go_on_ = false;
    // If the stage has no interval, frames are drawn at marks.
    const auto marks = [&] {
        return marks_reached(state_.t,
                             stage.time.duration.value_or(std::numeric_limits<double>::infinity()),
                             stage.time.every);
    };
    const std::int64_t interval = observation.every > 0 ? observation.every : stage.interval;
    double seen = marks();
    const TissueOutcome outcome =
        loop_->advance(last_step, std::max<std::int64_t>(1, interval), control,
                       [&](const Tissue& tissue) {
                           follow(tissue);
                           const double reached = marks();
                           const bool is_due = interval > 0 || reached > seen;
                           seen = reached;
                           if (is_due && observation.observe && !observation.next_moment) {
                               observation.observe();
                           }
                           return true;
                       });
    control_ = nullptr;
    observation_ = {};
    state_.steps = outcome.steps;
    state_.t = outcome.t;
    kernels_.warn_of_refused(control);
    if (outcome.failure)
        return tl::unexpected(
            explain(*outcome.failure, StageView(environment_, states_, stage_), outcome.steps + 1));
    if (outcome.cancelled) {
        environment_.crawling->kernels.stepper()->abandon();
        return StageEnd::cancelled;
    }
    state_.done = outcome.ended || state_.steps >= stage.iterations;
    const bool in_time = !stage.time.duration || outcome.t < *stage.time.duration;
    state_.condition_met = outcome.ended && in_time && state_.tissue()->count() > 0;
    can_go_on_ = !state_.done;
    if (state_.done) loop_.reset();
    return state_.done ? StageEnd::finished : StageEnd::stopped;
}

Failure explain(const TissueFailure& failure, const StageView& view, std::int64_t step) {
    using Kind = TissueFailure::Kind;
    const System& system = view.system();
    const std::string where =
        fmt::format("stage '{}' ({}), step {}", view.stage().name, system.name, with_commas(step));
    const SpeciesId species(failure.species);
    const std::string what = name_of(system, system.species()[species]);
    const auto term_or = [&](std::string_view otherwise) {
        const std::string term = largest_term(view, species, failure.number);
        return term.empty() ? std::string(otherwise) : term;
    };
    switch (failure.kind) {
        case Kind::not_finite:
            return {fmt::format("{}: {} of cell {} is not finite after t = {:.6g}, in a step of "
                                "{:.3g}",
                                where, what, failure.number, failure.t, failure.step),
                    term_or("its rate divides by 0 or grows without bound")};
        case Kind::rate_not_finite:
            return {fmt::format("{}: the rate of {} of cell {} is not finite at t = {:.6g}", where,
                                what, failure.number, failure.t),
                    term_or("it divides by 0 or grows without bound")};
        case Kind::too_short:
            return {
                fmt::format("{}: steps shrink to nothing: at t = {:.6g} even a step of {:.2g} is "
                            "too long for {} of cell {}",
                            where, failure.t, failure.step, what, failure.number),
                term_or("a value jumps or grows without bound there") +
                    "; a larger 'tolerance' may let the run continue"};
        case Kind::too_far:
            return {fmt::format("{}: a step of {:.3g} from t = {:.6g} moves cell {} too far", where,
                                failure.step, failure.t, failure.number),
                    "use a smaller 'largest_step', which keeps cells beside their neighbours"};
        case Kind::divides_for_ever:
            return {fmt::format("{}: cell {} would divide again as soon as it has divided, at "
                                "t = {:.6g}",
                                where, failure.number, failure.t),
                    "a division must make the condition of 'divide' false, as 'ripe: 0 after "
                    "divide' does"};
        case Kind::too_many_cells:
            return {fmt::format("{}: at t = {:.6g} there would be {} cells, more than fit into "
                                "memory",
                                where, failure.t, failure.cells),
                    "make the cells larger, or let the condition of 'divide' end"};
        case Kind::too_many_neighbours:
            return {fmt::format("{}: {}", where, failure.refusal.message), failure.refusal.hint};
    }
    return {where, ""};
}

}  // namespace cascade
