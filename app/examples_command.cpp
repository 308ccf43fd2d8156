// The command `cascade examples` lists the examples, prints one, or copies one.
#include "app/commands.h"
#include "app/examples.h"
#include "app/exit_status.h"
#include "core/file.h"
#include "core/near_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace cascade {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
    for (char& letter : text)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return text;
}

/// Returns the examples whose name or description contains all words.
std::vector<const Example*> mentioning(const std::vector<Example>& examples,
                                       const std::vector<std::string>& words) {
    std::vector<const Example*> found;
    for (const Example& example : examples) {
        const std::string all = lower(example.name + " " + example.about);
        if (std::all_of(words.begin(), words.end(), [&](const std::string& word) {
                return all.find(lower(word)) != std::string::npos;
            })) {
            found.push_back(&example);
        }
    }
    return found;
}

/// Explains why a name or words select no example.
Failure unknown_example(const std::vector<Example>& examples,
                        const std::vector<std::string>& words) {
    if (words.empty()) {
        return {"the name of an example is missing", "'cascade examples' lists the names"};
    }
    const std::string all = fmt::format("{}", fmt::join(words, " "));
    std::vector<std::string> meant, names;
    for (const Example* example : examples_named(examples, all)) meant.push_back(example->name);
    if (!meant.empty()) {
        return {fmt::format("several examples are called '{}'", all),
                fmt::format("write {}", fmt::join(meant, " or "))};
    }
    for (const Example& example : examples) {
        names.push_back(example.name);
        names.push_back(fs::path(example.name).filename());
    }
    const std::string near = nearest_name(all, names);
    const bool is_mentioned = !mentioning(examples, words).empty();
    return {fmt::format("no example is called '{}'{}", all,
                        is_mentioned ? "" : ", and none mentions it"),
            !near.empty() ? fmt::format("did you mean '{}'?", near)
            : is_mentioned
                ? fmt::format("'cascade examples {}' lists the examples that mention it", all)
                : "'cascade examples' lists the names"};
}

/// Copies the script of an example to `target`, and the files that it reads to the same folder. If
/// any copy would replace a file, copies nothing.
Result<std::vector<fs::path>> copy_example(const Example& example, const fs::path& target) {
    std::vector<std::pair<fs::path, fs::path>> copies = {{example.file, target}};
    for (const fs::path& file : files_read_by(example)) {
        copies.emplace_back(example.file.parent_path() / file, target.parent_path() / file);
    }
    std::error_code unknown;
    for (const auto& [from, to] : copies) {
        if (!fs::exists(to, unknown)) continue;
        return failure(fmt::format("{} already exists", to.string()),
                       "choose another name: an example never replaces a file");
    }
    std::vector<fs::path> written;
    for (const auto& [from, to] : copies) {
        constexpr std::uint64_t largest = 1 << 26;
        const auto bytes = read_file(from, largest);
        if (!bytes) return tl::unexpected(bytes.error());
        if (to.parent_path() != target.parent_path()) {
            if (auto made = make_folder(to.parent_path()); !made)
                return tl::unexpected(made.error());
        }
        if (auto done = write_file(to, *bytes); !done) return tl::unexpected(done.error());
        written.push_back(to);
    }
    return written;
}

int show_example(const Example& example, const Options& options, Console& console) {
    if (options.prints_path) {
        console.print(example.file.string() + "\n");
        return exit_status::success;
    }
    if (options.new_script.empty()) {
        console.print_exactly(example.text);
        if (const auto files = files_read_by(example); !files.empty()) {
            console.note(fmt::format("{} reads {}; 'cascade examples {} -o FILE' copies it, too",
                                     example.name, files.front().string(), example.name));
        }
        return exit_status::success;
    }
    const auto written = copy_example(example, options.new_script);
    if (!written) {
        console.fail(written.error());
        return exit_status::failed_run;
    }
    for (const fs::path& path : *written) console.print(fmt::format("wrote {}\n", path.string()));
    return exit_status::success;
}

}  // namespace

int examples_command(const Options& options, Console& console) {
    const auto examples = read_examples();
    if (!examples) {
        console.fail(examples.error());
        return exit_status::failed_run;
    }
    const std::vector<std::string>& words = options.words;
    if (words.size() == 1) {
        const auto named = examples_named(*examples, words.front());
        if (named.size() == 1) return show_example(*named.front(), options, console);
    }
    const bool needs_one = options.prints_path || !options.new_script.empty();
    const auto found = mentioning(*examples, words);
    if (needs_one || found.empty()) {
        console.fail(unknown_example(*examples, words));
        return exit_status::wrong_use;
    }
    for (const Example* example : found) print_list_line(example->name, example->about, console);
    return exit_status::success;
}

}  // namespace cascade
