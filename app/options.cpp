#include "app/options.h"

#include "app/exit_status.h"
#include "app/help.h"
#include "app/option_values.h"
#include "core/near_name.h"
#include "core/palette.h"
#include "run/dump.h"
#include "run/png_texts.h"
#include "run/simulation.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <functional>
#include <limits>
#include <optional>

namespace cascade {

namespace {

/// The value of an option, or CLI11's way to say that it is wrong; parse_options() catches it.
template <typename T>
T value_or_throw(Result<T> value, const std::string& option) {
    if (value) return std::move(*value);
    const Failure& why = value.error();
    throw CLI::ValidationError(
        option, why.hint.empty() ? why.message : fmt::format("{} ({})", why.message, why.hint));
}

/// An option whose text is read by `parse`, a function to Result<T>, and handed to `store`.
template <typename Parse, typename Store>
CLI::Option* add_value(CLI::App& app, const std::string& names, const std::string& value,
                       const std::string& help, Parse parse, Store store) {
    const std::string name = names.substr(names.find("--"));
    return app
        .add_option_function<std::string>(
            names, [=](const std::string& text) { store(value_or_throw(parse(text), name)); }, help)
        ->type_name(value);
}

auto whole_number(std::int64_t low, std::int64_t high) {
    return [=](const std::string& text) { return parse_whole(text, low, high); };
}

Result<std::string> any_text(const std::string& text) {
    if (text.empty()) return failure("it must not be empty");
    return text;
}

std::vector<std::string> palette_names() {
    std::vector<std::string> names;
    for (const Palette& palette : palettes()) names.emplace_back(palette.name);
    return names;
}

auto one_of(std::vector<std::string> choices) {
    return [choices = std::move(choices)](const std::string& text) {
        return parse_choice(text, choices);
    };
}

void add_script(CLI::App& app, Options& options, const std::string& help) {
    app.add_option_function<std::string>(
           "SCRIPT", [&](const std::string& path) { options.scripts.push_back(path); }, help)
        ->type_name("");
}

void add_overrides(CLI::App& app, Overrides& overrides) {
    const std::string group = "Changes to the script, without editing it";
    add_value(app, "--grid", "WxH", "Columns and rows; '60' is a line of 60 cells", parse_grid,
              [&](auto grid) { overrides.grid = grid; })
        ->group(group);
    add_value(app, "--seed", "N", "Other random numbers",
              whole_number(0, std::numeric_limits<std::uint32_t>::max()),
              [&](auto seed) { overrides.seed = static_cast<std::uint32_t>(seed); })
        ->group(group);
    app.add_option("--set", overrides.sets,
                   "A parameter or setting: ka=1/400, large.ka=1/400;\nmay be given again")
        ->allow_extra_args(false)
        ->type_name("NAME=EXPR")
        ->group(group);
    add_value(app, "--steps", "N", "At most so many steps in every stage",
              whole_number(0, std::numeric_limits<std::int64_t>::max()),
              [&](auto steps) { overrides.steps = steps; })
        ->group(group);
    add_value(app, "--until-stage", "NAME", "The last stage that runs", any_text,
              [&](auto stage) { overrides.until_stage = stage; })
        ->group(group);
}

void add_picture_options(CLI::App& app, PictureChanges& picture) {
    const std::string group = "What the picture shows";
    add_value(app, "--show", "EXPR", "A species, a parameter, any expression: b, stage1.b,\n"
              "'a - b'", any_text, [&](auto show) { picture.show = show; })
        ->group(group);
    add_value(app, "--palette", "NAME",
              help::in_lines(palette_names()), one_of(palette_names()),
              [&](auto palette) { picture.palette = palette; })
        ->group(group);
    add_value(app, "--range", "LOW,HIGH", "The values at the palette's two ends; without it the\n"
              "smallest and the largest", parse_range, [&](auto range) { picture.range = range; })
        ->group(group);
    add_value(app, "--scale", "N", "Pixels for the side of a cell (1 to 64)", whole_number(1, 64),
              [&](auto scale) { picture.scale = static_cast<int>(scale); })
        ->group(group);
    add_value(app, "--depth", "BITS", "8 or 16 for each colour", one_of({"8", "16"}),
              [&](const auto& depth) { picture.depth = depth == "16" ? 16 : 8; })
        ->group(group);
    app.add_flag("--space-time", picture.space_time,
                 "A line of cells over time: a row of pixels for each\ninterval")
        ->group(group);
}

void add_files(CLI::App& app, RunRequest& run) {
    const std::string group = "Files";
    add_value(app, "-o,--output", "FILE.png", "The picture; without it SCRIPT.png in this folder",
              parse_png_path, [&](auto path) { run.output = path; })
        ->group(group);
    add_value(app, "--sheet", "FILE.png", "All species of all stages in one labelled picture",
              parse_png_path, [&](auto path) { run.sheet = path; })
        ->group(group);
    add_value(app, "--frames", "FOLDER", "A picture at each interval, all in one range", any_text,
              [&](auto path) { run.frames = path; })
        ->group(group);
    add_value(app, "--save", "FOLDER", "Every field as STAGE.NAME.npy, to read or to resume",
              any_text, [&](auto path) { run.save = path; })
        ->group(group);
    add_value(app, "--resume", "FOLDER", "Go on with a run that --save wrote", any_text,
              [&](auto path) { run.resume = path; })
        ->group(group);
}

void add_execution(CLI::App& app, Options& options) {
    const std::string group = "How it is computed (the results are the same, bit for bit)";
    SimulationOptions& simulation = options.run.simulation;
    if (!has_jit()) simulation.backend = BackendKind::interpreter;
    add_value(app, "--backend", "jit|interp", "Native code by LLVM, or the interpreter",
              one_of(has_jit() ? std::vector<std::string>{"jit", "interp"}
                               : std::vector<std::string>{"interp"}),
              [&](const auto& name) {
                  simulation.backend =
                      name == "jit" ? BackendKind::jit : BackendKind::interpreter;
              })
        ->group(group);
    add_value(app, "--threads", "N", "Threads; without it all cores", whole_number(1, 1024),
              [&](auto threads) { simulation.threads = static_cast<int>(threads); })
        ->group(group);
    add_value(app, "--lanes", "4|8|16", "Cells in a vector; without it what the processor has",
              one_of({"4", "8", "16"}),
              [&](const auto& lanes) {
                  simulation.lanes = lanes == "4" ? 4 : lanes == "8" ? 8 : 16;
              })
        ->group(group);
    add_value(app, "--stop-at", "STAGE:STEP", "Stop there as Ctrl-C would", parse_stop_at,
              [&](auto stop) { options.run.stop_at = stop; })
        ->group(group);
    app.add_flag("-q,--quiet", options.quiet, "No progress and no remarks")->group(group);
}

void add_dump(CLI::App& app, Options& options) {
    std::vector<std::string> kinds;
    for (const std::string_view kind : dump_kinds()) kinds.emplace_back(kind);
    add_value(app, "--dump", "WHAT",
              "Print what becomes of the script, and stop there:\n" + help::in_lines(kinds),
              one_of(kinds), [&](auto kind) { options.dump = kind; })
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
    add_value(app, "--name", "NAME", "The C function's name; without it SCRIPT_STAGE", any_text,
              [&](auto name) { compile.function_name = name; })
        ->group(group);
}

/// Help in the order in which one needs it: what it does, how it is called, options, examples.
class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter() {
        column_width(26);
        label("Positionals", "Arguments");
    }
    std::string make_usage(const CLI::App* app, std::string name) const override {
        const bool is_top = app->get_parent() == nullptr;
        if (is_top) return fmt::format("\nUsage: {} COMMAND [arguments and options]\n", name);
        const auto positionals =
            app->get_options([](const CLI::Option* option) { return option->get_positional(); });
        std::string usage = fmt::format("\nUsage: {}", name);
        for (const CLI::Option* option : positionals) {
            usage += fmt::format(" {}{}", option->get_name(true, false),
                                 option->get_expected_max() > 1 ? "…" : "");
        }
        return usage + " [options]\n";
    }
    std::string make_option_opts(const CLI::Option* option) const override {
        const std::string value = option->get_type_size() == 0 ? "" : option->get_type_name();
        return value.empty() ? "" : " " + value;
    }
};

/// All of CLI11 in one place, so that its objects end with the parsing.
struct Parser {
    CLI::App app;
    CLI::App* run = nullptr;
    CLI::App* check = nullptr;
    CLI::App* compile = nullptr;
    CLI::App* systems = nullptr;
    CLI::App* repl = nullptr;
    Options options;
    bool show_version = false;

