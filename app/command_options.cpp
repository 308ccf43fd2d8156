// Defines the arguments and options of each command.
#include "app/command_options.h"

#include "app/option_groups.h"
#include "core/file_format.h"

#include <CLI/CLI.hpp>

#include <string>

namespace cascade::command_options {

namespace groups = option_groups;

namespace {

void add_scripts(CLI::App& command, Options& options, const std::string& about) {
    command.add_option("SCRIPTS", options.scripts, about)->type_name("");
}

/// Adds the output option of a command that writes one file.
template <typename Path>
void add_output(CLI::App& command, Path& path, const std::string& about) {
    command
        .add_option_function<std::string>(
            "-o,--output", [&](const std::string& given) { path = given; }, about)
        ->type_name("FILE")
        ->group("Output");
}

}  // namespace

void run(CLI::App& command, Options& options) {
    groups::add_script(command, options,
                       "A script, a picture that Cascade drew, or - for standard input");
    groups::add_files(command, options.run);
    groups::add_picture_options(command, options.picture);
    groups::add_run_options(command, options.run, RunOption::log, RunOption::features);
    groups::add_seeds(command, options, "Numbers",
                      "Run with each of these seeds, or of a list 3,7,12, and write\nmeans with "
                      "their 95 % intervals: the same as cascade sweep\nwith this option");
    groups::add_overrides(command, options.overrides);
    groups::add_simulation(command, options, "Threads; by default all cores");
    groups::add_run_options(command, options.run, RunOption::stop_at, RunOption::stop_at);
    groups::add_ranks(command, options, "steps");
    groups::add_device(command, options);
    groups::add_timing(command, options);
    groups::add_quiet(command, options);
    groups::add_limits(command, options);
    groups::add_dump(command, options);
    groups::add_json(command, options);
}

void sweep(CLI::App& command, Options& options) {
    groups::add_script(command, options, "A script, or a picture that Cascade drew");
    groups::add_sweep(command, options);
    groups::add_picture_options(command, options.picture, true);
    groups::add_run_options(command, options.run, RunOption::log, RunOption::log_every);
    for (const char* moments : {"--at", "--every"}) {
        command.get_option(moments)->needs(command.get_option("--log"));
    }
    groups::add_overrides(command, options.overrides);
    groups::add_simulation(command, options,
                           "Runs at once, each on one thread; by default as many\n"
                           "as there are cores");
    groups::add_ranks(command, options, "runs");
    groups::add_quiet(command, options);
    groups::add_limits(command, options);
    groups::add_json(command, options);
}

void follow(CLI::App& command, Options& options) {
    groups::add_script(command, options, "A script, or a picture that Cascade drew");
    groups::add_follow(command, options);
    groups::add_overrides(command, options.overrides);
    groups::add_simulation(command, options, "Threads of the run; by default all cores");
    groups::add_quiet(command, options);
    groups::add_limits(command, options);
    groups::add_json(command, options);
}

void check(CLI::App& command, Options& options) {
    add_scripts(command, options, "Scripts, pictures that Cascade drew, or -");
    groups::add_overrides(command, options.overrides);
    groups::add_dump(command, options);
    groups::add_json(command, options);
}

void analyze(CLI::App& command, Options& options) {
    groups::add_script(command, options, "A script, or a picture that Cascade drew");
    groups::add_analyze(command, options);
    groups::add_overrides(command, options.overrides);
}

void bench(CLI::App& command, Options& options) {
    add_scripts(command, options, "Scripts, pictures that Cascade drew, or -");
    groups::add_bench(command, options);
    groups::add_overrides(command, options.overrides);
    groups::add_simulation(command, options, "At most N threads; by default all cores");
    groups::add_quiet(command, options);
    groups::add_limits(command, options);
}

void compile(CLI::App& command, Options& options) {
    groups::add_script(command, options, "A script");
    groups::add_compile(command, options);
    groups::add_overrides(command, options.overrides);
}

void systems(CLI::App& command, Options& options) {
    command
        .add_option("WORDS", options.words,
                    "The name of a system, or words of its description; a script before "
                    "it\nshows the systems of the script instead of the library's")
        ->type_name("");
    groups::add_json(command, options);
}

void examples(CLI::App& command, Options& options) {
    command
        .add_option("WORDS", options.words,
                    "The name of an example, such as leopard or cells/fur, or words of its\nname "
                    "or description")
        ->type_name("");
    add_output(command, options.new_script,
               "Copy the example to a new file, and the pictures that it\nreads beside it");
    command
        .add_flag("--path", options.prints_path, "Print where the example is, instead of its text")
        ->group("Output");
}

void new_script(CLI::App& command, Options& options) {
    command
        .add_option_function<std::string>(
            "SYSTEM", [&](const std::string& name) { options.words.push_back(name); },
            "A system of the library")
        ->type_name("");
    add_output(command, options.new_script, "The script, a new file; by default standard output");
}

void import_model(CLI::App& command, Options& options) {
    command.add_option("MODEL", options.scripts, "A file or link of another program")
        ->type_name("")
        ->expected(0, 1);
    command
        .add_option("--diffusion", options.diffusion,
                    "Give a species a diffusion coefficient: A=0.1; may be repeated.\n"
                    "For formats that describe reactions only")
        ->type_name("NAME=D")
        ->allow_extra_args(false);
    command
        .add_option("--preset", options.preset,
                    "The preset to import, if MODEL is a file of several")
        ->type_name("NAME");
    command
        .add_option("--presets", options.presets,
                    "A file of presets of VisualPDE, for presets that change one of these,\n"
                    "and for links that name one")
        ->type_name("FILE");
    add_output(command, options.new_script,
               "The script, a new file; by default MODEL.cascade in this folder");
}

void palettes(CLI::App& command, Options& options) {
    command
        .add_option("WORDS", options.words,
                    "Names of palettes, or your own colours in quotes; by default all")
        ->type_name("");
    add_output(command, options.sheet,
               "A sheet of them, " + endings_of(FormatTrait::drawing, "or"));
}

void format(CLI::App& command, Options& options) {
    add_scripts(command, options, "Scripts, or - for standard input");
    command.add_flag("--check", options.check_only,
                     "Write nothing; name the scripts that would change, with status 1");
    auto* const ascii = command.add_flag_callback(
        "--ascii", [&] { options.notation = ScriptNotation::ascii; },
        "Spell everything in ASCII: u' = D*lap(u) + u^2*v");
    command
        .add_flag_callback(
            "--unicode", [&] { options.notation = ScriptNotation::papers; },
            "Spell everything as papers do: ∂u/∂t = D∇²u + u²v")
        ->excludes(ascii);
}

void mesh(CLI::App& command, Options& options) {
    groups::add_mesh(command, options);
    groups::add_json(command, options);
}

void repl(CLI::App& command, Options& options) {
    groups::add_script(command, options, "A script to begin with (may be left out)");
    groups::add_simulation(command, options, "Threads; by default all cores");
    groups::add_run_options(command, options.run, RunOption::stop_at, RunOption::stop_at);
    groups::add_quiet(command, options);
}

void export_page(CLI::App& command, Options& options) {
    groups::add_script(command, options, "A script");
    groups::add_export(command, options);
    groups::add_overrides(command, options.overrides);
}

void view(CLI::App& command, Options& options) {
    groups::add_script(command, options, "A script; without it the page offers the library");
    command.add_flag("--no-browser", options.no_browser, "Print the address and open nothing");
    groups::add_overrides(command, options.overrides);
    groups::add_simulation(command, options, "Threads; by default all cores");
}

void lsp(CLI::App& command, Options& options) {
    command.add_flag("--words", options.prints_words,
                     "Print the words of the language as JSON, and end");
    command.add_flag_callback(
        "--stdio", [] {}, "Has no effect; some editors give this option to every server");
}

}  // namespace cascade::command_options
