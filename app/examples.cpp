// Finds the folder of the example scripts. This is the folder in the source tree, to which a link
// in the build folder leads, or the folder in which the examples are installed.
#include "app/examples.h"

#include "core/file.h"
#include "core/shared_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace cascade {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t largest_example = 1 << 20;

/// Returns the first sentence of the comment at the beginning of a script, in one line.
std::string first_sentence(std::string_view text) {
    std::string sentence;
    while (text.starts_with('#')) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        line.remove_prefix(std::min(line.find_first_not_of("# "), line.size()));
        if (!sentence.empty()) sentence += ' ';
        sentence += line;
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t stop = sentence.find(". ");
        if (stop != std::string::npos) return sentence.substr(0, stop + 1);
        if (sentence.ends_with('.')) break;
    }
    return sentence;
}

std::size_t depth_of(const std::string& name) {
    return static_cast<std::size_t>(std::count(name.begin(), name.end(), '/'));
}

}  // namespace

Result<std::vector<Example>> read_examples() {
    const fs::path folder = shared_file("examples");
    if (folder.empty()) {
        return failure("this program comes without its examples",
                       "they are in the folder 'examples' of the source tree");
    }
    std::vector<Example> examples;
    std::error_code error;
    for (auto each = fs::recursive_directory_iterator(folder, error);
         !error && each != fs::recursive_directory_iterator(); each.increment(error)) {
        if (each->path().extension() != ".cascade") continue;
        auto text = read_file(each->path(), largest_example);
        if (!text) return tl::unexpected(text.error());
        const std::string name = each->path().lexically_relative(folder).replace_extension();
        std::string about = first_sentence(*text);
        examples.push_back({name, each->path(), std::move(*text), std::move(about)});
    }
    if (error) {
        return failure(
            fmt::format("the folder {} cannot be read: {}", folder.string(), error.message()));
    }
    std::sort(examples.begin(), examples.end(), [](const Example& a, const Example& b) {
        return std::tuple(depth_of(a.name), a.name) < std::tuple(depth_of(b.name), b.name);
    });
    return examples;
}

std::vector<const Example*> examples_named(const std::vector<Example>& examples,
                                           std::string_view name) {
    if (name.ends_with(".cascade")) name.remove_suffix(8);
    std::vector<const Example*> found;
    for (const Example& example : examples) {
        if (example.name == name) return {&example};
        if (fs::path(example.name).filename() == name) found.push_back(&example);
    }
    return found;
}

std::vector<fs::path> files_read_by(const Example& example) {
    // A script names files in quotes. Any other text in quotes is skipped, because no file has its
    // name.
    std::vector<fs::path> files;
    std::error_code unknown;
    for (std::size_t at = 0; (at = example.text.find('"', at)) != std::string::npos;) {
        const std::size_t end = example.text.find('"', ++at);
        if (end == std::string::npos) break;
        const fs::path path = fs::path(example.text.substr(at, end - at)).lexically_normal();
        const bool is_inside = path.is_relative() && !path.empty() && *path.begin() != "..";
        const bool is_new = std::find(files.begin(), files.end(), path) == files.end();
        if (is_inside && is_new &&
            fs::is_regular_file(example.file.parent_path() / path, unknown)) {
            files.push_back(path);
        }
        at = end + 1;
    }
    return files;
}

}  // namespace cascade
