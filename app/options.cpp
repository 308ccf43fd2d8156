// Makes a CLI11 application with a subcommand for each command, and rewords the messages of CLI11.
#include "app/options.h"

#include "app/commands.h"
#include "app/exit_status.h"
#include "app/foreign_options.h"
#include "app/help.h"
#include "app/manual.h"
#include "app/option_values.h"
#include "core/near_name.h"
#include "lang/vocabulary/settings.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

#include <optional>

namespace cascade {

namespace {

/// Formats help: the purpose of the command, its usage, options and examples.
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

/// All objects of CLI11. They are in one struct, so that they are destroyed after parsing.
struct Parser {
    std::vector<std::string> words;  ///< As the user typed them.
    CLI::App app;
    Options options;
    bool show_version = false;

    /// Adds the options of those commands that occur among the words.
    Parser(const std::string& program, std::vector<std::string> typed);
    /// Returns the text of --help for the chosen command or, if no command is chosen, for the
    /// program.
    std::string help();
    CLI::App* chosen();
    /// Returns the command as the user typed it, such as "cascade run".
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
    std::string in_one_word(const std::string& value);
    std::string value_of(const std::string& option) const;
    std::string describe_unexpected(const std::string& program);
};

std::string Parser::help() {
    std::string text = chosen() ? chosen()->help(app.get_name()) : app.help();
    // CLI11 puts two empty lines between groups. One of them is removed here.
    for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) {
        text.erase(at, 1);
    }
    return text;
}

Parser::Parser(const std::string& program, std::vector<std::string> typed)
    : words(std::move(typed)), app(std::string(help::about), program) {
    app.formatter(std::make_shared<HelpFormatter>());
    // If this were missing, --fast=0 and --fast=3 would be accepted.
    app.option_defaults()->disable_flag_override();
    app.set_help_flag("-h,--help", "This text; 'cascade COMMAND --help' describes a command");
    app.add_flag("-V,--version", show_version, "The version, and what it was built with");
    app.get_option("--help")->group("Options");
    app.footer(std::string(help::examples));
    for (const CommandEntry& entry : command_table()) {
        const std::string name(entry.name);
        CLI::App* const command = app.add_subcommand(name, std::string(entry.about));
        command->footer(std::string(entry.examples));
        command->group("Commands");
        command->set_help_flag();  // --help is added again at the end, so that it is listed last.
        // Adding the options of all commands would take longer than starting the program, so only
        // the commands that were typed get options.
        if (std::find(words.begin(), words.end(), name) == words.end()) continue;
        entry.add_options(*command, options);
        command->set_help_flag("-h,--help", "This text")->group("More");
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
        for (const std::string& name : option->get_lnames()) names.push_back(name);
    }
    const std::string bare = word.substr(0, word.find('=')).substr(word.find_first_not_of('-'));
    const std::string near = nearest_name(bare, names);
    return near.empty() ? "" : "--" + near;
}

/// Returns the first argument that begins like an option but is no option of the command.
std::optional<std::string> Parser::unknown_option() const {
    for (const std::string& word : app.remaining(true)) {
        if (word.starts_with("-") && word.size() > 1) return word;
    }
    return std::nullopt;
}

/// If the user has written `--set F 0.05`, where `value` is "0.05", returns the correct form "--set
/// F=0.05". Otherwise returns an empty string.
std::string Parser::in_one_word(const std::string& value) {
    const CLI::Option* const option = chosen()->get_option_no_throw("--set");
    if (option == nullptr || option->results().empty()) return "";
    const std::string& last = option->results().back();
    return last.find('=') == std::string::npos ? fmt::format("--set {}={}", last, value) : "";
}

/// Returns the value that the user has written for an unknown option, in the same word or the next.
/// Returns an empty string if there is no value.
std::string Parser::value_of(const std::string& option) const {
    if (const std::size_t mark = option.find('='); mark != std::string::npos) {
        return option.substr(mark + 1);
    }
    const auto at = std::find(words.begin(), words.end(), option);
    if (at == words.end() || at + 1 == words.end()) return "";
    const std::string& next = *(at + 1);
    return next.starts_with("--") || next.ends_with(".cascade") ? "" : next;
}

/// Describes an unknown option if there is one. An unexpected word after it may only be its value,
/// so that word is not described. If all options are known, describes the first word that no option
/// and no argument has used.
std::string Parser::describe_unexpected(const std::string& program) {
    const std::string where = called(program);
    if (const auto option = unknown_option()) {
        const std::string setting = option->substr(0, option->find('=')).substr(2);
        const std::string value = value_of(*option);
        if (option->starts_with("--") && is_setting_of(SettingBlock::stage, setting)) {
            return fmt::format("{}: there is no option --{}; write --set {}={}", where, setting,
                               setting, value.empty() ? "…" : value);
        }
        const auto is_option = [&](std::string_view name) {
            return chosen() && chosen()->get_option_no_throw(std::string(name)) != nullptr;
        };
        const std::string near = near_option(*option);
        if (const std::string advice =
                advice_about_option(*option, value, is_option, !near.empty());
            !advice.empty()) {
            return fmt::format("{}: there is no option {}; {}", where,
                               option->substr(0, option->find('=')), advice);
        }
        const auto file = std::ranges::find_if(words, [](const std::string& each) {
            return each.ends_with(".cascade");
        });
        const std::string meant = !near.empty() ? near
                                  : !chosen() && file != words.end()
                                      ? fmt::format("'{} run {} …'", program, *file)
                                      : "";
        return fmt::format("{}: there is no option {}{}", where, *option,
                           meant.empty() ? "" : fmt::format("; did you mean {}?", meant));
    }
    const std::vector<std::string> left = app.remaining(true);
    const std::string word = left.empty() ? "" : left.front();
    if (chosen()) {
        const std::string command = chosen()->get_name();
        const bool is_output = command == "run" && output_kind(word);
        const bool is_value = word.find('=') != std::string::npos && !word.starts_with('=');
        const std::string meant = is_output                        ? "-o " + word
                                  : is_value && command == "sweep" ? "--vary " + word
                                  : is_value                       ? "--set " + word
                                  : word == "help"                 ? "--help"
                                                                   : in_one_word(word);
        return fmt::format("{}: '{}' is one argument too many{}", where, word,
                           meant.empty() ? "" : fmt::format("; did you mean {}?", meant));
    }
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
    std::string near = nearest_name(word, names);
    if (near.empty() && word.find('.') != std::string::npos) near = "run " + word;
    if (word == "list" || word == "models" || word == "library") {
        near = "systems";
    }
    if (word == "version") near = "--version";
    if (word == "help") near = "--help";
    if (word == "start" || word == "simulate" || word == "plot" || word == "execute") near = "run";
    return fmt::format("{}: there is no command '{}'{}", where, word,
                       near.empty() ? fmt::format("; the commands are {}", fmt::join(names, ", "))
                                    : fmt::format("; did you mean '{} {}'?", program, near));
}

Leave Parser::wrong_use(const std::string& program, const CLI::ParseError& error) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        return leave(program, describe_unexpected(program));
    }
    // The value of an unknown option looks like an extra argument, so the option is reported
    // instead of the argument.
    if (unknown_option()) return leave(program, describe_unexpected(program));
    const std::string told = error.what();
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && told.starts_with("--")) {
        const std::string option = told.substr(0, told.find(':'));
        if (told.find("At Most") != told.npos) {
            return leave(program, fmt::format("{}: {} is given more than once; leave one of them "
                                              "out",
                                              called(program), option));
        }
        return leave(program, fmt::format("{}: {} needs a value", called(program), option));
    }
    if (told.ends_with(" was given a disallowed flag override")) {
        const std::string flag = told.substr(0, told.find(' '));
        return leave(program, fmt::format("{}: --{} takes no value", called(program), flag));
    }
    return leave(program, fmt::format("{}: {}", called(program), told));
}

