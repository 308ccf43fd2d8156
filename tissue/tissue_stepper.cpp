// If a cell moves so far during a step that its list may miss neighbours, the step is repeated with
// better lists. The result is the same bit for bit.
#include "tissue/tissue_stepper.h"

#include "core/check.h"
#include "core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cascade {

namespace {

/// The numbers of stages that are used. Each number needs separate passes and planes, so the list
/// is short.
constexpr std::array<std::uint32_t, 14> numbers_of_stages{3,  5,  7,  9,  11, 13, 17,
                                                          21, 27, 35, 45, 57, 75, 99};

/// A step ends early if more than one in this many cells has an event, because new cells and their
/// neighbours interact only after the end of the step.
constexpr std::size_t cells_of_an_event = 20;

/// The longest step after an event, as a multiple of the shortest time scale of the rates.
constexpr double most_of_stiffness = 4;

bool all_finite(const Tissue& tissue) {
    return std::all_of(tissue.species.begin(), tissue.species.end(), [&](const Field& field) {
        return field.visit([&](const auto& plane) {
            bool all = true;
            tissue.each_cell([&](std::size_t, std::int64_t at) {
                all = all & std::isfinite(plane.origin()[at]);
            });
            return all;
        });
    });
}

NeighbourRule rule_of(const TissueSchedule& schedule, const Surroundings& surroundings) {
    NeighbourRule rule = schedule.neighbours;
    rule.period = surroundings.period();
    return rule;
}

}  // namespace

std::vector<double> root_mean_squares(const std::vector<Field>& fields, const Tissue& tissue,
                                      Team& team, const std::vector<Field>* others) {
    std::vector<double> result(fields.size());
    const auto sum_of = [&]<typename Number>(const Plane<Number>& plane, const Number* other) {
        double sum = 0;
        for (const std::uint32_t at : tissue.elements_by_number()) {
            double value = plane.origin()[at];
            if (other != nullptr) value -= other[at];
            sum += value * value;
        }
        return sum;
    };
    team.run([&](int thread) {
        for (auto k = static_cast<std::size_t>(thread); k < fields.size();
             k += static_cast<std::size_t>(team.size())) {
            const double sum = fields[k].visit([&]<typename Number>(const Plane<Number>& plane) {
                return sum_of(plane, others == nullptr
                                         ? nullptr
                                         : (*others)[k].template plane<Number>().origin());
            });
            const auto cells = static_cast<double>(std::max<std::size_t>(1, tissue.count()));
            result[k] = std::sqrt(sum / cells);
        }
    });
    return result;
}

std::vector<double> sizes_of(const std::vector<Field>& species, const Tissue& tissue,
                             const TissueSpecies& roles, double mean_radius, Team& team) {
    std::vector<double> sizes = root_mean_squares(species, tissue, team);
    for (std::size_t k = 0; k < 3 && mean_radius > 0; ++k) {
        if (std::isfinite(sizes[roles.place + k])) sizes[roles.place + k] = mean_radius;
    }
    // This comparison leaves NaN unchanged.
    for (double& size : sizes) size = size < 1e-30 ? 1e-30 : size;
    return sizes;
}

TissueFailure failure_of(TissueFailure::Kind kind, const Tissue& tissue) {
    TissueFailure failure;
    failure.kind = kind;
    failure.t = tissue.time.t;
    failure.step = tissue.time.control.step;
    failure.cells = tissue.count();
    return failure;
}

std::optional<TissueFailure> find_not_finite(const Tissue& tissue) {
    if (all_finite(tissue)) return std::nullopt;
    for (const std::uint32_t cell : tissue.by_number()) {
        for (std::size_t k = 0; k < tissue.species.size(); ++k) {
            if (std::isfinite(tissue.value(k, cell))) continue;
            TissueFailure failure = failure_of(TissueFailure::Kind::not_finite, tissue);
            failure.number = tissue.numbers()[cell];
            failure.species = k;
            return failure;
        }
    }
    return std::nullopt;
}

TissueStepper::TissueStepper(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
                             std::shared_ptr<NearTriangles> triangles, const TissueSpecies& species,
                             const TissueSchedule& schedule)
    : rules_(rules),
      tissue_(tissue),
      triangles_(std::move(triangles)),
      species_(species),
      schedule_(schedule),
      team_(schedule.threads),
      lists_(rule_of(schedule, surroundings), schedule.skin, schedule.most_list_bytes, species,
             team_),
      values_(team_) {}

Result<void> TissueStepper::reach(const std::vector<Field>& state, double around) {
    if (lists_.reach(tissue_, state, around)) return {};
    return build_lists(state, around > 0);
}

