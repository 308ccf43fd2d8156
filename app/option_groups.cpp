// Each function adds one group of options to a command; tests/help_test.sh checks the help texts.
#include "app/option_groups.h"

#include "app/add_value.h"
#include "app/help.h"
#include "core/file_format.h"
#include "core/palette.h"
#include "lang/program/models.h"
#include "lang/program/program.h"
#include "run/commands/dump.h"
#include "run/simulation/simulation.h"
#include "run/stage/kernel_cache.h"

#include <filesystem>
#include <limits>
#include <vector>

namespace cascade::option_groups {

namespace {

std::vector<std::string> palette_names() {
    std::vector<std::string> names;
    for (const Palette& palette : palettes()) names.emplace_back(palette.name);
    return names;
}

constexpr const char* picture_group = "What the picture shows";
constexpr const char* execution_group =
    "How it is computed (the results are the same, bit for bit)";

}  // namespace

void add_script(CLI::App& app, Options& options, const std::string& help) {
    app.add_option_function<std::string>(
           "SCRIPT", [&](const std::string& path) { options.scripts.push_back(path); }, help)
        ->type_name("");
}

void add_allow_read(CLI::App& app, ReadAccess& reads, const std::string& about) {
    app.add_option_function<std::vector<std::string>>(
           "--allow-read",
           [&](const std::vector<std::string>& folders) {
               for (const std::string& folder : folders) {
                   if (folder == "all") reads.everything = true;
                   else reads.folders.emplace_back(folder);
               }
           },
           about)
        ->allow_extra_args(false)
        ->trigger_on_parse()
        ->type_name("FOLDER|all")
        ->group("Limits");
}

void add_overrides(CLI::App& app, Overrides& overrides) {
    const std::string group = "Changes to the script, without editing it";
    add_value(
        app, "--grid", "WxH", "Columns and rows; '60' is a line of cells, '64x64x32'\nhas slices",
        [&](const std::string& text) {
            overrides.grid_is_one_number = text.find('x') == std::string::npos;
            return parse_grid(text);
        },
        [&](auto grid) { overrides.grid = grid; })
        ->group(group);
    add_value(app, "--mesh", "MODEL",
              "Grow on this model: a file (PLY, OBJ, OFF, STL,\nglTF, GLB), sphere, torus, box, "
              "knot, creature,\nleopard, giraffe, zebra, fish or frog",
              any_text,
              [&](const std::string& model) {
                  overrides.model = model;
                  overrides.model_is_asked_for = true;
              })
        ->group(group);
    add_value(app, "--cells", "N", "Cells on the model: a number, 'faces' or 'vertices'", any_text,
              [&](const std::string& cells) { overrides.cells = cells; })
        ->group(group);
    add_value(app, "--up", "x|y|z", "Which axis of the model points upwards; without it y",
              one_of({"x", "y", "z"}),
              [&](const std::string& up) { overrides.up = axis_of_name(up); })
        ->group(group);
    add_value(app, "--facing", "AXIS",
              "Along which axis of the model it looks, such as -y; pictures\nshow its face",
              one_of({heading_names.begin(), heading_names.end()}),
              [&](const std::string& facing) { overrides.facing = heading_of_name(facing); })
        ->group(group);
    add_value(app, "--seed", "N", "The seed of all random numbers",
              whole_number(0, std::numeric_limits<std::uint32_t>::max()),
              [&](auto seed) { overrides.seed = static_cast<std::uint32_t>(seed); })
        ->group(group);
    add_value(app, "--precision", "NAME", "Numbers of 32 bits, 'single', or of 64, 'double'",
              one_of({"single", "double"}),
              [&](const std::string& name) { overrides.precision = precision_of_name(name); })
        ->group(group);
    app.add_flag(
           "--fast", overrides.fast,
           "Steps with fewer roundings: a * b + c in one operation;\nother bits than without it")
        ->group(group);
    app.add_option("--set", overrides.sets,
                   "A parameter or setting: ka=1/400, large.ka=1/400;\nmay be given again")
        ->allow_extra_args(false)
        ->type_name("NAME=EXPR")
        ->group(group);
    // Accepted here as in scripts, though no longer listed (solver_of()).
    std::vector<std::string> solvers = solver_names();
    solvers.emplace_back("imex2");
    add_value(app, "--solver", "NAME",
              help::in_lines(solver_names()) +
                  "\nfor every stage, which takes as much time as before",
              one_of(std::move(solvers)), [&](auto solver) { overrides.solver = solver; })
        ->group(group);
    add_value(app, "--steps", "N", "At most N steps in every stage",
              whole_number(0, std::numeric_limits<std::int64_t>::max()),
              [&](auto steps) { overrides.steps = steps; })
        ->group(group);
    add_value(app, "--until-stage", "NAME", "The last stage that runs", any_text, [&](auto stage) {
        overrides.until_stage = stage;
    })->group(group);
    add_allow_read(
        app, overrides.reads,
        "The script may read files below this folder too, not\nonly below its own; 'all': "
        "everywhere; may be given\nagain");
}

void add_shown(CLI::App& app, PictureChanges& picture) {
    const std::string group = picture_group;
    add_value(app, "--show", "EXPR",
              "A species, a parameter, any expression: b, stage1.b,\n"
              "'a - b'",
              any_text, [&](auto show) { picture.show = show; })
        ->group(group);
    const auto palette =
        [known = one_of(palette_names())](const std::string& text) -> Result<std::string> {
        if (const Palette* const found = find_palette(text)) return std::string(found->name);
        return known(text);
    };
    add_value(app, "--palette", "NAME", help::in_lines(palette_names()), palette, [&](auto name) {
        picture.palette = name;
    })->group(group);
    add_value(app, "--range", "LOW,HIGH",
              "The values at the palette's two ends; without it the\n"
              "smallest and the largest",
              parse_range, [&](auto range) { picture.range = range; })
        ->group(group);
    add_value(app, "--depth", "BITS", "8 or 16 for each colour", one_of({"8", "16"}),
              [&](const auto& depth) { picture.depth = depth == "16" ? 16 : 8; })
        ->group(group);
    add_value(app, "--slice", "AXIS=PLACE",
              "On a grid with slices: z=0.5, or another place from 0\n"
              "to 1 along x, y or z",
              parse_slice, [&](auto slice) { picture.slice = slice; })
        ->group(group);
}

void add_picture_options(CLI::App& app, PictureChanges& picture) {
    add_shown(app, picture);
    const std::string group = picture_group;
    add_value(app, "--scale", "N", "Pixels for the side of a cell (1 to 64)", whole_number(1, 64),
              [&](auto scale) { picture.scale = static_cast<int>(scale); })
        ->group(group);
    add_value(
        app, "--detail", "N",
        "Carry the end to N x N cells in place of each, in the same\ndomain, and let it settle "
        "there (1 to 8)",
        whole_number(1, most_detail),
        [&](auto detail) { picture.detail = static_cast<int>(detail); })
        ->group(group);
    app.add_flag("--flat", picture.flat, "On a surface: the texture alone, without the surface")
        ->group(group);
    add_value(app, "--view", "AROUND,ABOVE",
              "On a surface: the direction of view, in degrees around\nit and above the horizon",
              parse_view, [&](auto view) { picture.view = view; })
        ->group(group);
    add_value(app, "--size", "WxH",
              "Pixels across and down. A plane becomes a smooth picture,\nas large as fits in; "
              "surfaces are 800x600 without it",
              parse_picture_size, [&](auto size) { picture.size = size; })
        ->group(group);
    add_value(app, "--copies", "NxM",
              "Copies of a periodic plane side by side, such as 2x2, with\nno seam between them",
              parse_copies, [&](auto copies) { picture.copies = copies; })
        ->group(group);
    add_value(app, "--quality", "Q", "On a surface: draft, normal or fine, for less or more time",
              one_of({quality_names.begin(), quality_names.end()}),
              [&](const auto& quality) { picture.quality = quality_named(quality); })
        ->group(group);
    add_value(app, "--light", "WHICH", "On a surface: sun, studio (three lights) or outdoors",
              one_of({lighting_names.begin(), lighting_names.end()}),
              [&](const auto& light) { picture.lighting = lighting_named(light); })
        ->group(group);
    add_value(app, "--fov", "DEGREES",
              "On a surface: the field of view, from 1 (far away) to\n120 (near); without it 25",
              parse_fov, [&](float fov) { picture.fov = fov; })
        ->group(group);
    add_value(app, "--ground", "YES", "On a surface: yes or no, a ground that receives shadows",
              one_of({"yes", "no"}), [&](const auto& word) { picture.ground = word == "yes"; })
        ->group(group);
    add_value(
        app, "--background", "WHAT",
        "On a surface: none, for transparent pixels, or a colour\nsuch as '#204060'; "
        "without it white",
        [](const std::string& name) { return background_named(name); },
        [&](const auto& background) { picture.background = background; })
        ->group(group);
    add_value(app, "--bump", "S",
              "On a model: raise the surface by the number shown, by up\n"
              "to S times the model's longest side, such as 0.02",
              parse_bump, [&](float bump) { picture.bump = bump; })
        ->group(group);
    app.add_flag(
           "--displace", picture.displace,
           "On a model: the heights of the picture block or of --bump\nmove the surface, in files, too")
        ->group(group);
    app.add_flag("--space-time", picture.space_time,
                 "A line of cells over time: a row of pixels for each\ninterval")
        ->group(group);
}

void add_film_pace(CLI::App& app, FilmRequest& film) {
    const std::string group = "Files";
    CLI::Option* const fps =
        add_value(app, "--fps", "N", "Frames of films in a second, 0.1 to 60; without it 10",
                  parse_frame_rate, [&](double rate) { film.frames_per_second = rate; })
            ->group(group);
    add_value(app, "--seconds", "S", "How long films last, instead of --fps", parse_film_length,
              [&](double seconds) { film.seconds = seconds; })
        ->excludes(fps)
        ->group(group);
}

void add_files(CLI::App& app, RunRequest& run) {
    const std::string group = "Files";
    app.add_option_function<std::vector<std::string>>(
           "-o,--output",
           [&](const std::vector<std::string>& paths) {
               for (const std::string& path : paths) {
                   run.outputs.emplace_back(value_or_throw(parse_output_path(path), "--output"));
               }
           },
           help::in_lines(fmt::format(
               "The picture, {}; without it SCRIPT.png in this folder; a figure, {}; a film, {}; of a "
               "model also {}, and its cells, {}; may be given again",
               endings_of(FormatKind::picture), endings_of(FormatKind::figure),
               endings_of(FormatKind::film), endings_of(FormatKind::model),
               endings_of(FormatKind::cells))))
        ->allow_extra_args(false)
        ->trigger_on_parse()
        ->type_name("FILE")
        ->group(group);
    add_value(app, "--sheet", "FILE.png", "All species of all stages in one labelled picture",
              path_of(FormatKind::picture), [&](auto path) { run.sheet = path; })
        ->group(group);
    add_value(app, "--frames", "FOLDER", "A picture at each interval, all in one range",
              parse_frames_folder, [&](auto path) { run.frames = path; })
        ->group(group);
    add_film_pace(app, run.film);
    app.add_option("--panel", run.panels,
                   "An expression: figures have a panel for each, with its own\ncolours; may be "
                   "given again")
        ->allow_extra_args(false)
        ->type_name("EXPR")
        ->group(group);
    app.add_option("--label", run.labels,
                   "In a corner of frames and films: 'stage', step, t, or\nanother number, 'mean(u "
                   "over domain)'; may be given again")
        ->allow_extra_args(false)
        ->type_name("WHAT")
        ->group(group);
    add_value(app, "--slices", "N", "Films of a volume show N slices along the axis of --slice",
              whole_number(1, 100000), [&](auto count) { run.slices = static_cast<int>(count); })
        ->group(group);
    add_value(app, "--volume", "FILE",
              "All species of the last stage: .vti for ParaView, .vdb\nfor Blender and renderers",
              path_of(FormatKind::volume), [&](auto path) { run.volume = path; })
        ->group(group);
    add_value(
        app, "--series", "FILE.pvd",
        "All species at each interval, for ParaView: the list of\nfiles in a folder beside it",
        path_of(FormatKind::series), [&](auto path) { run.series = path; })
        ->group(group);
    CLI::Option* const save =
        add_value(app, "--save", "FOLDER", "Every field as STAGE.NAME.npy, to read or to resume",
                  parse_folder, [&](auto path) { run.save = path; })
            ->group(group);
    add_value(app, "--checkpoint", "DURATION",
              "Also save every 30s, 10m, 2h during the run, so that a\nkilled run can be resumed",
              parse_duration, [&](double seconds) { run.checkpoint_seconds = seconds; })
        ->needs(save)
        ->group(group);
    add_value(app, "--turntable", "N",
              "Pictures from N places around, as NAME-001.png, …; a\nfilm turns once",
              whole_number(1, 9999), [&](auto count) { run.turntable = static_cast<int>(count); })
        ->group(group);
    app.add_flag("--retile", run.model_files.retile,
                 "Models as triangles between their cells, instead of\ntheir own triangles refined")
        ->group(group);
    app.add_flag("--unwrap", run.model_files.unwrap,
                 fmt::format("New texture coordinates in models {},\neven if the model has some",
                             endings_of(FormatTrait::texture, "and")))
        ->group(group);
    app.add_flag_callback(
           "--exr", [&run] { run.model_files.map_format = MapFormat::exr; },
           "The maps beside it as OpenEXR: linear light, and heights in\nlengths of the model")
        ->group(group);
    add_value(
        app, "--lods", "N",
        "Models of N levels of detail, each with a quarter of the\ntriangles of the one before",
        whole_number(2, ModelFileOptions::most_levels),
        [&](auto levels) { run.model_files.levels = static_cast<int>(levels); })
        ->group(group);
    app.add_flag("--animate", run.model_files.animate,
                 "A model .glb that shows how the pattern grew, a moment\nfor each interval")
        ->group(group);
    app.add_flag("--merge", run.model_files.merge,
                 "Cells that crawl as plain triangles, for programs that\nknow no instances")
        ->group(group);
    CLI::Option* const bake =
        add_value(
            app, "--bake", "N",
            "A model .glb with maps of N x N texels (colour, height,\nroughness, …), which are "
            "written beside it too; by the\nmodel's texture coordinates, or new ones if it has none.\nA plane's maps repeat",
            whole_number(1, ModelFileOptions::most_texels),
            [&](auto texels) { run.model_files.bake = texels; })
            ->group(group);
    add_value(app, "--texels-per-cell", "N",
              "Instead of --bake: maps so large that cells are N texels\nwide, such as 4",
              parse_texels, [&](double texels) { run.model_files.texels_per_cell = texels; })
        ->excludes(bake)
        ->group(group);
    add_value(app, "--cache", "FOLDER", "Keep the cells of models there, for the next run",
              any_text, [&](auto path) { run.simulation.cell_cache = path; })
        ->group(group);
    add_value(app, "--resume", "FOLDER", "Go on with a run that --save wrote", any_text,
              [&](auto path) { run.resume = path; })
        ->group(group);
}

void add_log(CLI::App& app, RunRequest& run) {
    const std::string group = "Numbers";
    CLI::Option* log = app.add_option("--log", run.log.expressions,
                                      "A number over time, such as 'mean(u over domain)', as a\n"
                                      "table; may be given again");
    log->allow_extra_args(false)->type_name("EXPR")->group(group);
    add_value(app, "--log-every", "N",
              "Steps from one row to the next; without it each stage's\ninterval",
              whole_number(1, std::numeric_limits<std::int64_t>::max()),
              [&](auto every) { run.log.every = every; })
        ->needs(log)
        ->group(group);
    add_value(app, "--log-file", "FILE.csv", "The table; without it beside the picture", any_text,
              [&](auto path) { run.log.file = path; })
        ->needs(log)
        ->group(group);
    app.add_flag("--features", run.features, "Measure what the picture shows: wavelength, spots, …")
        ->group(group);
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
    add_value(app, "--lanes", "4|8|16", "Cells in a vector; without it the processor's width",
              one_of({"4", "8", "16"}),
              [&](const auto& lanes) {
                  simulation.lanes = lanes == "4" ? 4 : lanes == "8" ? 8 : 16;
              })
        ->group(group);
    // For tests and fuzzers; not shown by --help.
    add_value(app, "--tiling", "LEVELS,LAYER", "How steps go through memory", parse_tiling,
              [&](const Tiling& tiling) { simulation.tiling = tiling; })
        ->group("");
    app.add_flag_callback(
           "--no-kernel-cache", [&simulation] { simulation.kernel_cache.clear(); },
           "Compile all native code again, and keep none of it")
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
              "Make four smaller triangles of each one, N times over, on a\nsmooth surface",
              whole_number(1, 8),
              [&](auto times) { options.reshaping.subdivide = static_cast<int>(times); });
    add_value(app, "--simplify", "N", "Leave about N triangles, where the shape needs them most",
              whole_number(1, std::numeric_limits<std::int32_t>::max()),
              [&](auto count) { options.reshaping.simplify = static_cast<std::size_t>(count); });
    app.add_flag("--unwrap", options.mesh_files.unwrap,
                 "Make texture coordinates: charts of little distortion,\npacked into one texture");
    add_value(app, "-o,--output", "FILE",
              "The repaired model: " + endings_of(FormatKind::model, "or"),
              path_of(FormatKind::model), [&](auto path) { options.mesh_output = path; });
    add_value(app, "--cells", "N|faces|vertices",
              "Spread N cells over the surface, or make cells of the\n"
              "model's faces or points, and describe them",
              parse_cells, [&](const CellOptions& cells) { options.cells = cells; })
        ->group("Cells");
    add_value(app, "--seed", "N", "The seed of the cells' random places (with --cells N)",
              whole_number(0, 4294967295),
              [&](auto seed) { options.cell_seed = static_cast<std::uint32_t>(seed); })
        ->group("Cells");
}

