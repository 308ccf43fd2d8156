// Looks in two folders for files with the name of the script, and recognises the script by its
// text.
#include "run/script/script_folder.h"

#include "core/granted_files.h"
#include "lang/syntax/parse.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace cascade {

namespace fs = std::filesystem;

std::string portable_path(const std::string& path) {
    const fs::path normal = fs::path(path).lexically_normal();
    const bool leads_down = normal.is_relative() && (normal.empty() || *normal.begin() != "..");
    return leads_down ? path : normal.filename().string();
}

namespace {

struct Namesake {
    fs::path folder;
    std::string name, text;
};

/// Returns the files with this name in the current folder and in the folder that contains the saved
/// run.
std::vector<Namesake> namesakes(const fs::path& saved, const std::string& name) {
    const fs::path here = fs::path(portable_path(name));
    const fs::path above = (saved / "..").lexically_normal();
    std::vector<Namesake> found;
    for (Namesake each :
         {Namesake{".", here.string(), ""}, Namesake{above, here.filename().string(), ""}}) {
        if (each.name.empty()) continue;
        auto text = GrantedFiles(each.folder, {}).read(each.name, largest_script);
        if (!text) continue;
        each.text = *std::move(text);
        found.push_back(std::move(each));
    }
    return found;
}

}  // namespace

fs::path find_script_folder(const fs::path& saved, const std::string& name,
                            const std::string& text) {
    for (const Namesake& each : namesakes(saved, name)) {
        if (each.text == text) return (each.folder / each.name).parent_path();
    }
    return saved;
}

std::optional<fs::path> find_edited_script(const fs::path& saved, const std::string& name,
                                           const std::string& text) {
    const std::vector<Namesake> found = namesakes(saved, name);
    const bool is_unchanged = std::any_of(found.begin(), found.end(),
                                          [&](const Namesake& each) { return each.text == text; });
    if (found.empty() || is_unchanged) return std::nullopt;
    return (found.front().folder / found.front().name).lexically_normal();
}

}  // namespace cascade