Result<void> TissueStepper::reach(std::span<const std::uint32_t> cells) {
    if (lists_.reach(tissue_, cells)) return {};
    return build_lists(tissue_.species, false);
}

Result<void> TissueStepper::build_lists(const std::vector<Field>& state, bool is_full) {
    auto built = lists_.build(tissue_, state, is_full);
    links_changed();
    return built;
}

void TissueStepper::links_changed() {
    values_.links_changed();
    const auto cells = static_cast<std::int64_t>(tissue_.count());
    for (auto& [stages, problem] : problems_) problem.cells_inside = cells;
}

Result<void> TissueStepper::order_cells() {
    if (!lists_.wants_order(tissue_)) return {};
    lists_.put_in_order(tissue_);
    return cells_changed(false);
}

Result<void> TissueStepper::cells_changed(bool has_moved, std::span<const std::uint32_t> only) {
    triangles_->begin(tissue_.triangles);
    auto found =
        only.empty() ? lists_.build(tissue_, tissue_.species, false) : lists_.renew(tissue_, only);
    if (!found) return found;
    links_changed();
    if (has_moved || !stepper_) {
        values_.clear();
        stepper_.reset();
        problems_.clear();
        rules_.bind(tissue_, lists_.links());
        const StepProblem& first = problem(stages(0));
        stepper_.emplace(first, std::move(tissue_.species), schedule_.threads, false);
        stepper_->executor().use_tiling(Tiling{});
        stepper_->lend(tissue_.species);
    }
    stepper_->forget_rates();
    return {};
}

const StepProblem& TissueStepper::problem(std::uint32_t stages) {
    auto known = problems_.find(stages);
    if (known == problems_.end()) {
        StepProblem made = watched(rules_.step(stages), species_, lists_.watch());
        made.cells_inside = static_cast<std::int64_t>(tissue_.count());
        known = problems_.emplace(stages, std::move(made)).first;
        CHECK((schedule_.tolerance > 0) == known->second.error_register.has_value(),
              "errors are estimated if steps are chosen by them");
    }
    return known->second;
}

std::uint32_t TissueStepper::stages(double length) const {
    if (!is_stabilised(schedule_.solver)) return 1;
    const std::uint32_t least = stages_for(schedule_.solver, length * tissue_.time.stiffness / 2);
    return *std::lower_bound(numbers_of_stages.begin(), numbers_of_stages.end() - 1, least);
}

double TissueStepper::longest_step() const {
    if (!is_stabilised(schedule_.solver) || tissue_.time.stiffness == 0) {
        return std::numeric_limits<double>::infinity();
    }
    return stability_interval(schedule_.solver, most_stages) / tissue_.time.stiffness;
}

StageClock TissueStepper::clock(double length) const {
    return {tissue_.time.steps, tissue_.time.t, length, tissue_.precision()};
}

StepMoment TissueStepper::moment(double length) const {
    const StageClock now = clock(length);
    return {tissue_.time.steps, tissue_.time.t, length, now.at(tissue_.time.steps + 1)};
}

std::vector<double> TissueStepper::sizes() {
    return sizes_of(tissue_.species, tissue_, species_, lists_.mean_radius(), team_);
}

Result<TriedStep> TissueStepper::attempt(double length) {
    for (bool is_full = false;; is_full = true) {
        if (const auto renewed = lists_.renew_restless(tissue_); !renewed) {
            return tl::unexpected(renewed.error());
        }
        links_changed();
        lists_.begin_step(tissue_);
        stepper_->take_back(tissue_.species);
        stepper_->use(problem(stages(length)));
        stepper_->set_clock(clock(length));
        TriedStep tried{stepper_->roles()};
        stepper_->leave_on(*cancel_);
        tried.is_abandoned = !complete([&] {
            if (schedule_.tolerance > 0) {
                stepper_->attempt(tissue_.time.steps, schedule_.tolerance);
            } else if (!stepper_->advance(tissue_.time.steps, 1, true)) {
                tried.error = NAN;
            }
        });
        stepper_->lend(tissue_.species);
        lists_.end_step(tissue_);
        if (tried.is_abandoned) return tried;
        if (!lists_.watch()->left_lists() || is_full) {
            if (schedule_.tolerance > 0) tried.error = error();
            tried.went_too_far = lists_.watch()->went_too_far();
            return tried;
        }
        undo(tried);
        const auto built = build_lists(tissue_.species, true);
        if (!built) return tl::unexpected(built.error());
    }
}