/// Returns the name of a required argument that is missing, or an empty string if none is missing.
/// CLI11 cannot check this.
std::string missing_argument(const Options& options) {
    const bool needs_script =
        options.command == Command::sweep || options.command == Command::follow ||
        options.command == Command::check || options.command == Command::analyze ||
        options.command == Command::bench || options.command == Command::compile ||
        options.command == Command::format || options.command == Command::export_page ||
        (options.command == Command::run && options.run.resume.empty() && options.device != "list");
    if (needs_script && options.scripts.empty()) return "a script is missing";
    if (options.command == Command::import_model && options.scripts.empty()) {
        return "a file or link to import is missing";
    }
    if (options.command == Command::mesh && options.models.empty()) return "a model is missing";
    if (options.command == Command::new_script && options.words.empty()) {
        return "the name of a system is missing ('cascade systems' lists them)";
    }
    return "";
}

/// Removes `--`. All words after it are arguments. If such a word begins with '-', it must be a
/// path, and './' is put before it.
std::vector<std::string> without_terminator(std::vector<std::string> arguments) {
    const auto mark = std::find(arguments.begin(), arguments.end(), "--");
    if (mark == arguments.end()) return arguments;
    for (auto each = mark + 1; each != arguments.end(); ++each) {
        if (each->starts_with('-') && *each != "-") *each = "./" + *each;
    }
    arguments.erase(mark);
    return arguments;
}

