#include "run/saved_time.h"

#include "ir/solver.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace cascade {

namespace {

bool is_length(double number) { return std::isfinite(number) && number >= 0; }

bool makes_sense(const SavedTime& saved) {
    const StageClock& clock = saved.state.clock;
    const StepControl::State& control = saved.state.control;
    return is_length(saved.t) && is_length(clock.base_time) && is_length(clock.step) &&
           clock.base_step >= 0 && is_length(control.step) && is_length(control.error_before) &&
           control.error_before > 0 && saved.state.stages <= most_stages &&
           (saved.state.stages == 0 || saved.state.stages % 2 == 1) &&
           (!saved.last_look || is_length(*saved.last_look));
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
                           {"rejected", state.time.control.rejected}};
    if (!state.watch.last().empty()) json["last_look"] = state.watch.last_time();
    return json;
}

std::optional<SavedTime> saved_time_from(const nlohmann::json& json) {
    SavedTime saved;
    json.at("t").get_to(saved.t);
    json.at("base_step").get_to(saved.state.clock.base_step);
    json.at("base_time").get_to(saved.state.clock.base_time);
    json.at("step").get_to(saved.state.clock.step);
    json.at("stages").get_to(saved.state.stages);
    json.at("next_step").get_to(saved.state.control.step);
    json.at("error_before").get_to(saved.state.control.error_before);
    json.at("rejected").get_to(saved.state.control.rejected);
    if (json.contains("last_look")) saved.last_look = json.at("last_look").get<double>();
    if (!makes_sense(saved)) return std::nullopt;
    return saved;
}

}  // namespace cascade
