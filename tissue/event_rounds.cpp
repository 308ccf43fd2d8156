// Each round divides and removes cells, builds their lists and gives them their new values.
#include "tissue/event_rounds.h"

#include "tissue/event_search.h"

#include <algorithm>

namespace cascade {
namespace {

/// A cell that would divide more often at one moment would never stop.
constexpr int most_divisions_at_once = 10;

}  // namespace

std::vector<Field>& EventRounds::run(const CellValues& values) {
    return stepper_.values().run(values, tissue_.species,
                                 static_cast<std::int64_t>(tissue_.count()), stepper_.moment(0));
}

std::optional<TissueFailure> EventRounds::happen(CellEvents events) {
    while (tissue_.count() > 0) {
        const CellEvents now = events_at(rules_.conditions(), tissue_.species, tissue_,
                                         stepper_.moment(0), stepper_.values());
        events = joined(events, now);
        if (events.empty()) break;
        if (auto failure = one_round(events)) return failure;
        events = {};
    }
    return std::nullopt;
}

/// One that dies does not divide.
CellEvents EventRounds::joined(const CellEvents& a, const CellEvents& b) const {
    std::vector<bool> dies(tissue_.count(), false), divides(tissue_.count(), false);
    for (const CellEvents* const events : {&a, &b}) {
        for (const std::uint32_t cell : events->dying) dies[cell] = true;
        for (const std::uint32_t cell : events->dividing) divides[cell] = true;
    }
    CellEvents both;
    for (std::uint32_t cell = 0; cell < tissue_.count(); ++cell) {
        if (dies[cell]) {
            both.dying.push_back(cell);
        } else if (divides[cell]) {
            both.dividing.push_back(cell);
        }
    }
    return both;
}

std::optional<TissueFailure> EventRounds::one_round(const CellEvents& events) {
    has_changed_ = true;
    for (const std::uint32_t cell : events.dividing) {
        const std::uint32_t number = tissue_.numbers()[cell];
        const auto known = divisions_.find(number);
        if (known == divisions_.end() || known->second < most_divisions_at_once) continue;
        TissueFailure failure = failure_of(TissueFailure::Kind::divides_for_ever, tissue_);
        failure.number = number;
        return failure;
    }
    const std::size_t cells = tissue_.count() + events.dividing.size() - events.dying.size();
    if (cells > schedule_.most_cells) {
        TissueFailure failure = failure_of(TissueFailure::Kind::too_many_cells, tissue_);
        failure.cells = cells;
        return failure;
    }
    const Divided divided = divide(tissue_, events, directions(events),
                                   {surroundings_, species_, schedule_.seed, schedule_.stage});
    for (std::size_t k = 0; k < divided.mothers.size(); ++k) {
        const int count = ++divisions_[tissue_.numbers()[divided.mothers[k]]];
        divisions_[tissue_.numbers()[divided.children[k]]] = count;
    }
    if (tissue_.count() == 0) return std::nullopt;
    if (auto failure = find_not_finite(tissue_)) return failure;
    auto built = stepper_.cells_changed(divided.has_moved);
    if (built && restart(divided)) built = stepper_.cells_changed(false);
    if (built) return find_not_finite(tissue_);
    TissueFailure failure = failure_of(TissueFailure::Kind::too_many_neighbours, tissue_);
    failure.refusal = built.error();
    return failure;
}

std::vector<Vector3d> EventRounds::directions(const CellEvents& events) {
    std::vector<Vector3d> result;
    const CellValues along = rules_.along();
    if (along.problem == nullptr || events.dividing.empty()) return result;
    const std::vector<Field>& values = run(along);
    for (const std::uint32_t cell : events.dividing) {
        result.push_back({value_in(values[0], tissue_, cell), value_in(values[1], tissue_, cell),
                          value_in(values[2], tissue_, cell)});
    }
    return result;
}

/// Returns whether a cell has grown, so that lists may miss its neighbours.
bool EventRounds::restart(const Divided& divided) {
    const TissueRules::Restarts restarts = rules_.restarts();
    if (restarts.values.problem == nullptr || divided.mothers.empty()) return false;
    const std::vector<Field>& values = run(restarts.values);
    bool has_grown = false;
    for (std::size_t k = 0; k < restarts.species.size(); ++k) {
        const std::size_t species = restarts.species[k];
        for (const auto* const cells : {&divided.mothers, &divided.children}) {
            for (const std::uint32_t cell : *cells) {
                const double value = value_in(values[k], tissue_, cell);
                if (species >= tissue_.species.size()) {
                    tissue_.set_kept(species - tissue_.species.size(), cell, value);
                    continue;
                }
                has_grown = has_grown || (species == species_.radius &&
                                          !(value <= tissue_.value(species, cell)));
                tissue_.set(species, cell, value);
            }
        }
    }
    tissue_.pad();
    return has_grown;
}

}  // namespace cascade
