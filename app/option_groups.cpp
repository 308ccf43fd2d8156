// Each function adds a group of options to a command. tests/help_test.sh checks the help texts.
#include "app/option_groups.h"

#include "app/add_value.h"
#include "app/help.h"
#include "app/wgsl_dump.h"
#include "core/file_format.h"
#include "run/commands/dump.h"
#include "run/simulation/simulation.h"
#include "run/stage/kernel_cache.h"

#include <filesystem>
#include <limits>
#include <vector>

namespace cascade::option_groups {

void add_script(CLI::App& app, Options& options, const std::string& help) {
    app.add_option_function<std::string>(
           "SCRIPT", [&](const std::string& path) { options.scripts.push_back(path); }, help)
        ->type_name("");
}

void add_simulation(CLI::App& app, Options& options, const std::string& threads) {
    const std::string group = execution_group;
    SimulationOptions& simulation = options.run.simulation;
    simulation.kernel_cache = usual_kernel_cache();
    simulation.starts_interpreted = true;
    std::vector<std::string_view> names, meanings;
    for (const BackendKind& each : backends()) {
        names.push_back(each.name);
        meanings.push_back(each.meaning);
    }
    add_value(app, "--backend", fmt::format("{}", fmt::join(names, "|")),
              fmt::format("{}", fmt::join(meanings, ", or ")), one_of(available_backends()),
              [&](const auto& name) { simulation.backend = backend_named(name).name; })
        ->group(group);
    add_value(app, "--threads", "N", threads, whole_number(1, 1024), [&](auto count) {
        simulation.threads = static_cast<int>(count);
    })->group(group);
    add_value(app, "--lanes", "4|8|16", "Cells in a vector; by default the processor's width",
              one_of({"4", "8", "16"}),
              [&](const auto& lanes) {
                  simulation.lanes = lanes == "4" ? 4 : lanes == "8" ? 8 : 16;
              })
        ->group(group);
    // This option is for tests and fuzzers, so --help does not show it.
    add_value(app, "--tiling", "LEVELS,LAYER", "The order in which steps go through memory",
              parse_tiling, [&](const Tiling& tiling) { simulation.tiling = tiling; })
        ->group("");
    app.add_flag_callback(
           "--no-kernel-cache", [&simulation] { simulation.kernel_cache.clear(); },
           "Compile all native code again, and do not keep it")
        ->group(group);
}

void add_mesh(CLI::App& app, Options& options) {
    app.add_option("MODELS", options.models, "Files: .ply, .obj, .off, .stl, .gltf, .glb")
        ->type_name("");
    add_allow_read(
        app, options.overrides.reads,
        "Buffers of glTF files may lie below this folder too, not\nonly below the model's; "
        "'all': everywhere; may be given\nagain");
    add_value(app, "--subdivide", "N",
              "Divide each triangle into four, N times, on a smooth\nsurface", whole_number(1, 8),
              [&](auto times) { options.reshaping.subdivide = static_cast<int>(times); });
    add_value(app, "--simplify", "N", "Keep about N triangles, where the shape needs them most",
              whole_number(1, std::numeric_limits<std::int32_t>::max()),
              [&](auto count) { options.reshaping.simplify = static_cast<std::size_t>(count); });
    app.add_flag("--unwrap", options.mesh_files.unwrap,
                 "Make texture coordinates: charts of little distortion,\npacked into one texture");
    app.add_flag("--points", options.lists_points,
                 "Print positions for scripts: extremes along the axes, and tips\n"
                 "such as the ends of legs and ears");
    add_value(app, "-o,--output", "FILE",
              "The repaired model: " + endings_of(FormatKind::model, "or"),
              path_of(FormatKind::model), [&](auto path) { options.mesh_output = path; });
    add_value(app, "--cells", "N|faces|vertices",
              "Spread N cells over the surface, or make cells of the\n"
              "model's faces or points, and describe them",
              parse_cells, [&](const CellOptions& cells) { options.cells = cells; })
        ->group("Cells");
    add_value(app, "--seed", "N", "The seed of the cells' random positions (with --cells N)",
              whole_number(0, 4294967295),
              [&](auto seed) { options.cell_seed = static_cast<std::uint32_t>(seed); })
        ->group("Cells");
}

void add_timing(CLI::App& app, Options& options) {
    app.add_flag("--timing", options.timing, "Print a table of where the time went")
        ->group(execution_group);
}

void add_ranks(CLI::App& app, Options& options, std::string_view work) {
    add_value(app, "--ranks", "N",
              fmt::format("Share the {} among N processes, which mpiexec starts", work),
              whole_number(1, 100000), [&](auto ranks) { options.ranks = static_cast<int>(ranks); })
        ->group(execution_group);
    add_value(app, "--mpi", "openmpi|mpich",
              "The MPI library of the ranks; by default the one whose\nmpiexec has started them",
              one_of({"openmpi", "mpich"}),
              [&](const std::string& name) { options.mpi = mpi_library_named(name); })
        ->group(execution_group);
}

void add_device(CLI::App& app, Options& options) {
    add_value(
        app, "--device", "gpu|N|list",
        "Take steps on a device by OpenCL: the first graphics\nprocessor, or number N of 'list'",
        parse_device, [&](auto device) { options.device = device; })
        ->excludes("--ranks")
        ->group(execution_group);
}

void add_limits(CLI::App& app, Options& options) {
    const std::string group = "Limits";
    add_value(app, "--limit-time", "DURATION", "Stop after 90s, 20m, 1.5h as Ctrl-C would",
              parse_duration, [&](double seconds) { options.limit_seconds = seconds; })
        ->group(group);
    add_value(app, "--limit-memory", "SIZE", "Use at most 500MB, 2GB; refuse runs that need more",
              parse_size, [&](std::uint64_t bytes) { options.run.simulation.memory_limit = bytes; })
        ->group(group);
}

void add_quiet(CLI::App& app, Options& options) {
    app.add_flag("-q,--quiet", options.quiet, "Print no progress and no remarks")
        ->group(execution_group);
}

void add_dump(CLI::App& app, Options& options) {
    std::vector<std::string> kinds;
    for (const std::string_view kind : dump_kinds()) kinds.emplace_back(kind);
    kinds.emplace_back(wgsl_kind);
    add_value(app, "--dump", "WHAT",
              "Print one form of the script, and stop:\n" + help::in_lines(kinds), one_of(kinds),
              [&](auto kind) { options.dump = kind; })
        ->group("More");
}

void add_json(CLI::App& app, Options& options) {
    app.add_flag("--json", options.json,
                 "All output, messages too, as one JSON object on standard\noutput")
        ->group("More");
}

void add_compile(CLI::App& app, Options& options) {
    const std::string group = "Output";
    CompileRequest& compile = options.compile;
    add_value(app, "-o,--output", "FILE.o", "The object file; by default SCRIPT.o in this folder",
              any_text, [&](auto path) { options.object = path; })
        ->group(group);
    add_value(app, "--header", "FILE.h", "The C header; by default beside the object file",
              any_text, [&](auto path) { options.header = path; })
        ->group(group);
    add_value(app, "--stage", "STAGE", "Name or number of the stage; by default the first",
              any_text, [&](auto stage) { compile.stage = stage; })
        ->group(group);
    add_value(app, "--per-cell", "NAMES", "Parameters that get a value for each cell: beta,ka",
              parse_names, [&](auto names) { compile.per_cell = names; })
        ->group(group);
    add_value(app, "--target", "CPU", "A processor such as x86-64-v3; by default this one",
              any_text, [&](auto target) { compile.target = target; })
        ->group(group);
    add_value(app, "--stages", "N", "Stages of each step of rkl1 and rkl2: odd, 3 to 99",
              odd_number(3, most_compiled_stages),
              [&](auto stages) { compile.stages = static_cast<std::uint32_t>(stages); })
        ->group(group);
    add_value(app, "--name", "NAME", "The C functions' name; by default SCRIPT_STAGE", any_text,
              [&](auto name) { compile.function_name = name; })
        ->group(group);
}

void add_export(CLI::App& app, Options& options) {
    add_value(app, "--html", "FILE.html", "The page; by default SCRIPT.html in this folder",
              any_text, [&](auto path) { options.html = path; })
        ->group("Output");
    app.add_flag(
           "--exact", options.exact,
           "Give the bits of 'cascade run' for numbers below 1.2e-38,\ntoo; steps take 8 times "
           "as long")
        ->group("Output");
}

}  // namespace cascade::option_groups
