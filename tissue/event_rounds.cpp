// Each round divides and removes cells, builds their lists and sets their new values.
#include "tissue/event_rounds.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

/// The largest number of divisions of a cell at one moment. A cell that exceeds this number would
/// never stop dividing.
constexpr int most_divisions_at_once = 10;

}  // namespace

std::vector<Field>& EventRounds::run(const CellValues& values,
                                     std::span<const std::uint32_t> among) {
    return stepper_.values().run(values, tissue_.species, tissue_, stepper_.moment(0), among);
}

std::optional<TissueFailure> EventRounds::happen(std::vector<CellEvent> events, bool are_all) {
    const auto ranks = tissue_.ranks();
    std::sort(events.begin(), events.end(), [&](const CellEvent& a, const CellEvent& b) {
        return ranks[a.cell] < ranks[b.cell];
    });
    const bool is_alone = rules_.conditions().values.is_of_cell_alone;
    while (tissue_.count() > 0) {
        if (events.empty()) {
            std::span<const std::uint32_t> among;
            if (is_alone && are_all) among = changed_;
            if (is_alone && are_all && changed_.empty()) break;
            events = events_at(rules_.conditions(), tissue_.species, tissue_, stepper_.moment(0),
                               stepper_.values(), among);
            are_all = true;
        }
        if (events.empty()) break;
        if (auto failure = one_round(events)) return failure;
        events.clear();
    }
    return std::nullopt;
}

/// Returns a failure if a cell divides too often at one moment, or if the events would make too
/// many cells.
std::optional<TissueFailure> EventRounds::refuse(std::span<const CellEvent> events) {
    std::size_t cells = tissue_.count();
    for (const CellEvent& event : events) {
        cells += event.dies ? -std::size_t{1} : 1;
        if (event.dies) continue;
        const std::uint32_t number = tissue_.numbers()[event.cell];
        const auto known = divisions_.find(number);
        if (known == divisions_.end() || known->second < most_divisions_at_once) continue;
        TissueFailure failure = failure_of(TissueFailure::Kind::divides_for_ever, tissue_);
        failure.number = number;
        return failure;
    }
    if (cells <= schedule_.most_cells) return std::nullopt;
    TissueFailure failure = failure_of(TissueFailure::Kind::too_many_cells, tissue_);
    failure.cells = cells;
    return failure;
}

std::optional<TissueFailure> EventRounds::one_round(std::span<const CellEvent> events) {
    has_changed_ = true;
    if (auto failure = refuse(events)) return failure;
    const Divided divided = divide(tissue_, events, directions(events),
                                   {surroundings_, species_, schedule_.seed, schedule_.stage});
    for (std::size_t k = 0; k < divided.mothers.size(); ++k) {
        const int count = ++divisions_[tissue_.numbers()[divided.mothers[k]]];
        divisions_[tissue_.numbers()[divided.children[k]]] = count;
    }
    changed_ = divided.mothers;
    changed_.insert(changed_.end(), divided.children.begin(), divided.children.end());
    std::sort(changed_.begin(), changed_.end(),
              [ranks = tissue_.ranks()](auto a, auto b) { return ranks[a] < ranks[b]; });
    if (tissue_.count() == 0) return std::nullopt;
    if (auto failure = find_not_finite(tissue_)) return failure;
    std::vector<CellEvent> dividing;
    std::copy_if(events.begin(), events.end(), std::back_inserter(dividing),
                 [](const CellEvent& event) { return !event.dies; });
    std::vector<std::uint32_t> elsewhere = changed_;
    elsewhere.insert(elsewhere.end(), divided.moved.begin(), divided.moved.end());
    auto built = stepper_.cells_changed(divided.has_moved, elsewhere);
    if (built) built = stepper_.reach(tissue_.species);
    // From here on, only mothers and their new cells change.
    if (built && !dividing.empty()) {
        restart(dividing, divided);
        built = carry(dividing, divided);
    }
    if (built) built = stepper_.reach(changed_);
    if (built) return find_not_finite(tissue_);
    TissueFailure failure = failure_of(TissueFailure::Kind::too_many_neighbours, tissue_);
    failure.refusal = built.error();
    return failure;
}

