// The table of commands, and the commands that change the script. app/prompt_run.cpp contains the
// commands that concern the run.
#include "app/prompt_session.h"

#include "app/exit_status.h"
#include "app/prompt_names.h"
#include "app/prompt_text.h"
#include "core/file.h"
#include "core/near_name.h"
#include "lang/syntax/parse.h"
#include "lang/syntax/replace_blocks.h"
#include "run/commands/run.h"
#include "run/session/changed_script.h"
#include "run/session/session_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cascade {

/// A command of the prompt, which begins with a colon.
struct PromptSession::Command {
    std::string_view name;
    std::string_view argument;
    std::string_view about;
    void (PromptSession::*action)(const std::string& argument);  ///< Null for `:quit`.
};

std::span<const PromptSession::Command> PromptSession::commands() {
    static constexpr std::array<Command, 17> all = {{
        {":run", "[N]", "take N steps, or all that are left", &PromptSession::run},
        {":next", "", "end the stage here and begin the next one", &PromptSession::next},
        {":show", "[EXPR]", "draw a species or any expression: ':show b'", &PromptSession::show},
        {":set", "NAME=EXPR", "change a parameter: ':set stage1.ka=1/400'", &PromptSession::set},
        {":paint", "NAME=EXPR", "give the cells other values: ':paint b=b+disc(0.5,0.5,0.1)'",
         &PromptSession::paint},
        {":undo", "", "back to the moment before the last change", &PromptSession::undo},
        {":redo", "", "forward again", &PromptSession::redo},
        {":goto", "STAGE", "to the start of a stage", &PromptSession::go_to},
        {":init", "", "back to the starting values", &PromptSession::init},
        {":features", "", "measure what is shown: wavelength, spots, direction",
         &PromptSession::print_features_shown},
        {":stages", "", "the stages, and how far they are", &PromptSession::list_stages},
        {":text", "", "the script so far", &PromptSession::print_text},
        {":save", "PATH",
         "NAME.png: the picture; NAME.session: all that was done;\n"
         "                       NAME.cascade: the script; FOLDER: every field",
         &PromptSession::save},
        {":load", "FILE", "a script, a picture, a session, or a folder that was saved",
         &PromptSession::load},
        {":new", "", "forget the script", &PromptSession::forget},
        {":help", "[COMMAND]", "this list, or what a command does", &PromptSession::help},
        {":quit", "", "leave (Ctrl-D does too)", nullptr},
    }};
    return all;
}

namespace {

/// Returns the commands of `cascade` that are also commands of the prompt.
std::vector<const CommandEntry*> shell_commands() {
    std::vector<const CommandEntry*> found;
    for (const CommandEntry& entry : command_table()) {
        if (entry.at_prompt != AtPrompt::absent) found.push_back(&entry);
    }
    return found;
}

std::string called(const CommandEntry& entry) { return fmt::format(":{}", entry.name); }

}  // namespace

PromptSession::PromptSession(const SimulationOptions& options, Console& console, bool at_terminal,
                             const TerminalPictures& pictures)
    : options_(options), console_(console), at_terminal_(at_terminal), pictures_(pictures) {}

PromptSession::~PromptSession() = default;

std::string PromptSession::prompt() const {
    const auto lines_of = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    const auto line = (script() ? lines_of(script()->text) : 0) + lines_of(pending_) + 1;
    return fmt::format("{}{} ", line, pending_.empty() ? '>' : '|');
}

std::vector<std::string> PromptSession::names(const std::string& line) const {
    std::vector<std::string> names;
    if (line.starts_with(":") && line.find(' ') == std::string::npos) {
        for (const Command& command : commands()) names.emplace_back(command.name);
        for (const CommandEntry* entry : shell_commands()) names.push_back(called(*entry));
        return names;
    }
    return names_at_end(line, script() ? *script()->program : Program());
}

bool PromptSession::take(const std::string& line) {
    if (pending_.empty()) {
        const std::string_view words = trim(line);
        if (words.starts_with(":")) return obey(words);
        // These words are commands of other prompts. None of them is a statement of the language.
        if (words == "help" || words == "?") return obey(":help");
        if (words == "quit" || words == "exit") return obey(":quit");
        if (says_nothing(line)) return true;
    }
    pending_ += line + "\n";
    if (is_complete(pending_)) end();
    return true;
}

