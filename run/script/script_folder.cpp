#include "run/script/script_folder.h"

#include "core/granted_files.h"
#include "lang/syntax/parse.h"

#include <array>

namespace cascade {

namespace fs = std::filesystem;

std::string portable_path(const std::string& path) {
    const fs::path normal = fs::path(path).lexically_normal();
    const bool leads_down = normal.is_relative() && (normal.empty() || *normal.begin() != "..");
    return leads_down ? path : normal.filename().string();
}

fs::path find_script_folder(const fs::path& saved, const std::string& name,
                            const std::string& text) {
    struct Place {
        fs::path folder;
        std::string name;
    };
    const fs::path here = fs::path(portable_path(name));
    const fs::path above = (saved / "..").lexically_normal();
    for (const Place& place : {Place{".", here.string()}, Place{above, here.filename().string()}}) {
        if (place.name.empty()) continue;
        const auto found = GrantedFiles(place.folder, {}).read(place.name, largest_script);
        if (found && *found == text) return (place.folder / place.name).parent_path();
    }
    return saved;
}

}  // namespace cascade
