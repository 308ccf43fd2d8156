// Saved runs: a folder with STAGE.NAME.npy for every field, and run.json with the rest.

#include "core/file.h"
#include "picture/npy.h"
#include "run/bound_kernel.h"
#include "run/png_texts.h"
#include "run/run.h"
#include "run/saved_time.h"
#include "solvers/finite.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace cascade {

namespace {

constexpr std::uint64_t largest_manifest = std::uint64_t{64} << 20;

std::filesystem::path array_path(const std::filesystem::path& folder, const Stage& stage,
                                 std::string_view item) {
    return folder / fmt::format("{}.{}.npy", stage.name, item);
}

std::string manifest(const Script& script, const Simulation& simulation) {
    nlohmann::json stages = nlohmann::json::array();
    for (std::uint32_t k = 0; k < script.program->stages.size(); ++k) {
        const StageState& state = simulation.state(k);
        if (!state.started) break;
        stages.push_back({{"name", script.program->stages[k].name},
                          {"steps", state.steps},
                          {"done", state.done},
                          {"condition_met", state.condition_met},
                          {"time", to_json(state)}});
    }
    const nlohmann::json json = {
        {"cascade", version()},
        {"name", script.name},
        {"script", script.text},
        {"folder", std::filesystem::absolute(script.folder).string()},
        {"overrides", nlohmann::json::parse(overrides_to_json(script.overrides))},
        {"grid", {simulation.grid().width, simulation.grid().height, simulation.grid().depth}},
        {"seed", script.program->domain.seed},
        {"stages", stages},
    };
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result<nlohmann::json> read_manifest(const std::filesystem::path& folder) {
    const auto text = read_file(folder / "run.json", largest_manifest);
    if (!text) {
        return failure(fmt::format("{} holds no saved run: {}", folder.string(),
                                   text.error().message),
                       "--resume takes a folder that --save has written");
    }
    auto json = nlohmann::json::parse(*text, nullptr, false);
    if (json.is_discarded() || !json.is_object()) {
        return failure(fmt::format("{}: this is not a manifest of a saved run",
                                   (folder / "run.json").string()));
    }
    return json;
}

Failure damaged(const std::filesystem::path& folder, const std::string& why) {
    return {fmt::format("the saved run in {} is damaged: {}", folder.string(), why), ""};
}

/// Species as they were at the last look of `until: steady(…)` have this behind their names.
constexpr std::string_view last_look = ".last";

Result<std::vector<Field>> read_species(const std::filesystem::path& folder,
                                        const Simulation& simulation, std::uint32_t stage,
                                        std::string_view suffix = "") {
    std::vector<Field> species;
    const Program& program = simulation.program();
    const System& system = program.system_of(stage);
    const auto model = simulation.model();
    const Grid grid = model ? Grid{static_cast<std::int64_t>(model->count()), 1} : program.domain.grid;
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        if (!system.is_species(item)) continue;
        const auto path = array_path(folder, program.stages[stage],
                                     fmt::format("{}{}", system.item_name(item), suffix));
        const auto array = read_npy(path, program.domain.precision);
        if (!array) return tl::unexpected(damaged(folder, array.error().message));
        if (!fits(*array, grid)) {
            return tl::unexpected(
                damaged(folder, fmt::format("{} has another shape", path.filename().string())));
        }
        Field field = to_field(*array, program.domain.precision);
        if (model) field = in_rows(field, *model);
        // Outside of the mask files have NaN and runs have 0.
        if (simulation.mask()) field = with_outside(field, *simulation.mask(), 0);
        if (first_not_finite(field)) {
            return tl::unexpected(damaged(
                folder, fmt::format("{} has a value that is not finite", path.filename().string())));
        }
        species.push_back(std::move(field));
    }
    return species;
}

}  // namespace