void PromptSession::end() {
    if (pending_.empty()) return;
    const std::string text = std::move(pending_);
    pending_.clear();
    add_text(text);
}

void PromptSession::fail(const Failure& failure) {
    has_failed_ = true;
    console_.fail(failure);
}

void PromptSession::print_errors(const Script& script) {
    has_failed_ = has_failed_ || script.diagnostics.has_errors();
    console_.say(script.messages(console_.error().colour));
}

bool PromptSession::obey(std::string_view line) {
    const std::size_t space = std::min(line.find_first_of(" \t"), line.size());
    const std::string_view name = line.substr(0, space);
    const std::string argument(trim(line.substr(space)));
    std::vector<std::string> known;
    for (const Command& command : commands()) {
        known.emplace_back(command.name);
        if (command.name != name) continue;
        if (!command.action) return false;
        if (argument.empty() && !command.argument.empty() && command.argument[0] != '[') {
            fail({fmt::format("{} takes {}", name, command.argument), ""});
        } else if (!argument.empty() && command.argument.empty()) {
            fail({fmt::format("{} takes no argument", name), ""});
        } else {
            (this->*command.action)(argument);
        }
        return true;
    }
    for (const CommandEntry* entry : shell_commands()) {
        known.push_back(called(*entry));
        if (known.back() != name) continue;
        obey_shell(*entry, words_of(argument));
        return true;
    }
    const std::string near = nearest_name(name, known);
    fail({fmt::format("there is no command '{}'", name),
          near.empty() ? "':help' lists them" : fmt::format("did you mean '{}'?", near)});
    return true;
}

void PromptSession::print_refusal(const Refusal& refusal) {
    has_failed_ = true;
    console_.say(render(refusal.diagnostics, refusal.sources, {.colour = console_.error().colour}));
    if (refusal.failure) console_.fail(*refusal.failure);
}

namespace {

/// Whether the text is one expression and nothing else.
bool is_expression(const std::string& text) {
    Sources sources;
    Diagnostics errors;
    ast::Script tree;
    const SourceId source = sources.add("", std::string(trim(text)));
    return parse_expression(source, sources, tree, errors) && !errors.has_errors();
}

}  // namespace

/// Adds a text to the script. A block replaces the block of the same name. If the text is an
/// expression, only prints its value.
void PromptSession::add_text(const std::string& text) {
    if (is_expression(text)) return print_value(std::string(trim(text)));
    const std::string whole = script() ? with_blocks(script()->text, text) : text;
    if (run_) {
        apply(SetText{whole});
    } else if (script_) {
        change(load_script(script_->name, whole, script_->folder, script_->overrides));
    } else {
        change(load_script("prompt", whole, "."));
    }
}

/// Makes `changed` the script, if it has no errors. Must not be called if there is a run.
bool PromptSession::change(Script changed) {
    const std::string messages = changed.messages(console_.error().colour);
    if (!changed.program) {
        print_errors(changed);
        return false;
    }
    if (messages != last_warnings_) console_.say(messages);
    last_warnings_ = messages;
    script_ = std::make_unique<Script>(std::move(changed));
    // The messages in it have been printed. Only new messages matter from now on.
    script_->diagnostics = {};
    return true;
}

void PromptSession::load(const std::string& path) {
    std::error_code error;
    stem_ = std::filesystem::path(path).stem().string();
    if (std::filesystem::is_directory(path, error)) {
        load_saved(path);
        return;
    }
    if (is_session_log(first_bytes(path, longest_log_beginning))) return load_session(path);
    auto file = load_script_file(path);
    if (!file) {
        fail(file.error());
        return;
    }
    const auto session = session_of(*file);
    if (!session) return fail(session.error());
    if (*session) return play(**session, file->script.folder);
    if (!file->script.text.ends_with('\n') && file->script.program) {
        const Script& read = file->script;
        file->script = load_script(read.name, read.text + "\n", read.folder, read.overrides);
    }
    // A loaded script starts anew, even if its stages have the same names as before.
    if (!change(std::move(file->script))) return;
    run_.reset();
    kept_.reset();
    console_.note(fmt::format("{}: {} stages", path, script_->program->stages.size()));
}

