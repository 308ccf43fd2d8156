// The commands `cascade systems` and `cascade new` show the systems of the library and of scripts.
#include "app/commands.h"

#include "app/exit_status.h"
#include "app/json_answer.h"
#include "core/file.h"
#include "core/near_name.h"
#include "core/printable.h"
#include "lang/equations/equations.h"
#include "lang/print/library_note.h"
#include "lang/print/system_listing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace cascade {

namespace {

const System* find_system(const Script& script, std::string_view name) {
    // A system of the script hides a system of the library with the same name.
    const System* found = nullptr;
    for (const System& system : script.program->systems) {
        if (system.name == name && (found == nullptr || !system.built_in)) found = &system;
    }
    return found;
}

/// Adds the members of --json that describe a system.
void answer_with(std::string_view name, std::string_view about, Console& console) {
    if (JsonAnswer* const all = console.answer()) {
        nlohmann::ordered_json system = {{"name", name}};
        if (!about.empty()) system["about"] = about;
        (*all)["systems"].push_back(std::move(system));
    }
}

/// Prints the description, equations, species, parameters and settings of a system. If `script`
/// does not define the system, uses the definition in the library.
void print_system(std::string_view title, const ast::Script& script, const Sources& sources,
                  std::string_view name, const LibraryText* text, Console& console) {
    console.print(fmt::format("{}\n", title));
    std::vector<std::string> words = text ? note_of(*text).lines : std::vector<std::string>{};
    for (std::string& line : system_words(script, sources, name)) words.push_back(std::move(line));
    for (const std::string& line : words) console.print("  " + line + "\n");
    if (!words.empty()) console.print("\n");
    console.print(print_equations(script, sources, name, Notation::unicode, EquationParts::rates) +
                  "\n" + print_system_listing(script, sources, name));
}

void print_library_system(const LibraryText& text, Console& console) {
    print_system(text.system_name(), {}, {}, text.system_name(), &text, console);
}

void print_system(const Script& script, const System& system, Console& console) {
    answer_with(system.name, "", console);
    const LibraryText* const text = system.built_in ? find_library_text(system.name) : nullptr;
    print_system(text ? system.name : fmt::format("{} ({})", system.name, printable(script.name)),
                 script.tree, script.sources, system.name, text, console);
}

std::vector<std::string> library_names() {
    std::vector<std::string> names;
    for (const auto texts : {library_texts(), library_cells(), library_shapes()}) {
        for (const LibraryText& text : texts) names.emplace_back(text.system_name());
    }
    return names;
}

/// Returns the description of a system or shape of the library.
LibraryNote note_of_name(std::string_view name) {
    const LibraryText* const system = find_library_text(name);
    return note_of(system != nullptr ? *system : *find_shape_text(name));
}

Failure unknown_system(std::string_view name) {
    const std::string near = nearest_name(name, library_names());
    return {fmt::format("no system is called '{}'", name),
            near.empty() ? "'cascade systems' lists them"
                         : fmt::format("did you mean '{}'?", near)};
}

/// Returns the systems of the library that contain all `words`.
std::vector<std::string> matches(const std::vector<std::string>& words) {
    std::vector<std::string> names;
    for (const std::string& name : library_names()) {
        const LibraryNote note = note_of_name(name);
        const bool mentions_all =
            std::all_of(words.begin(), words.end(),
                        [&](const std::string& word) { return note.mentions(word); });
        if (mentions_all) names.push_back(name);
    }
    return names;
}

bool is_script_path(const std::string& word) {
    std::error_code error;
    return word == "-" || word.find('.') != std::string::npos ||
           word.find('/') != std::string::npos || std::filesystem::is_regular_file(word, error);
}

}  // namespace

namespace {

/// Returns a hint for a word that occurs in no system. The hint names systems that contain the
/// longest possible beginning of the word. This beginning must have at least four letters.
std::string hint_by_beginning(const std::string& word) {
    constexpr std::size_t fewest_letters = 4, most_named = 6;
    for (std::size_t letters = word.size(); letters-- > fewest_letters;) {
        const std::string beginning = word.substr(0, letters);
        const std::vector<std::string> names = matches({beginning});
        if (names.empty() || names.size() > most_named) continue;
        return fmt::format("'{}' is mentioned by {}; 'cascade systems' lists all", beginning,
                           fmt::join(names, ", "));
    }
    return "'cascade systems' lists them";
}

/// Implements `cascade systems [WORDS]`.
int search_library(const std::vector<std::string>& words, Console& console) {
    if (words.size() == 1) {
        if (const LibraryText* text = find_library_text(words.front())) {
            answer_with(words.front(), note_of(*text).about, console);
            print_library_system(*text, console);
            return exit_status::success;
        }
        if (const LibraryText* text = find_shape_text(words.front())) {
            answer_with(words.front(), note_of(*text).about, console);
            console.print(text->text);
            return exit_status::success;
        }
    }
    const std::vector<std::string> found = matches(words);
    for (const std::string& name : found) {
        answer_with(name, note_of_name(name).about, console);
        print_list_line(name, note_of_name(name).about, console);
    }
    if (!found.empty()) return exit_status::success;
    Failure failure = unknown_system(words.front());
    failure.message += ", and none mentions it";
    if (words.size() > 1) failure.message = "no system mentions all these words";
    else if (nearest_name(words.front(), library_names()).empty())
        failure.hint = hint_by_beginning(words.front());
    console.fail(failure);
    return exit_status::wrong_use;
}

/// Implements `cascade systems SCRIPT [NAME]`.
int show_systems_of(const Script& script, const std::vector<std::string>& names, Console& console) {
    console.tell(script);
    if (!script.program) return exit_status::wrong_script;
    if (!names.empty()) {
        const System* const system =
            names.size() == 1 ? find_system(script, names.front()) : nullptr;
        if (system == nullptr) {
            console.fail(
                {fmt::format("no system of {} is called '{}'", script.name, names.front()), ""});
            return exit_status::wrong_use;
        }
        print_system(script, *system, console);
        return exit_status::success;
    }
    std::string_view between;
    for (const System& system : script.program->systems) {
        console.print(between);
        print_system(script, system, console);
        between = "\n";
    }
    return exit_status::success;
}

}  // namespace

int systems_command(const Options& options, Console& console) {
    const std::vector<std::string>& words = options.words;
    if (words.empty() || !is_script_path(words.front())) return search_library(words, console);
    const auto file = load(words.front(), {}, console);
    if (!file) return exit_status::wrong_script;
    return show_systems_of(file->script, {words.begin() + 1, words.end()}, console);
}

int new_command(const Options& options, Console& console) {
    const std::string& name = options.words.front();
    const LibraryText* text = find_library_text(name);
    if (text == nullptr) text = find_shape_text(name);
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
        console.fail({fmt::format("{} already exists", options.new_script.string()),
                      "choose another name: 'cascade new' never replaces a file"});
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