/// The error of the step just tried. Unlike the result of Stepper::attempt(), this error does not
/// depend on the order of cells in memory.
double TissueStepper::error() {
    const std::vector<double> errors = root_mean_squares(stepper_->error_planes(), tissue_, team_);
    const std::vector<double> of_values = sizes();
    double most = 0;
    for (std::size_t k = 0; k < errors.size(); ++k) {
        if (!std::isfinite(errors[k]) || !std::isfinite(of_values[k])) return NAN;
        most = std::max(most, errors[k] / (schedule_.tolerance * of_values[k]));
    }
    return most;
}

Result<TissueStepper::StepEvents> TissueStepper::events(const TriedStep& tried, double length,
                                                        const CurveUser& use) {
    std::vector<Field> old_state = lend_beginning(tried);
    StepEvents result;
    const StepMoment now = moment(length);
    const auto find = [&](const std::vector<Field>& old_rates,
                          const std::vector<Field>& new_rates) -> Result<void> {
        const StepCubic cubic{old_state, tissue_.species, old_rates, new_rates, now};
        if (rules_.conditions().values.problem != nullptr) {
            auto found = events_within(rules_.conditions(), cubic, tissue_, values_,
                                       [this](const auto& state) { return reach(state); });
            if (!found) return tl::unexpected(found.error());
            end_at(*found, cubic, result);
        }
        if (use) use(cubic, result.part);
        if (result.part < 1) cubic.put_all(tissue_.species, result.part);
        return {};
    };
    Result<void> found;
    const std::optional<RateRegisters>& rates = stepper_->problem().rate_registers;
    if (rates) {
        found = find(stepper_->scratch(rates->first), stepper_->scratch(rates->last));
    } else {
        const auto rates_at = [&](std::vector<Field>& state, double t) {
            StepMoment then = now;
            then.t = t;
            std::vector<Field> copies;
            for (const Field& field : values_.run(rules_.rates(), state, tissue_, then)) {
                copies.push_back(field.clone());
            }
            return copies;
        };
        const std::vector<std::uint32_t> nearest = triangles_->now;
        const std::vector<Field> new_rates = rates_at(tissue_.species, now.next_t);
        found = find(rates_at(old_state, now.t), new_rates);
        // If states between the ends of a step are only observed, the nearest triangles must not
        // change.
        if (rules_.conditions().values.problem == nullptr) triangles_->now = nearest;
    }
    take_beginning(tried, std::move(old_state));
    if (!found) return tl::unexpected(found.error());
    return result;
}

/// Decides where the step must end. Adds the events until then to `result` and discards later
/// events.
void TissueStepper::end_at(std::vector<CellEvent>& found, const StepCubic& cubic,
                           StepEvents& result) {
    if (found.empty()) return;
    const bool is_alone = rules_.conditions().values.is_of_cell_alone;
    const std::size_t most = schedule_.has_exact_events ? 0 : tissue_.count() / cells_of_an_event;
    const double length = cubic.moment.length;
    if (!is_alone) {
        result.part = found[0].part;
    } else {
        if (found.size() > most) result.part = found[most].part;
        const double longest = most_of_stiffness / (length * tissue_.time.stiffness);
        result.part = std::min(result.part, found[0].part + longest);
    }
    for (CellEvent& event : found) {
        if (event.part > result.part) break;
        event.left = (result.part - event.part) * length;
        if (event.left > 0) {
            const std::int64_t at = tissue_.element(event.cell);
            event.values = cubic.values(at, event.part);
            event.mean_rates = cubic.values(at, result.part);
            for (std::size_t k = 0; k < event.values.size(); ++k) {
                event.mean_rates[k] = (event.mean_rates[k] - event.values[k]) / event.left;
            }
        }
        result.events.push_back(std::move(event));
    }
    result.has_all = is_alone && result.part == 1;
}

void TissueStepper::accept() {
    if (schedule_.tolerance > 0) stepper_->accept();
    tissue_.triangles = triangles_->now;
    triangles_->before = triangles_->now;
}

void TissueStepper::undo(const TriedStep& tried) {
    stepper_->take_back(tissue_.species);
    stepper_->set_roles(tried.before);
    stepper_->lend(tissue_.species);
}

std::vector<Field> TissueStepper::lend_beginning(const TriedStep& tried) {
    const CopyRoles now = stepper_->roles();
    std::vector<Field> values;
    stepper_->set_roles(tried.before);
    stepper_->lend(values);
    stepper_->set_roles(now);
    return values;
}

void TissueStepper::take_beginning(const TriedStep& tried, std::vector<Field> values) {
    const CopyRoles now = stepper_->roles();
    stepper_->set_roles(tried.before);
    stepper_->take_back(values);
    stepper_->set_roles(now);
}

}  // namespace cascade
