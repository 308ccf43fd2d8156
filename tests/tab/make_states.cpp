// Runs the scripts of tests/tab_agreement_test.sh natively. Writes the data with which a page can
// run the scripts, and the bits that the page must get.
//
//   tab_states kept|exact FILE
//
// `kept` keeps denormal numbers, as browsers do. `exact` flushes denormal numbers, as the program
// and exact pages do.
#include "core/base64.h"
#include "core/check.h"
#include "core/floating_point.h"
#include "lang/library/library.h"
#include "lang/program/nodes_of_rates.h"
#include "lang/print/library_note.h"
#include "run/session/turns.h"
#include "tests/agreement/random_scripts.h"
#include "view/carried.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

namespace cascade::test {
namespace {

using Json = nlohmann::json;

constexpr std::int64_t most_steps = 40;

/// FNV-1a over the words of all cells, as in tests/tab/run_states.mjs.
std::uint32_t hash_of(const Field& field) {
    std::uint32_t hash = 0x811c9dc5;
    const PlaneLayout& layout = field.layout();
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t column = 0; column < layout.width; ++column) {
            const float value = field.row(row)[column];
            const auto word = std::isnan(value) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(value);
            hash = (hash ^ word) * 0x01000193;
        }
    }
    return hash;
}

/// The script with its data for a page, and hashes of the species after the run. Null if the run
/// fails, as for some random scripts.
Json state_of(Script script) {
    SimulationOptions options;
    options.threads = 1;
    // The interpreter runs the scripts, since native code relies on flushed denormal numbers.
    options.backend = "interp";
    RunControl control;
    auto run = LiveRun::begin(std::move(script), options, control);
    if (!run) return nullptr;
    const auto carried = carried_by((*run)->script(), (*run)->simulation());
    CHECK(carried, "test: the files of a script can be read");
    Json files = Json::array();
    for (const auto& [name, bytes] : carried->files) files.push_back({name, base64(bytes)});
    if (!(*run)->advance(std::int64_t{1} << 40, control)) return nullptr;
    const Program& program = *(*run)->script().program;
    const auto last = static_cast<std::uint32_t>(program.stages.size() - 1);
    Turns turns(std::move(*run));
    Json species = Json::array();
    for (const ItemId item : program.system_of(last).items()) {
        if (!program.system_of(last).is_species(item)) continue;
        const std::string name(program.system_of(last).item_name(item));
        if (!turns.obey(Show{name})) continue;
        const auto snapshot = turns.snapshot();
        species.push_back({name, hash_of(snapshot->fields[0])});
    }
    return {{"name", carried->name}, {"text", carried->text}, {"overrides", carried->overrides},
            {"files", files},        {"species", species},    {"steps", turns.run().place().steps}};
}

void write_states(const std::filesystem::path& path, bool is_exact) {
    Json all = Json::array();
    const auto add = [&](Script script) {
        CHECK(script.program, "test: the script is right");
        const std::vector<Stage>& stages = script.program->stages;
        // A page cannot compute the surface of a grown body.
        const auto has_body = [](const Stage& stage) { return !stage.body.nodes.empty(); };
        if (stages.empty() || std::any_of(stages.begin(), stages.end(), has_body)) return;
        // The transforms of pages, and angles on models, agree with those of the program to
        // rounding only (spec/page.md).
        const auto is_rounded = [&](const Node& node) {
            const auto* const value = node.as<SurfaceValueId>();
            const Literals& literals = *script.program->literals;
            return is_nonlocal(node) ||
                   (value != nullptr && literals.surface_value(*value).function == Function::along);
        };
        for (const Stage& stage : stages) {
            const System& system = script.program->systems[stage.system];
            const bool is_in_items =
                std::any_of(stage.items.begin(), stage.items.end(),
                            [&](const Formula& item) { return holds_in(item, is_rounded); });
            const bool is_transformed = is_semi_implicit(stage.time.solver);
            if (is_transformed || is_in_items || holds_in_rates(system, is_rounded)) return;
        }
        auto state = state_of(std::move(script));
        if (state.is_null()) return;
        state["is_exact"] = is_exact;
        all.push_back(std::move(state));
    };
    Overrides overrides;
    overrides.steps = most_steps;
    for (const LibraryText& text : library_texts()) {
        add(load_script(std::string(text.file_name), starting_script(text), ".", overrides));
    }
    std::set<std::filesystem::path> examples;
    const auto folder = std::filesystem::path(CASCADE_SOURCE_DIR) / "examples";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".cascade") examples.insert(entry.path());
    }
    for (const auto& example : examples) {
        auto loaded = load_script_file(example, overrides);
        CHECK(loaded, "test: examples can be read");
        if (loaded->script.program) add(std::move(loaded->script));
    }
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        add(load_script(fmt::format("random script {}", seed), random_script(seed), folder,
                        overrides));
    }
    std::ofstream(path) << all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace
}  // namespace cascade::test

int main(int argc, char** argv) {
    CHECK(argc == 3, "test: tab_states kept|exact FILE");
    const bool is_exact = std::string(argv[1]) == "exact";
    if (!is_exact) cascade::keep_denormals();
    cascade::test::write_states(argv[2], is_exact);
}