    explicit Parser(const std::string& program) : app(std::string(help::about), program) {
        add_all();
    }
    void add_all();
    /// --help of the chosen command, or of the program.
    std::string help();
    CLI::App* command(const std::string& name, std::string_view about, std::string_view examples);
    CLI::App* chosen();
    /// "cascade run": what the user has called.
    std::string called(const std::string& program) {
        return chosen() ? fmt::format("{} {}", program, chosen()->get_name()) : program;
    }
    Leave leave(const std::string& program, const std::string& message) {
        return {exit_status::wrong_use, fmt::format("{}\n'{} --help' lists what there is.\n",
                                                    message, called(program))};
    }
    Leave wrong_use(const std::string& program, const CLI::ParseError& error);
    std::string near_option(const std::string& word);
    std::optional<std::string> unknown_option() const;
    std::string describe_unexpected(const std::string& program);
};

CLI::App* Parser::command(const std::string& name, std::string_view about,
                          std::string_view examples) {
    CLI::App* sub = app.add_subcommand(name, std::string(about));
    sub->footer(std::string(examples));
    sub->group("Commands");
    sub->set_help_flag();  // It is added last, to stand last.
    return sub;
}

std::string Parser::help() {
    std::string text = chosen() ? chosen()->help(app.get_name()) : app.help();
    // CLI11 leaves two empty lines between groups.
    for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) {
        text.erase(at, 1);
    }
    return text;
}

