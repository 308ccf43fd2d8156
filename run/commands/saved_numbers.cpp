// Each struct has a single list of its members, with the smallest valid value of each member. All
// numbers are checked, because the file may have been changed.
#include "run/commands/saved_numbers.h"

#include "run/stage/stage_time.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace cascade {

namespace {

constexpr auto members_of_progress = [](auto& progress, const auto& visit) {
    visit("t", progress.t, 0);
    visit("base_step", progress.time.clock.base_step, 0);
    visit("base_time", progress.time.clock.base_time, 0);
    visit("step", progress.time.clock.step, 0);
    visit("stages", progress.time.stages, 0);
    visit("next_step", progress.time.control.step, 0);
    visit("error_before", progress.time.control.error_before, std::numeric_limits<double>::min());
    visit("rejected", progress.time.control.rejected, 0);
};

constexpr auto members_of_chosen_steps = [](auto& time, const auto& visit) {
    visit("least_step", time.least_step, 0);
    visit("next_judged", time.next_judged, 0);
    visit("stretch", time.stretch, 1);
    visit("bounded_at", time.bounded_at, -1);
    visit("whole", time.bounds.whole, 0);
    visit("reaction", time.bounds.reaction, 0);
    visit("jumps", time.bounds.jumps, 0);
};

constexpr auto members_of_formation = [](auto& formation, const auto& visit) {
    visit("least", formation.least, 0);
    visit("greatest", formation.greatest, 0);
    visit("speed", formation.speed, 0);
    visit("risen", formation.risen, 0);
};

constexpr auto members_of_tissue_time = [](auto& time, const auto& visit) {
    visit("t", time.t, 0);
    visit("steps", time.steps, 0);
    visit("step", time.control.step, 0);
    visit("error_before", time.control.error_before, 0);
    visit("rejected", time.control.rejected, 0);
    visit("stiffness", time.stiffness, 0);
    visit("estimated_at", time.estimated_at, -1);
    visit("last_event", time.last_event, 0);
    visit("progress", time.progress, 0);
    visit("compared_at", time.compared_at, 0);
    visit("compared_births", time.compared_births, 0);
    visit("compared_deaths", time.compared_deaths, 0);
    visit("compared_cells", time.compared_cells, 0);
};

nlohmann::json write(const auto& record, const auto& members) {
    nlohmann::json json;
    members(record, [&](const char* key, const auto& member, double) { json[key] = member; });
    return json;
}

bool read(const nlohmann::json& json, auto& record, const auto& members) {
    bool makes_sense = true;
    members(record, [&](const char* key, auto& member, double least) {
        json.at(key).get_to(member);
        const auto number = static_cast<double>(member);
        makes_sense = makes_sense && std::isfinite(number) && number >= least;
    });
    return makes_sense;
}

/// Whether steps with this number of parts are valid. Stabilised solvers divide a step into an odd
/// number of stages. Other solvers may divide steps on models into any number of parts.
bool makes_sense(std::uint32_t stages, Solver solver) {
    if (!is_stabilised(solver)) return stages <= most_substeps;
    return stages <= most_stages && (stages == 0 || stages % 2 == 1);
}

}  // namespace

nlohmann::json to_json(const StageMoment& progress) {
    nlohmann::json json = write(progress, members_of_progress);
    json["chosen"] = write(progress.time, members_of_chosen_steps);
    if (progress.watch.last().empty()) return json;
    json["last_look"] = progress.watch.last_time();
    json["formations"] = nlohmann::json::array();
    for (const Formation& formation : progress.watch.formations())
        json["formations"].push_back(write(formation, members_of_formation));
    return json;
}

nlohmann::json to_json(const TissueTime& time) { return write(time, members_of_tissue_time); }

bool read_json(const nlohmann::json& json, Solver solver, StageMoment& progress,
               std::optional<SavedLook>& look) {
    bool good = read(json, progress, members_of_progress);
    good = read(json.at("chosen"), progress.time, members_of_chosen_steps) && good;
    good = makes_sense(progress.time.stages, solver) && good;
    if (!json.contains("last_look")) return good;
    look.emplace();
    json.at("last_look").get_to(look->t);
    for (const nlohmann::json& each : json.at("formations"))
        good = read(each, look->formations.emplace_back(), members_of_formation) && good;
    return good && std::isfinite(look->t) && look->t >= 0;
}

bool read_json(const nlohmann::json& json, TissueTime& time) {
    return read(json, time, members_of_tissue_time) && time.last_event <= time.t;
}

}  // namespace cascade
