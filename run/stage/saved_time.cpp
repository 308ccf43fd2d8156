// To and from JSON. The file may have been changed, so ranges are checked.
#include "run/stage/saved_time.h"

#include "ir/solver.h"
#include "run/stage/stage_time.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace cascade {

namespace {

bool is_length(double number) { return std::isfinite(number) && number >= 0; }

bool makes_sense(const Formation& formation) {
    return is_length(formation.least) && is_length(formation.greatest) &&
           is_length(formation.speed);
}

/// A stabilised solver has an odd number of stages. The steps of other solvers on models are split
/// into any number of parts.
bool makes_sense(std::uint32_t stages, Solver solver) {
    if (!is_stabilised(solver)) return stages <= most_substeps;
    return stages <= most_stages && (stages == 0 || stages % 2 == 1);
}

bool makes_sense(const TimeState& time) {
    return is_length(time.least_step) && time.next_judged >= 0 && time.stretch >= 1 &&
           time.bounded_at >= -1 && is_length(time.bounds.whole) && is_length(time.bounds.reaction);
}

bool makes_sense(const SavedTime& saved, Solver solver) {
    const StageClock& clock = saved.state.clock;
    const StepControl::State& control = saved.state.control;
    return is_length(saved.t) && is_length(clock.base_time) && is_length(clock.step) &&
           clock.base_step >= 0 && is_length(control.step) && is_length(control.error_before) &&
           control.error_before > 0 && makes_sense(saved.state.stages, solver) &&
           makes_sense(saved.state) && (!saved.last_look || is_length(*saved.last_look)) &&
           std::all_of(saved.formations.begin(), saved.formations.end(),
                       [](const Formation& formation) { return makes_sense(formation); });
}

nlohmann::json chosen_to_json(const TimeState& time) {
    return {{"least_step", time.least_step}, {"next_judged", time.next_judged},
            {"stretch", time.stretch},       {"bounded_at", time.bounded_at},
            {"whole", time.bounds.whole},    {"reaction", time.bounds.reaction},
            {"jumps", time.bounds.jumps}};
}

void read_chosen(const nlohmann::json& json, TimeState& time) {
    json.at("least_step").get_to(time.least_step);
    json.at("next_judged").get_to(time.next_judged);
    json.at("stretch").get_to(time.stretch);
    json.at("bounded_at").get_to(time.bounded_at);
    json.at("whole").get_to(time.bounds.whole);
    json.at("reaction").get_to(time.bounds.reaction);
    json.at("jumps").get_to(time.bounds.jumps);
}

nlohmann::json to_json(std::span<const Formation> formations) {
    nlohmann::json json = nlohmann::json::array();
    for (const Formation& formation : formations) {
        json.push_back({{"least", formation.least},
                        {"greatest", formation.greatest},
                        {"speed", formation.speed},
                        {"risen", formation.risen}});
    }
    return json;
}

Formation formation_from(const nlohmann::json& json) {
    Formation formation;
    json.at("least").get_to(formation.least);
    json.at("greatest").get_to(formation.greatest);
    json.at("speed").get_to(formation.speed);
    json.at("risen").get_to(formation.risen);
    return formation;
}

}  // namespace

nlohmann::json to_json(const StageState& state) {
    nlohmann::json json = {{"t", state.t},
                           {"base_step", state.time.clock.base_step},
                           {"base_time", state.time.clock.base_time},
                           {"step", state.time.clock.step},
                           {"stages", state.time.stages},
                           {"next_step", state.time.control.step},
                           {"error_before", state.time.control.error_before},
                           {"rejected", state.time.control.rejected},
                           {"chosen", chosen_to_json(state.time)}};
    if (!state.watch.last().empty()) {
        json["last_look"] = state.watch.last_time();
        json["formations"] = to_json(state.watch.formations());
    }
    return json;
}

std::optional<SavedTime> saved_time_from(const nlohmann::json& json, Solver solver) {
    SavedTime saved;
    json.at("t").get_to(saved.t);
    json.at("base_step").get_to(saved.state.clock.base_step);
    json.at("base_time").get_to(saved.state.clock.base_time);
    json.at("step").get_to(saved.state.clock.step);
    json.at("stages").get_to(saved.state.stages);
    json.at("next_step").get_to(saved.state.control.step);
    json.at("error_before").get_to(saved.state.control.error_before);
    json.at("rejected").get_to(saved.state.control.rejected);
    read_chosen(json.at("chosen"), saved.state);
    if (json.contains("last_look")) {
        saved.last_look = json.at("last_look").get<double>();
        for (const nlohmann::json& each : json.at("formations")) {
            saved.formations.push_back(formation_from(each));
        }
    }
    if (!makes_sense(saved, solver)) return std::nullopt;
    return saved;
}

}  // namespace cascade