void Parser::add_all() {
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_help_flag("-h,--help", "This text; 'cascade COMMAND --help' tells of a command");
    app.add_flag("-V,--version", show_version, "The version, and what it was built with");
    app.get_option("--help")->group("Options");
    app.footer(std::string(help::examples));

    run = command("run", help::run, help::run_examples);
    add_script(*run, options, "A script, a picture that Cascade drew, or - for standard input");
    add_files(*run, options.run);
    add_picture_options(*run, options.picture);
    add_overrides(*run, options.overrides);
    add_execution(*run, options);
    add_dump(*run, options);

    check = command("check", help::check, help::check_examples);
    check->add_option("SCRIPTS", options.scripts, "Scripts, pictures that Cascade drew, or -")
        ->type_name("");
    add_overrides(*check, options.overrides);
    add_dump(*check, options);

    compile = command("compile", help::compile, help::compile_examples);
    add_script(*compile, options, "A script");
    add_compile(*compile, options);
    add_overrides(*compile, options.overrides);

    systems = command("systems", help::systems, help::systems_examples);
    add_script(*systems, options, "A script whose systems are listed as well (may be left out)");

    repl = command("repl", help::repl, help::repl_examples);
    add_script(*repl, options, "A script to begin with (may be left out)");
    add_execution(*repl, options);

    for (CLI::App* sub : {run, check, compile, systems, repl}) {
        sub->set_help_flag("-h,--help", "This text")->group("More");
    }
}

CLI::App* Parser::chosen() {
    const auto parsed = app.get_subcommands();
    return parsed.empty() ? nullptr : parsed.front();
}