void add_stop(CLI::App& app, Options& options) {
    add_value(app, "--stop-at", "STAGE:STEP", "Stop there as Ctrl-C would", parse_stop_at,
              [&](auto stop) { options.run.stop_at = stop; })
        ->group(execution_group);
}

void add_timing(CLI::App& app, Options& options) {
    app.add_flag("--timing", options.timing, "Print a table of where the time went")
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
    app.add_flag("-q,--quiet", options.quiet, "No progress and no remarks")->group(execution_group);
}

void add_dump(CLI::App& app, Options& options) {
    std::vector<std::string> kinds;
    for (const std::string_view kind : dump_kinds()) kinds.emplace_back(kind);
    add_value(app, "--dump", "WHAT",
              "Print one form of the script, and stop:\n" + help::in_lines(kinds), one_of(kinds),
              [&](auto kind) { options.dump = kind; })
        ->group("More");
}

void add_compile(CLI::App& app, Options& options) {
    const std::string group = "Output";
    CompileRequest& compile = options.compile;
    add_value(app, "-o,--output", "FILE.o", "The object file; without it SCRIPT.o in this folder",
              any_text, [&](auto path) { options.object = path; })
        ->group(group);
    add_value(app, "--header", "FILE.h", "The C header; without it beside the object file",
              any_text, [&](auto path) { options.header = path; })
        ->group(group);
    add_value(app, "--stage", "STAGE", "Name or number of the stage; without it the first",
              any_text, [&](auto stage) { compile.stage = stage; })
        ->group(group);
    add_value(app, "--per-cell", "NAMES", "Parameters that get a value for each cell: beta,ka",
              parse_names, [&](auto names) { compile.per_cell = names; })
        ->group(group);
    add_value(app, "--target", "CPU", "A processor such as x86-64-v3; without it this one",
              any_text, [&](auto target) { compile.target = target; })
        ->group(group);
    add_value(app, "--stages", "N", "Stages of each step of rkl1 and rkl2: odd, 3 to 99",
              odd_number(3, most_compiled_stages),
              [&](auto stages) { compile.stages = static_cast<std::uint32_t>(stages); })
        ->group(group);
    add_value(app, "--name", "NAME", "The C functions' name; without it SCRIPT_STAGE", any_text,
              [&](auto name) { compile.function_name = name; })
        ->group(group);
}

void add_export(CLI::App& app, Options& options) {
    add_value(app, "--html", "FILE.html", "The page; without it SCRIPT.html in this folder",
              any_text, [&](auto path) { options.html = path; })
        ->group("Output");
    app.add_flag(
           "--exact", options.exact,
           "The bits of 'cascade run', also of numbers below 1.2e-38;\nsteps take 8 times as long")
        ->group("Output");
}

}  // namespace cascade::option_groups
