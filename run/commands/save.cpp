// Saved runs: a folder with STAGE.NAME.npy for every field, and run.json for everything else.

#include "core/file.h"
#include "core/version.h"
#include "picture/npy.h"
#include "run/commands/run.h"
#include "run/commands/saved_cells.h"
#include "run/commands/saved_folder.h"
#include "run/script/embedded_script.h"
#include "run/script/script_folder.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/saved_time.h"
#include "solvers/finite.h"
#include "tissue/tissue.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace cascade {

namespace {

std::string array_name(const Stage& stage, std::string_view item) {
    return fmt::format("{}.{}.npy", stage.name, item);
}

/// `cells` has, by stage, what is saved of its cells besides arrays, or null.
nlohmann::json manifest(const Script& script, const Simulation& simulation,
                        const std::vector<nlohmann::json>& cells) {
    nlohmann::json stages = nlohmann::json::array();
    for (std::uint32_t k = 0; k < script.program->stages.size(); ++k) {
        const StageState& state = simulation.state(k);
        if (!state.started) break;
        stages.push_back({{"name", script.program->stages[k].name},
                          {"steps", state.steps},
                          {"done", state.done},
                          {"condition_met", state.condition_met},
                          {"time", to_json(state)}});
        if (!cells[k].is_null()) stages.back()["cells"] = cells[k];
    }
    return {
        {"cascade", version()},
        {"name", portable_path(script.name)},
        {"script", script.text},
        {"overrides", nlohmann::json::parse(overrides_to_json(script.overrides))},
        {"grid", {simulation.grid().width, simulation.grid().height, simulation.grid().depth}},
        {"seed", script.program->domain.seed},
        {"stages", stages},
    };
}

Failure damaged(const std::filesystem::path& folder, const std::string& why) {
    return {fmt::format("the saved run in {} is damaged: {}", folder.string(), why), ""};
}

/// Suffix of species as they were at the last test of `until: steady(…)`.
constexpr std::string_view last_look = ".last";

/// The values of an item of a stage, or of another array of the same shape.
Result<Field> read_item(const std::filesystem::path& folder, const nlohmann::json& manifest,
                        const Simulation& simulation, std::uint32_t stage, std::string_view item) {
    const Program& program = simulation.program();
    const auto model = simulation.model();
    const Grid grid =
        model ? Grid{static_cast<std::int64_t>(model->count()), 1} : simulation.grid(stage);
    const std::string name = array_name(program.stages[stage], item);
    const auto file = read_saved_file(folder, manifest, name);
    if (!file) return tl::unexpected(damaged(folder, file.error().message));
    const auto array = parse_npy(*file, program.domain.precision);
    if (!array) {
        return tl::unexpected(
            damaged(folder, fmt::format("cannot read '{}': {}", name, array.error().message)));
    }
    if (!fits(*array, grid)) {
        return tl::unexpected(damaged(folder, fmt::format("{} has another shape", name)));
    }
    Field field = to_field(*array, program.domain.precision);
    if (model) field = in_rows(field, *model);
    // Outside of the mask, files hold NaN but runs 0.
    if (simulation.mask()) field = with_outside(field, *simulation.mask(), 0);
    return field;
}

Result<std::vector<Field>> read_species(const std::filesystem::path& folder,
                                        const nlohmann::json& manifest,
                                        const Simulation& simulation, std::uint32_t stage,
                                        std::string_view suffix = "") {
    std::vector<Field> species;
    const Program& program = simulation.program();
    const System& system = program.system_of(stage);
    for (const ItemId item : system.species()) {
        const std::string name = fmt::format("{}{}", system.item_name(item), suffix);
        auto field = read_item(folder, manifest, simulation, stage, name);
        if (!field) return tl::unexpected(field.error());
        if (first_not_finite(*field)) {
            return tl::unexpected(
                damaged(folder, fmt::format("{} has a value that is not finite",
                                            array_name(program.stages[stage], name))));
        }
        species.push_back(std::move(*field));
    }
    return species;
}

/// True if the stage's item has a plane to be saved.
bool is_saved(const Program& program, std::uint32_t stage, ItemId item) {
    return program.system_of(stage).is_species(item) || !program.stages[stage].uniform[item];
}

}  // namespace

Result<void> check_savable(const std::filesystem::path& folder, const Script& script) {
    const Program& program = *script.program;
    std::vector<std::string> names;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        const System& system = program.system_of(k);
        if (system.cells) {
            std::ranges::move(cell_arrays(program, k), std::back_inserter(names));
            continue;
        }
        for (const ItemId item : system.items()) {
            const std::string_view name = system.item_name(item);
            if (is_saved(program, k, item)) names.push_back(array_name(program.stages[k], name));
            if (!program.stages[k].time.steady || !system.is_species(item)) continue;
            names.push_back(array_name(program.stages[k], fmt::format("{}{}", name, last_look)));
        }
    }
    return check_savable(folder, names);
}