void PromptSession::load_saved(const std::string& folder) {
    auto saved = load_saved_script(folder, {});
    if (!saved) {
        fail(saved.error());
        return;
    }
    if (!saved->program) {
        print_errors(*saved);
        return;
    }
    begin_with([&](RunControl& control) {
        return LiveRun::resume(std::move(*saved), options_, control,
                               [&](const Script& script, Simulation& simulation) {
                                   return restore_run(folder, script, simulation);
                               });
    });
}

void PromptSession::load_session(const std::string& path) {
    const auto text = read_file(path, largest_session_log);
    if (!text) return fail(text.error());
    const auto log = parse_session_log(*text);
    if (!log) {
        fail({fmt::format("{}: {}", path, log.error().message), log.error().hint});
        return;
    }
    play(*log, std::filesystem::path(path).parent_path());
}

void PromptSession::play(const SessionLog& log, const std::filesystem::path& folder) {
    begin_with([&](RunControl& control) {
        return LiveRun::play(log, folder.empty() ? "." : folder, options_, control);
    });
}

void PromptSession::set(const std::string& assignment) {
    const std::size_t sign = assignment.find_first_of("=:");
    const auto name = std::string(trim(assignment.substr(0, sign)));
    if (!script()) {
        fail({"there is no script yet", ""});
    } else if (sign == std::string::npos || name.empty()) {
        fail({":set takes NAME=EXPR", ""});
    } else if (run_) {
        if (apply(SetNumber{name, assignment.substr(sign + 1)}) && run_->is_over()) tell_over();
    } else {
        change(with_number(*script_, {name, assignment.substr(sign + 1)}));
    }
}

void PromptSession::print_text(const std::string&) {
    if (!script()) return;
    console_.print(script()->text);
    for (const std::string& set : script()->overrides.sets) {
        console_.print(fmt::format("# :set {}\n", set));
    }
}

void PromptSession::forget(const std::string&) {
    run_.reset();
    script_.reset();
    kept_.reset();
    stem_ = "prompt";
    last_warnings_.clear();
    shown_.clear();
}

/// Runs a command of `cascade`. If the command needs a script, it gets the script that was typed.
void PromptSession::obey_shell(const CommandEntry& command, std::vector<std::string> words) {
    words.insert(words.begin(), std::string(command.name));
    const bool asks_for_help = std::find(words.begin(), words.end(), "--help") != words.end();
    if (command.at_prompt == AtPrompt::of_script && !asks_for_help) {
        if (!script()) return fail({"there is no script yet", ""});
        words.emplace_back("-");
    }
    auto parsed = parse_options("cascade", words);
    if (const auto* leave = std::get_if<Leave>(&parsed)) {
        const bool is_good = leave->status == exit_status::success;
        has_failed_ = has_failed_ || !is_good;
        return is_good ? console_.print(leave->text) : console_.say(leave->text);
    }
    auto& options = std::get<Options>(parsed);
    if (script()) {
        options.typed = {script()->name, script()->text, script()->folder, script()->overrides};
    }
    if (command.action(options, console_) != exit_status::success) has_failed_ = true;
}

void PromptSession::help_on(const std::string& topic) {
    const std::string name = topic.starts_with(':') ? topic : ":" + topic;
    for (const Command& command : commands()) {
        if (command.name != name) continue;
        return console_.print(
            fmt::format("{} {}\n  {}\n", command.name, command.argument, command.about));
    }
    for (const CommandEntry* entry : shell_commands()) {
        if (called(*entry) == name) return obey_shell(*entry, {"--help"});
    }
    fail({fmt::format("there is no command '{}'", name), "':help' lists them"});
}

void PromptSession::help(const std::string& topic) {
    if (!topic.empty()) return help_on(topic);
    for (const Command& command : commands()) {
        console_.print(fmt::format(
            "  {:<20} {}\n", fmt::format("{} {}", command.name, command.argument), command.about));
    }
    std::vector<std::string> names;
    for (const CommandEntry* entry : shell_commands()) names.push_back(called(*entry));
    console_.print(
        fmt::format("  {:<20} as in the shell, of this script\n", fmt::join(names, " ")));
    console_.print(
        "Anything else is the language: 'stage s: turing_spots { ka: 1/80 }'. A line without\n"
        "errors is added to the script; one with an error changes nothing. A block of the same\n"
        "name replaces the old one, and the run continues with it. The value of an expression\n"
        "is printed.\n");
}

}  // namespace cascade