std::string Parser::near_option(const std::string& word) {
    std::vector<std::string> names;
    CLI::App* where = chosen() ? chosen() : &app;
    for (const CLI::Option* option : where->get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return nearest_name(word.substr(0, word.find('=')), names);
}

/// The first option that there is not.
std::optional<std::string> Parser::unknown_option() const {
    for (const std::string& word : app.remaining(true)) {
        if (word.starts_with("-") && word.size() > 1) return word;
    }
    return std::nullopt;
}

/// What there is not: an option, since a word behind it may only be the value meant for it, or else
/// the first word that no option and no argument has taken.
std::string Parser::describe_unexpected(const std::string& program) {
    const std::string where = called(program);
    if (const auto option = unknown_option()) {
        const std::string near = near_option(*option);
        return fmt::format("{}: there is no option {}{}", where, *option,
                           near.empty() ? "" : fmt::format("; did you mean {}?", near));
    }
    const std::vector<std::string> left = app.remaining(true);
    const std::string word = left.empty() ? "" : left.front();
    if (chosen()) return fmt::format("{}: '{}' is one argument too many", where, word);
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
    std::string near = nearest_name(word, names);
    if (near.empty() && word.find('.') != std::string::npos) near = "run " + word;
    return fmt::format("{}: there is no command '{}'{}", where, word,
                       near.empty() ? fmt::format("; the commands are {}", fmt::join(names, ", "))
                                    : fmt::format("; did you mean '{} {}'?", program, near));
}

Leave Parser::wrong_use(const std::string& program, const CLI::ParseError& error) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        return leave(program, describe_unexpected(program));
    }
    // The value of an unknown option looks like an argument too many: the option is to blame.
    if (unknown_option()) return leave(program, describe_unexpected(program));
    const std::string words = error.what();
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && words.starts_with("--")) {
        const std::string option = words.substr(0, words.find(':'));
        return leave(program, fmt::format("{}: {} needs a value", called(program), option));
    }
    return leave(program, fmt::format("{}: {}", called(program), words));
}

/// What CLI11 cannot know: which arguments a command cannot do without.
std::string missing_argument(const Options& options) {
    const bool needs_script =
        options.command == Command::check || options.command == Command::compile ||
        (options.command == Command::run && options.run.resume.empty());
    if (needs_script && options.scripts.empty()) return "a script is missing";
    return "";
}

}  // namespace

PictureRequest apply(const PictureChanges& changes, PictureRequest request) {
    if (changes.show) request.show = *changes.show;
    if (changes.palette) request.palette = *changes.palette;
    if (changes.range) request.range = *changes.range;
    if (changes.scale) request.scale = *changes.scale;
    if (changes.depth) request.depth = *changes.depth;
    if (changes.space_time) request.space_time = true;
    return request;
}

std::variant<Options, Leave> parse_options(const std::string& program,
                                           const std::vector<std::string>& arguments) {
    Parser parser(program);
    try {
        // CLI11 takes the arguments from the back.
        parser.app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::CallForHelp&) {
        return Leave{exit_status::success, parser.help()};
    } catch (const CLI::ParseError& error) {
        return parser.wrong_use(program, error);
    }
    if (parser.show_version) return Leave{exit_status::success, help::version_text()};
    CLI::App* const sub = parser.chosen();
    if (!sub) return Leave{exit_status::wrong_use, parser.help()};

    Options& options = parser.options;
    if (sub == parser.check) options.command = Command::check;
    if (sub == parser.compile) options.command = Command::compile;
    if (sub == parser.systems) options.command = Command::systems;
    if (sub == parser.repl) options.command = Command::repl;
    if (const std::string missing = missing_argument(options); !missing.empty()) {
        return parser.leave(program, fmt::format("{}: {}", parser.called(program), missing));
    }
    return std::move(options);
}

}  // namespace cascade
