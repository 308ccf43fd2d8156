// The table of commands, and those that change the script; app/prompt_run.cpp has those of the run.
#include "app/prompt_session.h"

#include "app/prompt_text.h"
#include "core/near_name.h"
#include "lang/check/check.h"
#include "run/commands/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cascade {

/// A command, which begins with a colon.
struct PromptSession::Command {
    std::string_view name;
    std::string_view argument;
    std::string_view about;
    void (PromptSession::*action)(const std::string& argument);  ///< Null for `:quit`.
};

std::span<const PromptSession::Command> PromptSession::commands() {
    static constexpr std::array<Command, 11> all = {{
        {":run", "[N]", "take N steps, or all that are left", &PromptSession::run},
        {":show", "[EXPR]", "draw a species or any expression: ':show b'", &PromptSession::show},
        {":init", "", "back to the starting values", &PromptSession::init},
        {":set", "NAME=EXPR", "change a parameter: ':set stage1.ka=1/400'", &PromptSession::set},
        {":stages", "", "the stages, and how far they are", &PromptSession::list_stages},
        {":text", "", "the script so far", &PromptSession::print_text},
        {":save", "FOLDER", "write every field, to load or to resume", &PromptSession::save},
        {":load", "FILE", "a script, a picture, or a folder that was saved", &PromptSession::load},
        {":new", "", "forget the script", &PromptSession::forget},
        {":help", "", "this list", &PromptSession::help},
        {":quit", "", "leave (Ctrl-D does too)", nullptr},
    }};
    return all;
}

PromptSession::PromptSession(const SimulationOptions& options, Console& console,
                             bool show_after_run)
    : options_(options), console_(console), show_after_run_(show_after_run) {}

PromptSession::~PromptSession() = default;

std::string PromptSession::prompt() const {
    const auto lines_of = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    const auto line = (script_ ? lines_of(script_->text) : 0) + lines_of(pending_) + 1;
    return fmt::format("{}{} ", line, pending_.empty() ? '>' : '|');
}

std::vector<std::string> PromptSession::names(const std::string& line) const {
    std::vector<std::string> names;
    if (line.starts_with(":") && line.find(' ') == std::string::npos) {
        for (const Command& command : commands()) names.emplace_back(command.name);
        return names;
    }
    return known_names(script_ ? *script_->program : Program());
}

bool PromptSession::take(const std::string& line) {
    if (pending_.empty()) {
        const std::string_view words = trim(line);
        if (words.starts_with(":")) return obey(words);
        // Words that other prompts accept; none of them is a statement of the language.
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
    const std::string near = nearest_name(name, known);
    fail({fmt::format("there is no command '{}'", name),
          near.empty() ? "':help' lists them" : fmt::format("did you mean '{}'?", near)});
    return true;
}

void PromptSession::add_text(const std::string& text) {
    if (!script_) {
        change(load_script("prompt", text, "."));
        return;
    }
    change(load_script(script_->name, script_->text + text, script_->folder, script_->overrides));
}

/// Takes over a changed script if it has no errors, and continues the simulation with it.
bool PromptSession::change(Script changed) {
    const std::string messages = changed.messages(console_.error().colour);
    if (!changed.program) {
        print_errors(changed);
        return false;
    }
    if (messages != last_warnings_) console_.say(messages);
    auto script = std::make_unique<Script>(std::move(changed));
    script->diagnostics = {};  // They are printed; from now on only new errors count.
    std::unique_ptr<Simulation> simulation;
    if (simulation_) {
        auto carried = carry_over(*script);
        if (!carried) {
            print_errors(*script);
            fail(carried.error());
            return false;
        }
        simulation = std::move(*carried);
    }
    // The old simulation refers to the old script, so it must be destroyed first.
    simulation_ = std::move(simulation);
    script_ = std::move(script);
    last_warnings_ = messages;
    return true;
}

void PromptSession::load(const std::string& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        load_saved(path);
        return;
    }
    auto file = load_script_file(path);
    if (!file) {
        fail(file.error());
        return;
    }
    if (!file->script.text.ends_with('\n') && file->script.program) {
        const Script& read = file->script;
        file->script = load_script(read.name, read.text + "\n", read.folder, read.overrides);
    }
    // A script that is loaded starts anew, even if its stages have the names of the old ones.
    std::unique_ptr<Simulation> before = std::move(simulation_);
    if (!change(std::move(file->script))) {
        simulation_ = std::move(before);
        return;
    }
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
    auto script = std::make_unique<Script>(std::move(*saved));
    auto simulation = Simulation::create(*script, options_);
    Result<void> done;
    if (simulation) done = restore_run(folder, *script, **simulation);
    if (!simulation || !done) {
        fail(simulation ? done.error() : simulation.error());
        return;
    }
    simulation_ = std::move(*simulation);
    script_ = std::move(script);
    tell_place();
}

void PromptSession::set(const std::string& assignment) {
    if (!script_) {
        fail({"there is no script yet", ""});
        return;
    }
    // The last setting of a name wins, so earlier ones need not be kept.
    const auto name = [](std::string_view text) {
        text = text.substr(0, text.find('='));
        const std::size_t begin = text.find_first_not_of(" \t");
        return begin == std::string_view::npos
                   ? ""
                   : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
    };
    Overrides overrides = script_->overrides;
    std::erase_if(overrides.sets,
                  [&](const std::string& set) { return name(set) == name(assignment); });
    overrides.sets.push_back(assignment);
    if (change(load_script(script_->name, script_->text, script_->folder, std::move(overrides))) &&
        is_over()) {
        tell_over();
    }
}

void PromptSession::print_text(const std::string&) {
    if (!script_) return;
    console_.print(script_->text);
    for (const std::string& set : script_->overrides.sets) {
        console_.print(fmt::format("# :set {}\n", set));
    }
}

void PromptSession::forget(const std::string&) {
    simulation_.reset();
    script_.reset();
    last_warnings_.clear();
}

void PromptSession::help(const std::string&) {
    for (const Command& command : commands()) {
        console_.print(fmt::format(
            "  {:<20} {}\n", fmt::format("{} {}", command.name, command.argument), command.about));
    }
    console_.print(
        "Anything else is the language: 'stage s: turing_spots { ka: 1/80 }'. A line that is\n"
        "right is kept; one that is wrong changes nothing.\n");
}

}  // namespace cascade