Result<std::vector<std::filesystem::path>> save_run(const std::filesystem::path& folder,
                                                    const Script& script,
                                                    const Simulation& simulation) {
    if (auto made = make_folder(folder); !made) return tl::unexpected(made.error());
    // The manifest comes last: a folder without one is not taken for a saved run. Nor is one whose
    // arrays are half new and half of an earlier run.
    const auto path_of_manifest = folder / "run.json";
    std::error_code error;
    std::filesystem::remove(path_of_manifest, error);
    std::vector<std::filesystem::path> written;
    const Program& program = *script.program;
    const auto write = [&](const std::filesystem::path& path, const Field& field) {
        const DomainMask* mask = simulation.mask();
        if (mask) return write_npy(path, with_outside(field, *mask, nothing_outside));
        if (simulation.model()) return write_npy(path, in_one_row(field, *simulation.model()));
        return write_npy(path, field);
    };
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (!simulation.state(k).started) break;
        const System& system = program.system_of(k);
        for (std::uint32_t item = 0; item < system.item_count(); ++item) {
            if (!system.is_species(item) && program.stages[k].uniform[item]) continue;
            const auto path = array_path(folder, program.stages[k], system.item_name(item));
            if (auto done = write(path, simulation.state(k).field(item)); !done) {
                return tl::unexpected(done.error());
            }
            written.push_back(path);
        }
        const std::span<const Field> looked_at = simulation.state(k).watch.last();
        for (std::size_t species = 0; species < looked_at.size(); ++species) {
            const auto path =
                array_path(folder, program.stages[k],
                           fmt::format("{}{}", species_name(system, species), last_look));
            if (auto done = write(path, looked_at[species]); !done) {
                return tl::unexpected(done.error());
            }
            written.push_back(path);
        }
    }
    if (auto done = write_file(path_of_manifest, manifest(script, simulation)); !done) {
        return tl::unexpected(done.error());
    }
    written.push_back(path_of_manifest);
    return written;
}

Result<Script> load_saved_script(const std::filesystem::path& folder, const Overrides& changes) {
    auto json = read_manifest(folder);
    if (!json) return tl::unexpected(json.error());
    if (!changes.sets.empty() || changes.grid || changes.seed || changes.solver || changes.precision ||
        changes.fast) {
        return failure("a resumed run keeps its grid, seed, precision, rounding, parameters and solver",
                       "only --steps and --until-stage can change");
    }
    try {
        auto overrides = overrides_from_json(json->at("overrides").dump());
        if (!overrides) return tl::unexpected(damaged(folder, overrides.error().message));
        // A cap that made the run stop would make the resumed one stop as well.
        overrides->steps = changes.steps;
        overrides->until_stage = changes.until_stage;
        overrides->reads = changes.reads;
        return load_script(json->at("name").get<std::string>(),
                           json->at("script").get<std::string>(),
                           json->at("folder").get<std::string>(), std::move(*overrides));
    } catch (const nlohmann::json::exception&) {
        return tl::unexpected(damaged(folder, "run.json lacks something or has it wrong"));
    }
}

Result<void> restore_run(const std::filesystem::path& folder, const Script& script,
                         Simulation& simulation) {
    auto json = read_manifest(folder);
    if (!json) return tl::unexpected(json.error());
    try {
        const auto& stages = json->at("stages");
        if (!stages.is_array()) return tl::unexpected(damaged(folder, "its stages are no list"));
        if (stages.size() > script.program->stages.size()) {
            return tl::unexpected(damaged(folder, "it has more stages than its script"));
        }
        for (std::uint32_t k = 0; k < stages.size(); ++k) {
            if (stages[k].at("name") != script.program->stages[k].name ||
                !stages[k].at("steps").is_number_integer()) {
                return tl::unexpected(damaged(folder, fmt::format("stage {} is not right", k + 1)));
            }
            const auto steps = stages[k].at("steps").get<std::int64_t>();
            bool done = stages[k].at("done").get<bool>();
            const bool condition_met = stages[k].value("condition_met", done);
            // More steps may be asked for than before; but what a later stage began from stays.
            const bool is_last = k + 1 == stages.size();
            done = done && (!is_last || condition_met || steps >= script.program->stages[k].iterations);
            if (steps < 0) return tl::unexpected(damaged(folder, "a number of steps is negative"));
            if (auto started = simulation.start_stage(k); !started) return started;
            auto species = read_species(folder, simulation, k);
            if (!species) return tl::unexpected(species.error());
            simulation.set_species(k, std::move(*species), steps, done, condition_met);
            if (!stages[k].contains("time")) continue;
            const auto time = saved_time_from(
                stages[k].at("time"), script.program->stages[k].time.solver);
            if (!time) return tl::unexpected(damaged(folder, "its time makes no sense"));
            SteadyWatch watch;
            if (time->last_look) {
                auto looked_at = read_species(folder, simulation, k, last_look);
                if (!looked_at) return tl::unexpected(looked_at.error());
                if (time->formations.size() != looked_at->size()) {
                    return tl::unexpected(damaged(folder, "it lacks how a species has formed"));
                }
                watch.remember(std::move(*looked_at), *time->last_look, time->formations);
            }
            simulation.set_time(k, time->t, time->state, std::move(watch));
        }
    } catch (const nlohmann::json::exception&) {
        return tl::unexpected(damaged(folder, "run.json lacks something or has it wrong"));
    }
    return {};
}

}  // namespace cascade
