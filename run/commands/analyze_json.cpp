// Writes one object for the stage, with one object for each of its flat states.
#include "run/commands/analyze_json.h"

#include "analysis/describe_parameters.h"
#include "analysis/growing_domain.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace cascade {

namespace {

using Json = nlohmann::ordered_json;
using namespace analysis;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json rate(Complex value) { return Json::array({number(value.real()), number(value.imag())}); }
double length(double phase) { return 2 * std::numbers::pi / phase; }

Json values(const LinearModel& model, const Vector& species) {
    Json object = Json::object();
    for (std::size_t k = 0; k < model.species_count(); ++k) {
        object[std::string(model.system().item_name(model.species[k]))] =
            number(species[static_cast<Eigen::Index>(k)]);
    }
    return object;
}

Json curve(const Branch& branch) {
    Json phases = Json::array(), largest = Json::array();
    for (std::size_t k = 0; k < branch.phases.size(); ++k) {
        phases.push_back(number(branch.phases[k]));
        largest.push_back(rate(branch.largest[k]));
    }
    return {{"phase", phases}, {"rate", largest}};
}

Json state_as_json(const LinearModel& model, const StateAnalysis& state) {
    const Dispersion& relation = state.relation;
    Json bands = Json::array();
    for (const GrowingBand& band : relation.bands) {
        bands.push_back(Json::array({number(length(band.most)), number(length(band.least))}));
    }
    Json steps = Json::object();
    for (const StableStep& step : state.steps) {
        steps[std::string(cascade::name_of(step.solver))] = number(step.step);
    }
    return {{"species", values(model, state.state.species)},
            {"from_start", state.state.is_from_start},
            {"class", std::string(analysis::name_of(relation.stability))},
            {"rate_at_rest", rate(relation.at_rest)},
            {"fastest",
             {{"cells", number(relation.fastest.cells())},
              {"direction", relation.fastest.direction},
              {"rate", rate(relation.fastest.rate)}}},
            {"growing_cells", bands},
            {"stable_steps", steps},
            {"curve", curve(relation.curve)}};
}

Json class_of(const std::optional<Stability>& stability) {
    return stability ? Json(class_name(stability)) : Json(nullptr);
}

/// Describes the amplitude equations at an onset. Returns null if they are unknown.
Json amplitudes_of(const CriticalValue& change) {
    if (!change.amplitudes) return nullptr;
    const AmplitudeEquations& by = *change.amplitudes;
    return {{"wave", std::vector<double>(by.wave.begin(), by.wave.end())},
            {"quadratic", number(by.quadratic)},
            {"self", number(by.self)},
            {"cross", number(by.cross)},
            {"stripes_from", number(change.stripes)}};
}

Json scan_as_json(const System& system, const ParameterScan& scan) {
    Json changes = Json::array();
    for (const CriticalValue& change : scan.changes) {
        changes.push_back({{"value", number(change.value)},
                           {"below", class_of(change.below)},
                           {"above", class_of(change.above)},
                           {"cells", number(change.cells)},
                           {"amplitudes", amplitudes_of(change)}});
    }
    return {{"name", std::string(system.item_name(scan.span.item))},
            {"low", number(scan.span.low)},
            {"high", number(scan.span.high)},
            {"present", number(scan.present)},
            {"changes", changes}};
}

/// Describes the map by rows of numbers. Each number is an index into the list of classes.
Json map_as_json(const System& system, const ParameterMap& map) {
    const std::vector<std::optional<Stability>> all{std::nullopt,      Stability::stable,
                                                    Stability::turing, Stability::wave,
                                                    Stability::hopf,   Stability::both,
                                                    Stability::uniform};
    Json names = Json::array(), rows = Json::array();
    for (const auto& each : all) names.push_back(class_of(each));
    for (std::size_t j = 0; j < map.side; ++j) {
        Json row = Json::array();
        for (std::size_t i = 0; i < map.side; ++i) {
            const auto& stability = map.classes[j * map.side + i];
            row.push_back(stability ? 1 + static_cast<int>(*stability) : 0);
        }
        rows.push_back(std::move(row));
    }
    const auto axis = [&](const ParameterSpan& span) -> Json {
        return {{"name", std::string(system.item_name(span.item))},
                {"low", number(span.low)},
                {"high", number(span.high)}};
    };
    return {{"across", axis(map.across)}, {"up", axis(map.up)}, {"classes", names}, {"rows", rows}};
}

/// The waves that grow at times of a stage whose domain grows. Null if its lengths do not change.
Json growth_as_json(const LinearModel& model) {
    const auto moments = moments_of_growing_domain(*model.program, model.stage);
    if (moments.empty()) return nullptr;
    Json rows = Json::array();
    for (const GrowingMoment& moment : moments) {
        Json row = {{"t", number(moment.t)}, {"lengths", moment.lengths}};
        row["waves"] = moment.waves ? Json{{"least", number(moment.waves->least)},
                                           {"most", number(moment.waves->most)},
                                           {"fastest", number(moment.waves->fastest)}}
                                    : Json(nullptr);
        rows.push_back(std::move(row));
    }
    return {{"counted", counted_waves(model.program->domain)}, {"moments", rows}};
}

}  // namespace

std::string analysis_as_json(const StageAnalysis& analysis, std::span<const ParameterScan> scans,
                             const ParameterMap* map) {
    const LinearModel& model = analysis.model;
    Json states = Json::array();
    for (const StateAnalysis& state : analysis.states)
        states.push_back(state_as_json(model, state));
    Json parameters = Json::object();
    for (const ItemId item : model.parameters) {
        const auto* value = model.algebra[model.starts[item].value].as<double>();
        if (value != nullptr) {
            parameters[std::string(model.system().item_name(item))] = number(*value);
        }
    }
    const Lattice lattice = lattice_of(*model.program);
    Json critical = Json::array();
    for (const ParameterScan& scan : scans) critical.push_back(scan_as_json(model.system(), scan));
    Json all = {{"stage", model.program->stages[model.stage].name},
                {"system", model.system().name},
                {"spacing", number(lattice.spacing)},
                {"step", analysis.step ? number(*analysis.step) : Json(nullptr)},
                {"parameters", parameters},
                {"start", values(model, analysis.start)},
                {"keeps_totals", analysis.has_conserved_totals},
                {"states", states},
                {"critical", critical}};
    if (Json growth = growth_as_json(model); !growth.is_null()) all["growth"] = std::move(growth);
    if (map != nullptr) all["map"] = map_as_json(model.system(), *map);
    return all.dump(1) + "\n";
}

}  // namespace cascade