/// With --seeds, `run` means `sweep`. A word after -- is no option.
std::vector<std::string> with_sweep_for_seeds(std::vector<std::string> words) {
    if (words.empty() || words.front() != "run") return words;
    const auto end = std::find(words.begin(), words.end(), "--");
    const bool has_seeds = std::any_of(words.begin(), end, [](const std::string& word) {
        return word == "--seeds" || word.starts_with("--seeds=");
    });
    if (has_seeds) words.front() = "sweep";
    return words;
}

/// The options of a command that --help shows or, if `arguments` is true, its arguments.
std::vector<ManualOption> describe(const CLI::App& app, bool arguments) {
    std::vector<ManualOption> all;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_positional() != arguments || option->get_group().empty()) continue;
        ManualOption& each = all.emplace_back();
        for (const std::string& name : option->get_snames()) each.names.push_back("-" + name);
        for (const std::string& name : option->get_lnames()) each.names.push_back("--" + name);
        if (arguments) each.names = {option->get_name(true, false)};
        else if (option->get_type_size() != 0) each.value = option->get_type_name();
        each.about = option->get_description();
        each.group = option->get_group();
        each.is_repeatable = option->get_expected_max() > 1;
    }
    return all;
}

}  // namespace

Manual read_manual() {
    std::vector<std::string> names;
    for (const CommandEntry& entry : command_table()) names.emplace_back(entry.name);
    Parser parser("cascade", names);
    Manual manual = {
        std::string(help::about), std::string(help::examples), describe(parser.app, false), {}};
    for (const CommandEntry& entry : command_table()) {
        const CLI::App& command = *parser.app.get_subcommand(std::string(entry.name));
        manual.commands.push_back({std::string(entry.name), std::string(entry.about),
                                   std::string(entry.examples), describe(command, true),
                                   describe(command, false)});
    }
    return manual;
}

PictureRequest apply(const PictureChanges& changes, PictureRequest request) {
#define CASCADE_PICTURE_OPTION(type, member, ...) \
    if (changes.member) request.member = *changes.member;
#include "run/script/picture_options.def"
    return request;
}

std::variant<Options, Leave> parse_options(const std::string& program,
                                           const std::vector<std::string>& arguments) {
    const std::vector<std::string> typed = with_sweep_for_seeds(arguments);
    Parser parser(program, typed);
    try {
        std::vector<std::string> words = without_terminator(typed);
        std::reverse(words.begin(), words.end());  // CLI11 expects the arguments in reverse order.
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
    options.arguments = arguments;
    return std::move(options);
}

}  // namespace cascade