std::vector<Vector3d> EventRounds::directions(std::span<const CellEvent> events) {
    std::vector<Vector3d> result;
    const CellValues along = rules_.along();
    if (along.problem == nullptr) return result;
    std::vector<std::uint32_t> cells;
    for (const CellEvent& event : events) {
        if (!event.dies) cells.push_back(event.cell);
    }
    if (cells.empty()) return result;
    const std::vector<Field>& values = run(along, cells);
    for (const std::uint32_t cell : cells) {
        result.push_back({value_in(values[0], tissue_, cell), value_in(values[1], tissue_, cell),
                          value_in(values[2], tissue_, cell)});
    }
    return result;
}

/// Computes new values from the values at the moment of division.
void EventRounds::restart(std::span<const CellEvent> dividing, const Divided& divided) {
    const TissueRules::Restarts restarts = rules_.restarts();
    if (restarts.values.problem == nullptr) return;
    const auto each_late_value = [&](const auto& use) {
        for (std::size_t n = 0; n < dividing.size(); ++n) {
            for (std::size_t k = 0; k < dividing[n].values.size(); ++k) {
                if (is_place(k)) continue;
                use(k, divided.mothers[n], dividing[n].values[k]);
                use(k, divided.children[n], dividing[n].values[k]);
            }
        }
    };
    std::vector<double> at_end;
    each_late_value([&](std::size_t k, std::uint32_t cell, double value) {
        at_end.push_back(tissue_.value(k, cell));
        tissue_.set(k, cell, value);
    });
    tissue_.pad();
    const std::vector<Field>& values = run(restarts.values, changed_);
    std::size_t next = 0;
    each_late_value(
        [&](std::size_t k, std::uint32_t cell, double) { tissue_.set(k, cell, at_end[next++]); });
    for (std::size_t k = 0; k < restarts.species.size(); ++k) {
        const std::size_t species = restarts.species[k];
        for (const auto* const cells : {&divided.mothers, &divided.children}) {
            for (const std::uint32_t cell : *cells) {
                const double value = value_in(values[k], tissue_, cell);
                if (species < tissue_.species.size()) {
                    tissue_.set(species, cell, value);
                } else {
                    tissue_.set_kept(species - tissue_.species.size(), cell, value);
                }
            }
        }
    }
    tissue_.pad();
}

/// Advances both cells of a division from its moment to the end of the step, by Heun's method. Both
/// begin with the values that the undivided mother would have at the end of the step. So this
/// function adds only the difference between the cells' rates and the mother's rates, except for
/// restarted values. All other cells are already at their positions at the end of the step.
Result<void> EventRounds::carry(std::span<const CellEvent> dividing, const Divided& divided) {
    std::vector<std::uint32_t> cells;
    struct Value {
        std::uint32_t cell;
        std::size_t species;
        double left, mothers_rate, beginning, first_rate;
    };
    std::vector<Value> values;
    double most = 0;
    const std::vector<std::size_t> restarted = rules_.restarts().species;
    for (std::size_t n = 0; n < dividing.size(); ++n) {
        const CellEvent& event = dividing[n];
        if (event.left == 0) continue;
        most = std::max(most, event.left);
        cells.insert(cells.end(), {divided.mothers[n], divided.children[n]});
        for (std::size_t k = 0; k < event.values.size(); ++k) {
            const bool is_new = std::find(restarted.begin(), restarted.end(), k) != restarted.end();
            const double rate = is_new ? 0 : event.mean_rates[k];
            values.push_back({divided.mothers[n], k, event.left, rate, 0, 0});
            values.push_back({divided.children[n], k, event.left, rate, 0, 0});
        }
    }
    if (values.empty()) return {};
    const double steps = std::max(1.0, std::ceil(most * tissue_.time.stiffness / 2));
    for (int half_step = 0; half_step < 2 * steps; ++half_step) {
        if (auto reached = stepper_.reach(cells); !reached) return reached;
        const std::vector<Field>& rates = run(rules_.rates(), cells);
        for (Value& each : values) {
            const double rate =
                value_in(rates[each.species], tissue_, each.cell) - each.mothers_rate;
            const double length = each.left / steps;
            if (half_step % 2 == 0) {
                each.beginning = tissue_.value(each.species, each.cell);
                each.first_rate = rate;
                tissue_.set(each.species, each.cell, each.beginning + length * rate);
            } else {
                tissue_.set(each.species, each.cell,
                            each.beginning + length / 2 * (each.first_rate + rate));
            }
        }
        tissue_.pad();
    }
    return {};
}

}  // namespace cascade
