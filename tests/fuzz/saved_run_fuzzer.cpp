// A fuzzer of the texts in pictures and saved runs, and of the texts of options. The first byte
// chooses the reader. A manifest is read from a folder with the arrays of a small run. The run that
// it describes is restored, but no step is taken.
#include "core/check.h"
#include "run/commands/run.h"
#include "run/commands/variation.h"
#include "run/script/embedded_script.h"
#include "run/script/picture_request.h"
#include "run/stage/kept_tilings.h"
#include "tests/fuzz/seeds.h"

#include <cstddef>
#include <cstdint>

namespace cascade {

namespace {

constexpr char readers = 6;
constexpr std::uint64_t most_memory = std::uint64_t{16} << 20;

const char* const small_script =
    "domain { grid: 4, 3 }\n"
    "system s { u: x; k: 0.1 + y; u' = k * lap(u) }\n"
    "stage a: s { iterations: 3 }\nstage b: s { u: u; iterations: 5; until: steady(0.1) }\n";

template <typename T>
bool has_reason(const Result<T>& result) {
    return result || !result.error().message.empty();
}

SimulationOptions small_options() {
    SimulationOptions options;
    options.backend = "interp";
    options.threads = 1;
    options.memory_limit = most_memory;
    return options;
}

/// A folder with a run that stopped in its second stage.
class SavedRun {
public:
    SavedRun() {
        Script script = load_script("small.cascade", small_script, folder_.path());
        auto simulation = Simulation::create(script, small_options()).value();
        RunControl control;
        for (std::uint32_t stage = 0; stage < 2; ++stage) {
            CHECK(simulation->start_stage(stage), "the small script runs");
            CHECK(simulation->advance_stage(stage, 3, control, {}), "the small script runs");
        }
        CHECK(save_run(folder_.path(), script, *simulation), "the small run is saved");
    }

    std::string manifest() const {
        std::ifstream file(folder_.path() / "run.json");
        return {std::istreambuf_iterator<char>(file), {}};
    }

    void resume(std::string_view manifest) {
        fuzz::write_bytes(folder_.path() / "run.json", manifest);
        auto script = load_saved_script(folder_.path(), {});
        CHECK(has_reason(script), "a saved run that is refused has a message");
        if (!script || !script->program) return;
        script->messages(false);
        const Grid& grid = script->program->domain.grid;
        const bool is_small = grid.width < 256 && grid.height < 256 && grid.depth < 16;
        if (script->program->stages.empty() || !is_small || script->program->domain.model) return;
        auto simulation = Simulation::create(*script, small_options());
        if (!simulation) return;
        const auto restored = restore_run(folder_.path(), *script, **simulation);
        CHECK(has_reason(restored), "a saved run that is refused has a message");
    }

private:
    fuzz::ScratchFolder folder_;
};

SavedRun& saved_run() {
    static SavedRun run;
    return run;
}

void read(char reader, const std::string& text) {
    switch (reader) {
        case 0: return saved_run().resume(text);
        case 1: {
            const auto overrides = overrides_from_json(text);
            CHECK(has_reason(overrides), "changes that are refused have a message");
            // Overrides that are written and read again must be the same.
            if (overrides) {
                const std::string written = overrides_to_json(*overrides);
                CHECK(overrides_to_json(overrides_from_json(written).value()) == written,
                      "changes are written as they are read");
            }
            return;
        }
        case 2: {
            const auto request = picture_request_from_json(text);
            CHECK(has_reason(request), "a request that is refused has a message");
            if (request)
                CHECK(picture_request_from_json(to_json(*request)), "a request can be read back");
            return;
        }
        case 3: {
            const auto variation = parse_variation(text);
            CHECK(has_reason(variation), "a variation that is refused has a message");
            if (variation) {
                CHECK(parse_variation(text_of(*variation)), "a variation can be read back");
                const auto runs = count_runs({&*variation, 1});
                if (runs)
                    overrides_of_run({}, {&*variation, 1}, values_of_run({&*variation, 1}, 0));
            }
            return;
        }
        case 4:
            if (const auto found = found_tiling_of(text)) found_tiling_of(text_of(*found));
            return;
        default: {
            Overrides overrides;
            overrides.sets = {text};
            const Script script = load_script("small.cascade", small_script, "/nowhere", overrides);
            CHECK(script.program || script.diagnostics.has_errors(),
                  "what is refused has a message");
            script.messages(true);
        }
    }
}

std::vector<fuzz::Seed> seeds() {
    PictureRequest request;
    request.show = "u + 1";
    request.range = ValueRange{0, 8};
    Overrides overrides;
    overrides.sets = {"a.k=1/200", "u.left=fixed(1)"};
    overrides.seed = 7;
    return {
        {"manifest", 0, saved_run().manifest()},
        {"overrides", 1, overrides_to_json(overrides)},
        {"no_overrides", 1, overrides_to_json({})},
        {"request", 2, to_json(request)},
        {"range", 3, "gray_scott.feed=0.02..0.06:9"},
        {"list", 3, "seed=1,2,3"},
        {"tiling", 4, "8 4 1 1 0 0 1"},
        {"set", 5, "a.k=0.3"},
        {"set_side", 5, "u.left=fixed(sin(t))"},
    };
}

}  // namespace

}  // namespace cascade

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    cascade::fuzz::write_seeds(*count, *arguments, cascade::seeds());
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return -1;
    cascade::read(static_cast<char>(data[0] % cascade::readers),
                  std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    return 0;
}
