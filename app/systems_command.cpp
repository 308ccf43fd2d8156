// `cascade systems` and `cascade new`: what there is to begin with.
#include "app/commands.h"

#include "app/exit_status.h"
#include "core/file.h"
#include "core/near_name.h"
#include "lang/equations.h"
#include "lang/library_note.h"
#include "lang/system_listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace cascade {

namespace {

const System* find_system(const Script& script, std::string_view name) {
    const System* found = nullptr;  // The script's own takes the place of the library's.
    for (const System& system : script.program->systems) {
        if (system.name == name && (found == nullptr || !system.built_in)) found = &system;
    }
    return found;
}

/// Everything about a system: where it is from, its equations, species, parameters and settings.
void print_system(const Script& script, const System& system, Console& console) {
    console.print(fmt::format("{}{}\n", system.name,
                              system.built_in ? "" : fmt::format(" ({})", script.name)));
    const LibraryText* const text = system.built_in ? find_library_text(system.name) : nullptr;
    std::vector<std::string> words = text ? note_of(*text).lines : std::vector<std::string>{};
    for (std::string& line : system_words(script.tree, script.sources, system.name)) {
        words.push_back(std::move(line));
    }
    for (const std::string& line : words) console.print("  " + line + "\n");
    if (!words.empty()) console.print("\n");
    console.print(print_equations(script.tree, script.sources, system.name, Notation::unicode,
                                  EquationParts::rates) +
                  "\n" + print_system_listing(script.tree, script.sources, system.name));
}

/// One line of a list, cut where a terminal ends.
void print_line(std::string_view name, std::string_view about, Console& console) {
    std::string line = fmt::format("{:<24} {}", name, about);
    const auto columns = static_cast<std::size_t>(console.out().columns());
    if (console.out().is_terminal && line.size() > columns) {
        std::size_t end = columns > 2 ? columns - 2 : 0;
        while (end > 0 && (line[end] & 0xc0) == 0x80) --end;  // Not inside a character.
        line = line.substr(0, end) + "…";
    }
    console.print(line + "\n");
}

std::vector<std::string> library_names() {
    std::vector<std::string> names;
    for (const LibraryText& text : library_texts()) names.emplace_back(text.system_name());
    return names;
}

Failure unknown_system(std::string_view name) {
    const std::string near = nearest_name(name, library_names());
    return {fmt::format("no system is called '{}'", name),
            near.empty() ? "'cascade systems' lists them" : fmt::format("did you mean '{}'?", near)};
}

/// A list of those of the library that all words are found in. False if there is none.
bool print_matches(const std::vector<std::string>& words, Console& console) {
    bool found = false;
    for (const LibraryText& text : library_texts()) {
        const LibraryNote note = note_of(text);
        const bool matches = std::all_of(words.begin(), words.end(), [&](const std::string& word) {
            return note.mentions(word);
        });
        if (!matches) continue;
        print_line(text.system_name(), note.about, console);
        found = true;
    }
    return found;
}

bool is_script_path(const std::string& word) {
    std::error_code error;
    return word == "-" || word.find('.') != std::string::npos ||
           word.find('/') != std::string::npos || std::filesystem::is_regular_file(word, error);
}

}  // namespace

int systems_command(const Options& options, Console& console) {
    std::vector<std::string> words = options.words;
    const bool has_script = !words.empty() && is_script_path(words.front());
    // A script with nothing of its own has the whole library.
    LoadedFile file{load_script("<built in>", "domain { grid: 64, 64 }", "."), ""};
    if (has_script) {
        auto given = load(words.front(), {}, console);
        if (!given) return exit_status::wrong_script;
        file = std::move(*given);
        words.erase(words.begin());
    }
    const Script& script = file.script;
    console.say(script.messages(console.error().colour));
    if (!script.program) return exit_status::wrong_script;
    if (words.size() == 1) {
        if (const System* system = find_system(script, words.front())) {
            print_system(script, *system, console);
            return exit_status::success;
        }
    }
    if (!has_script) {
        if (print_matches(words, console)) return exit_status::success;
        Failure failure = unknown_system(words.front());
        failure.message += ", and none mentions it";
        if (words.size() > 1) failure.message = "no system mentions all these words";
        console.fail(failure);
        return exit_status::wrong_use;
    }
    if (!words.empty()) {
        console.fail({fmt::format("no system of {} is called '{}'", script.name, words.front()), ""});
        return exit_status::wrong_use;
    }
    std::string_view between;
    for (const System& system : script.program->systems) {
        console.print(between);
        print_system(script, system, console);
        between = "\n";
    }
    return exit_status::success;
}

int new_command(const Options& options, Console& console) {
    const std::string& name = options.words.front();
    const LibraryText* const text = find_library_text(name);
    if (text == nullptr) {
        console.fail(unknown_system(name));
        return exit_status::wrong_use;
    }
    const std::string script = starting_script(*text);
    if (options.new_script.empty()) {
        console.print(script);
        return exit_status::success;
    }
    std::error_code error;
    if (std::filesystem::exists(options.new_script, error)) {
        console.fail({fmt::format("{} is there already", options.new_script.string()),
                      "a script to start from replaces no file"});
        return exit_status::failed_run;
    }
    if (auto done = write_file(options.new_script, script); !done) {
        console.fail(done.error());
        return exit_status::failed_run;
    }
    console.print(fmt::format("wrote {}\n", options.new_script.string()));
    return exit_status::success;
}

}  // namespace cascade