Result<std::vector<std::filesystem::path>> save_run(const std::filesystem::path& folder,
                                                    const Script& script,
                                                    const Simulation& simulation) {
    if (auto made = make_folder(folder); !made) return tl::unexpected(made.error());
    auto change = SavedFolderChange::begin(folder);
    if (!change) return tl::unexpected(change.error());
    const Program& program = *script.program;
    const auto write = [&](const std::string& name, const Field& field) {
        const DomainMask* mask = simulation.mask();
        if (mask)
            return (*change)->add(name, encode_npy(with_outside(field, *mask, nothing_outside)));
        if (simulation.model())
            return (*change)->add(name, encode_npy(in_one_row(field, *simulation.model())));
        return (*change)->add(name, encode_npy(field));
    };
    std::vector<nlohmann::json> cells(program.stages.size());
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (!simulation.state(k).started) break;
        const Stage& stage = program.stages[k];
        const System& system = program.system_of(k);
        if (system.cells) {
            auto saved = save_cells(**change, simulation, k);
            if (!saved) return tl::unexpected(saved.error());
            cells[k] = std::move(*saved);
            continue;
        }
        for (const ItemId item : system.items()) {
            if (!is_saved(program, k, item)) continue;
            auto done =
                write(array_name(stage, system.item_name(item)), simulation.state(k).field(item));
            if (!done) return tl::unexpected(done.error());
        }
        const std::span<const Field> looked_at = simulation.state(k).watch.last();
        for (std::size_t species = 0; species < looked_at.size(); ++species) {
            auto done = write(array_name(stage, fmt::format("{}{}", species_name(system, species),
                                                            last_look)),
                              looked_at[species]);
            if (!done) return tl::unexpected(done.error());
        }
    }
    return (*change)->commit(manifest(script, simulation, cells));
}

namespace {

/// The user may name a new place for the model of a saved run, but not another model.
Result<void> take_model(Overrides& saved, const Overrides& changes) {
    if (!changes.model) return {};
    const auto name = [](const std::string& path) {
        return std::filesystem::path(path).filename();
    };
    if (!saved.model || name(*saved.model) != name(*changes.model)) {
        return failure("a resumed run keeps its model", "--mesh can only give its new place");
    }
    saved.model = changes.model;
    saved.model_is_asked_for = changes.model_is_asked_for;
    return {};
}

/// Checks that what run.json repeats of the script agrees with it.
Result<void> check_against_script(const std::filesystem::path& folder, const nlohmann::json& json,
                                  const Script& script, const Simulation& simulation) {
    const Grid& grid = simulation.grid();
    if (json.at("grid") != nlohmann::json{grid.width, grid.height, grid.depth}) {
        return tl::unexpected(damaged(folder, "its grid is not that of its script"));
    }
    if (json.at("seed") != script.program->domain.seed) {
        return tl::unexpected(damaged(folder, "its seed is not that of its script"));
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
            "a resumed run keeps its grid, seed, precision, rounding, parameters and solver",
            "--steps, --until-stage and --allow-read can change, and --mesh where the "
            "same model lies elsewhere now");
    }
    try {
        auto overrides = overrides_from_json(json->at("overrides").dump());
        if (!overrides) return tl::unexpected(damaged(folder, overrides.error().message));
        // The steps of the saved run would stop the resumed one, too.
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
    // A run in progress may be replacing this one.
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
            const auto steps = stages[k].at("steps").get<std::int64_t>();
            bool done = stages[k].at("done").get<bool>();
            const bool condition_met = stages[k].value("condition_met", done);
            // More steps may be requested than before, but not in a stage whose end a later one has
            // used.
            const bool is_last = k + 1 == stages.size();
            done = done &&
                   (!is_last || condition_met || steps >= script.program->stages[k].iterations);
            if (steps < 0) return tl::unexpected(damaged(folder, "a number of steps is negative"));
            // With --steps, the saved run may have taken more steps than are allowed now.
            if (!script.overrides.steps && steps > script.program->stages[k].iterations) {
                return tl::unexpected(
                    damaged(folder, fmt::format("stage {} has too many steps", k + 1)));
            }
            if (auto started = simulation.start_stage(k, cancel); !started) return started;
            if (script.program->system_of(k).cells) {
                auto cells = read_cells(folder, *json, stages[k].at("cells"), simulation, k);
                if (!cells) return tl::unexpected(damaged(folder, cells.error().message));
                simulation.restore_cells(k, *cells, {{}, steps, 0, done, condition_met, {}});
                continue;
            }
            auto species = read_species(folder, *json, simulation, k);
            if (!species) return tl::unexpected(species.error());
            StageMoment moment{std::move(*species), steps, 0, done, condition_met, {}};
            const auto time =
                saved_time_from(stages[k].at("time"), script.program->stages[k].time.solver);
            if (!time) return tl::unexpected(damaged(folder, "its time makes no sense"));
            SteadyWatch watch;
            if (time->last_look) {
                auto looked_at = read_species(folder, *json, simulation, k, last_look);
                if (!looked_at) return tl::unexpected(looked_at.error());
                if (time->formations.size() != looked_at->size()) {
                    return tl::unexpected(damaged(folder, "it lacks the course of a species"));
                }
                watch.remember(std::move(*looked_at), *time->last_look, time->formations);
            }
            moment.t = time->t;
            moment.memory = {time->state, std::move(watch)};
            simulation.restore(k, std::move(moment));
            // Most are as the start of the stage gives them; some may have been painted.
            const System& system = script.program->system_of(k);
            for (const ItemId item : system.items()) {
                if (system.is_species(item) || !is_saved(*script.program, k, item)) continue;
                auto field = read_item(folder, *json, simulation, k, system.item_name(item));
                if (!field) return tl::unexpected(field.error());
                simulation.set_field(k, item, std::move(*field));
            }
        }
    } catch (const nlohmann::json::exception&) {
        return tl::unexpected(damaged(folder, "run.json is incomplete or malformed"));
    }
    return {};
}

}  // namespace cascade
