// One CLI11 application with a subcommand for each command; its errors are reworded.
#include "app/options.h"

#include "app/commands.h"
#include "app/exit_status.h"
#include "app/help.h"
#include "app/option_groups.h"
#include "core/near_name.h"
#include "lang/vocabulary/settings.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

#include <optional>

namespace cascade {

namespace {

/// Formats help: what the command does, usage, options, examples.
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

/// Everything of CLI11 in one struct, so that it is destroyed after parsing.
struct Parser {
    CLI::App app;
    CLI::App* run = nullptr;
    CLI::App* sweep = nullptr;
    CLI::App* check = nullptr;
    CLI::App* analyze = nullptr;
    CLI::App* bench = nullptr;
    CLI::App* compile = nullptr;
    CLI::App* systems = nullptr;
    CLI::App* new_script = nullptr;
    CLI::App* palettes = nullptr;
    CLI::App* format = nullptr;
    CLI::App* mesh = nullptr;
    CLI::App* repl = nullptr;
    CLI::App* view = nullptr;
    CLI::App* export_page = nullptr;
    Options options;
    bool show_version = false;

    explicit Parser(const std::string& program) : app(std::string(help::about), program) {
        add_all();
    }
    void add_all();
    /// --help of the chosen command, or of the program if there is none.
    std::string help();
    CLI::App* command(const std::string& name, std::string_view about, std::string_view examples);
    CLI::App* chosen();
    /// The command as the user calls it, such as "cascade run".
    std::string called(const std::string& program) {
        return chosen() ? fmt::format("{} {}", program, chosen()->get_name()) : program;
    }
    Leave leave(const std::string& program, const std::string& message) {
        return {exit_status::wrong_use,
                fmt::format("{}\n'{} --help' shows how to use it.\n", message, called(program))};
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
    sub->set_help_flag();  // It is added last, so that it is listed last.
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
    namespace groups = option_groups;
    app.formatter(std::make_shared<HelpFormatter>());
    app.option_defaults()->disable_flag_override();  // Else --fast=0 and --fast=3 are taken.
    app.set_help_flag("-h,--help", "This text; 'cascade COMMAND --help' describes a command");
    app.add_flag("-V,--version", show_version, "The version, and what it was built with");
    app.get_option("--help")->group("Options");
    app.footer(std::string(help::examples));

    run = command("run", help::run, help::run_examples);
    groups::add_script(*run, options,
                       "A script, a picture that Cascade drew, or - for standard input");
    groups::add_files(*run, options.run);
    groups::add_picture_options(*run, options.picture);
    groups::add_log(*run, options.run);
    groups::add_overrides(*run, options.overrides);
    groups::add_simulation(*run, options, "Threads; without it all cores");
    groups::add_stop(*run, options);
    groups::add_timing(*run, options);
    groups::add_quiet(*run, options);
    groups::add_limits(*run, options);
    groups::add_dump(*run, options);

    sweep = command("sweep", help::sweep, help::sweep_examples);
    groups::add_script(*sweep, options, "A script, or a picture that Cascade drew");
    groups::add_sweep(*sweep, options);
    groups::add_shown(*sweep, options.picture);
    groups::add_overrides(*sweep, options.overrides);
    groups::add_simulation(*sweep, options,
                           "Runs at once, each on one thread; without it as many\n"
                           "as there are cores");
    groups::add_quiet(*sweep, options);
    groups::add_limits(*sweep, options);

    check = command("check", help::check, help::check_examples);
    check->add_option("SCRIPTS", options.scripts, "Scripts, pictures that Cascade drew, or -")
        ->type_name("");
    groups::add_overrides(*check, options.overrides);
    groups::add_dump(*check, options);

    analyze = command("analyze", help::analyze, help::analyze_examples);
    groups::add_script(*analyze, options, "A script, or a picture that Cascade drew");
    groups::add_analyze(*analyze, options);
    groups::add_overrides(*analyze, options.overrides);

    bench = command("bench", help::bench, help::bench_examples);
    bench->add_option("SCRIPTS", options.scripts, "Scripts, pictures that Cascade drew, or -")
        ->type_name("");
    groups::add_bench(*bench, options);
    groups::add_overrides(*bench, options.overrides);
    groups::add_simulation(*bench, options, "At most N threads; without it all cores");
    groups::add_quiet(*bench, options);
    groups::add_limits(*bench, options);

    compile = command("compile", help::compile, help::compile_examples);
    groups::add_script(*compile, options, "A script");
    groups::add_compile(*compile, options);
    groups::add_overrides(*compile, options.overrides);

    systems = command("systems", help::systems, help::systems_examples);
    systems
        ->add_option("WORDS", options.words,
                     "The name of a system, or words that its description has; before it a\n"
                     "script whose systems are shown instead of the library's")
        ->type_name("");

    new_script = command("new", help::new_script, help::new_script_examples);
    new_script
        ->add_option_function<std::string>(
            "SYSTEM", [&](const std::string& name) { options.words.push_back(name); },
            "A system of the library")
        ->type_name("");
    new_script
        ->add_option_function<std::string>(
            "-o,--output", [&](const std::string& path) { options.new_script = path; },
            "The script, a new file; without it standard output")
        ->type_name("FILE")
        ->group("Output");

    palettes = command("palettes", help::palettes, help::palettes_examples);
    palettes
        ->add_option("WORDS", options.words,
                     "Names of palettes, or colours of one's own in quotes; without them all")
        ->type_name("");
    palettes
        ->add_option_function<std::string>(
            "-o,--output", [&](const std::string& path) { options.sheet = path; },
            "A sheet of them, .png, .svg or .pdf")
        ->type_name("FILE")
        ->group("Output");

    format = command("fmt", help::format, help::format_examples);
    format->add_option("SCRIPTS", options.scripts, "Scripts, or - for standard input")
        ->type_name("");
    format->add_flag("--check", options.check_only,
                     "Write nothing; name the scripts that would change, with status 1");
    auto* const ascii = format->add_flag_callback(
        "--ascii", [&] { options.notation = ScriptNotation::ascii; },
        "Spell everything in ASCII: u' = D*lap(u) + u^2*v");
    format
        ->add_flag_callback(
            "--unicode", [&] { options.notation = ScriptNotation::papers; },
            "Spell everything as papers do: ∂u/∂t = D∇²u + u²v")
        ->excludes(ascii);

    mesh = command("mesh", help::mesh, help::mesh_examples);
    groups::add_mesh(*mesh, options);

    repl = command("repl", help::repl, help::repl_examples);
    groups::add_script(*repl, options, "A script to begin with (may be left out)");
    groups::add_simulation(*repl, options, "Threads; without it all cores");
    groups::add_stop(*repl, options);
    groups::add_quiet(*repl, options);

    export_page = command("export", help::export_page, help::export_page_examples);
    groups::add_script(*export_page, options, "A script");
    groups::add_export(*export_page, options);
    groups::add_overrides(*export_page, options.overrides);
    view = command("view", help::view, help::view_examples);
    groups::add_script(*view, options, "A script; without it the page offers the library");
    view->add_flag("--no-browser", options.no_browser, "Print the address and open nothing");
    groups::add_overrides(*view, options.overrides);
    groups::add_simulation(*view, options, "Threads; without it all cores");

    for (CLI::App* sub : {run, sweep, check, analyze, bench, compile, systems, new_script, palettes,
                          format, mesh, repl, view, export_page}) {
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

/// The first argument that looks like an option and is none.
std::optional<std::string> Parser::unknown_option() const {
    for (const std::string& word : app.remaining(true)) {
        if (word.starts_with("-") && word.size() > 1) return word;
    }
    return std::nullopt;
}

/// Describes an unknown option, since a word after it may only be its value; else the first word
/// that no option and no argument has taken.
std::string Parser::describe_unexpected(const std::string& program) {
    const std::string where = called(program);
    if (const auto option = unknown_option()) {
        const std::string setting = option->substr(0, option->find('=')).substr(2);
        if (option->starts_with("--") && is_setting_of(SettingBlock::stage, setting)) {
            return fmt::format("{}: there is no option --{}; write --set {}=…", where, setting,
                               setting);
        }
        const std::string near = near_option(*option);
        return fmt::format("{}: there is no option {}{}", where, *option,
                           near.empty() ? "" : fmt::format("; did you mean {}?", near));
    }
    const std::vector<std::string> left = app.remaining(true);
    const std::string word = left.empty() ? "" : left.front();
    if (chosen()) {
        const bool is_output = chosen() == run && output_kind(word);
        return fmt::format("{}: '{}' is one argument too many{}", where, word,
                           is_output ? fmt::format("; did you mean -o {}?", word) : "");
    }
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
    // The value of an unknown option looks like an extra argument: report the option.
    if (unknown_option()) return leave(program, describe_unexpected(program));
    const std::string words = error.what();
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && words.starts_with("--")) {
        const std::string option = words.substr(0, words.find(':'));
        return leave(program, fmt::format("{}: {} needs a value", called(program), option));
    }
    if (words.ends_with(" was given a disallowed flag override")) {
        const std::string flag = words.substr(0, words.find(' '));
        return leave(program, fmt::format("{}: --{} takes no value", called(program), flag));
    }
    return leave(program, fmt::format("{}: {}", called(program), words));
}

/// Names a required argument that is missing, which CLI11 cannot check; empty if there is none.
std::string missing_argument(const Options& options) {
    const bool needs_script =
        options.command == Command::sweep || options.command == Command::check ||
        options.command == Command::analyze || options.command == Command::bench ||
        options.command == Command::compile || options.command == Command::format ||
        options.command == Command::export_page ||
        (options.command == Command::run && options.run.resume.empty());
    if (needs_script && options.scripts.empty()) return "a script is missing";
    if (options.command == Command::mesh && options.models.empty()) return "a model is missing";
    if (options.command == Command::new_script && options.words.empty()) {
        return "the name of a system is missing ('cascade systems' lists them)";
    }
    return "";
}

/// Removes `--`, after which no word is an option: a word that begins with '-' is a path there, so
/// './' is put before it.
std::vector<std::string> without_terminator(std::vector<std::string> arguments) {
    const auto mark = std::find(arguments.begin(), arguments.end(), "--");
    if (mark == arguments.end()) return arguments;
    for (auto each = mark + 1; each != arguments.end(); ++each) {
        if (each->starts_with('-') && *each != "-") *each = "./" + *each;
    }
    arguments.erase(mark);
    return arguments;
}

}  // namespace

PictureRequest apply(const PictureChanges& changes, PictureRequest request) {
    if (changes.show) request.show = *changes.show;
    if (changes.palette) request.palette = *changes.palette;
    if (changes.range) request.range = *changes.range;
    if (changes.scale) request.scale = *changes.scale;
    if (changes.depth) request.depth = *changes.depth;
    if (changes.detail) request.detail = *changes.detail;
    if (changes.space_time) request.space_time = true;
    if (changes.slice) request.slice = *changes.slice;
    if (changes.flat) request.flat = true;
    if (changes.view) request.view = *changes.view;
    if (changes.size) request.size = changes.size;
    if (changes.copies) request.copies = *changes.copies;
    if (changes.quality) request.quality = *changes.quality;
    if (changes.lighting) request.lighting = *changes.lighting;
    if (changes.fov) request.fov = changes.fov;
    if (changes.ground) request.ground = *changes.ground;
    if (changes.background) request.background = *changes.background;
    if (changes.bump) request.bump = *changes.bump;
    if (changes.displace) request.displace = true;
    return request;
}

std::variant<Options, Leave> parse_options(const std::string& program,
                                           const std::vector<std::string>& arguments) {
    Parser parser(program);
    try {
        std::vector<std::string> words = without_terminator(arguments);
        std::reverse(words.begin(), words.end());  // CLI11 takes the arguments in reverse order.
        parser.app.parse(std::move(words));
    } catch (const CLI::CallForHelp&) {
        return Leave{exit_status::success, parser.help()};
    } catch (const CLI::ParseError& error) {
        return parser.wrong_use(program, error);
    }
    if (parser.show_version) return Leave{exit_status::success, help::version_text()};
    CLI::App* const sub = parser.chosen();
    if (!sub) return Leave{exit_status::wrong_use, parser.help()};

    Options& options = parser.options;
    for (const CommandEntry& entry : command_table()) {
        if (entry.name == sub->get_name()) options.command = entry.command;
    }
    if (const std::string missing = missing_argument(options); !missing.empty()) {
        return parser.leave(program, fmt::format("{}: {}", parser.called(program), missing));
    }
    return std::move(options);
}

}  // namespace cascade
