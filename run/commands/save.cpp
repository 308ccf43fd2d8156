// Saves runs to a folder, with STAGE.NAME.npy for every field, and run.json for everything else.

#include "core/file.h"
#include "core/version.h"
#include "run/commands/run.h"
#include "run/commands/saved_folder.h"
#include "run/commands/saved_stage.h"
#include "run/script/embedded_script.h"
#include "run/script/script_folder.h"
#include "run/simulation/stage_record.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace cascade {

namespace {

nlohmann::json manifest(const Script& script, const Simulation& simulation, nlohmann::json stages) {
    return {
        {"cascade", version()},
        {"name", portable_path(script.name)},
        {"script", script.text},
        {"overrides", nlohmann::json::parse(overrides_to_json(script.overrides))},
        {"grid",
         {simulation.domain().grid.width, simulation.domain().grid.height,
          simulation.domain().grid.depth}},
        {"seed", script.program->domain.seed},
        {"stages", std::move(stages)},
    };
}

Failure damaged(const std::filesystem::path& folder, const std::string& why) {
    return {fmt::format("the saved run in {} is damaged: {}", folder.string(), why), ""};
}

}  // namespace

Result<void> check_savable(const std::filesystem::path& folder, const Script& script) {
    std::vector<std::string> names;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k)
        std::ranges::move(stage_arrays(*script.program, k), std::back_inserter(names));
    return check_savable(folder, names);
}

Result<std::vector<std::filesystem::path>> save_run(const std::filesystem::path& folder,
                                                    const Script& script,
                                                    const Simulation& simulation) {
    if (auto made = make_folder(folder); !made) return tl::unexpected(made.error());
    auto change = SavedFolderChange::begin(folder);
    if (!change) return tl::unexpected(change.error());
    nlohmann::json stages = nlohmann::json::array();
    for (std::uint32_t k = 0; k < script.program->stages.size(); ++k) {
        if (!simulation.state(k).started) break;
        auto saved = save_stage(**change, simulation, k);
        if (!saved) return tl::unexpected(saved.error());
        stages.push_back(std::move(*saved));
    }
    return (*change)->commit(manifest(script, simulation, std::move(stages)));
}

namespace {

/// Takes over the new path of the model, if the user has given one. Refuses a different model.
Result<void> take_model(Overrides& saved, const Overrides& changes) {
    if (!changes.model) return {};
    const auto name = [](const std::string& path) {
        return std::filesystem::path(path).filename();
    };
    if (!saved.model || name(*saved.model) != name(*changes.model)) {
        return failure("a resumed run cannot change its model",
                       "use --mesh only for the new "
                       "location of the same model");
    }
    saved.model = changes.model;
    saved.model_is_asked_for = changes.model_is_asked_for;
    return {};
}

/// Checks whether run.json and the script have the same grid and seed.
Result<void> check_against_script(const std::filesystem::path& folder, const nlohmann::json& json,
                                  const Script& script, const Simulation& simulation) {
    const Grid& grid = simulation.domain().grid;
    if (json.at("grid") != nlohmann::json{grid.width, grid.height, grid.depth}) {
        return tl::unexpected(damaged(folder, "its grid differs from the grid of its script"));
    }
    if (json.at("seed") != script.program->domain.seed) {
        return tl::unexpected(damaged(folder, "its seed differs from the seed of its script"));
    }
    return {};
}

}  // namespace

Result<Script> load_saved_script(const std::filesystem::path& folder, const Overrides& changes,
                                 const std::filesystem::path& script_folder, const Script* look) {
    auto json = read_saved_manifest(folder);
    if (!json) return tl::unexpected(json.error());
    if (!changes.sets.empty() || changes.grid || changes.seed || changes.solver ||
        changes.precision || changes.fast || changes.cells || changes.up || changes.facing) {
        return failure(
            "a resumed run cannot change its grid, seed, precision, rounding, parameters or solver",
            "--steps, --until-stage and --allow-read can change, and --mesh can give the new "
            "location of the same model");
    }
    try {
        auto overrides = overrides_from_json(json->at("overrides").dump());
        if (!overrides) return tl::unexpected(damaged(folder, overrides.error().message));
        // The saved run's limit on steps is not taken over, because it would stop the resumed run,
        // too.
        overrides->steps = changes.steps;
        overrides->until_stage = changes.until_stage;
        overrides->reads = changes.reads;
        if (auto same = take_model(*overrides, changes); !same) return tl::unexpected(same.error());
        const auto name = json->at("name").get<std::string>();
        const auto text = json->at("script").get<std::string>();
        const auto files =
            script_folder.empty() ? find_script_folder(folder, name, text) : script_folder;
        Script script = load_script(look ? look->name : name, look ? look->text : text, files,
                                    std::move(*overrides));
        script.file = folder;
        return script;
    } catch (const nlohmann::json::exception&) {
        return tl::unexpected(damaged(folder, "run.json is incomplete or malformed"));
    }
}

Result<void> restore_run(const std::filesystem::path& folder, const Script& script,
                         Simulation& simulation, const std::atomic<bool>& cancel) {
    // If another run replaces the saved run at this moment, waits for it.
    const FolderLock lock(folder, true);
    auto json = read_saved_manifest(folder);
    if (!json) return tl::unexpected(json.error());
    try {
        if (auto same = check_against_script(folder, *json, script, simulation); !same) return same;
        const auto& stages = json->at("stages");
        if (!stages.is_array()) return tl::unexpected(damaged(folder, "its stages are not a list"));
        if (stages.size() > script.program->stages.size()) {
            return tl::unexpected(damaged(folder, "it has more stages than its script"));
        }
        for (std::uint32_t k = 0; k < stages.size(); ++k) {
            if (stages[k].at("name") != script.program->stages[k].name ||
                !stages[k].at("steps").is_number_integer()) {
                return tl::unexpected(damaged(folder, fmt::format("stage {} is not right", k + 1)));
            }
            if (auto started = simulation.start_stage(k, cancel); !started) return started;
            auto record = read_stage(folder, *json, stages[k], simulation, k);
            if (!record) return tl::unexpected(damaged(folder, record.error().message));
            // With --steps, the saved run may have taken more steps than --steps now allows.
            const std::int64_t iterations = script.program->stages[k].iterations;
            if (!script.overrides.steps && record->steps > iterations) {
                return tl::unexpected(
                    damaged(folder, fmt::format("stage {} has too many steps", k + 1)));
            }
            // A stage may take more steps than before only if no later stage has begun with its
            // final state.
            const bool is_last = k + 1 == stages.size();
            record->done =
                record->done && (!is_last || record->condition_met || record->steps >= iterations);
            restore(simulation, k, *std::move(record));
        }
    } catch (const nlohmann::json::exception&) {
        return tl::unexpected(damaged(folder, "run.json is incomplete or malformed"));
    }
    return {};
}

}  // namespace cascade
