// Recognises frames by the form of their names and by the script in their text chunks.
#include "run/pictures/frame_folder.h"

#include "core/file_format.h"
#include "run/script/embedded_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <system_error>

namespace cascade {

namespace {

bool are_digits(std::string_view text, std::size_t least) {
    return text.size() >= least && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Whether frame_name() could return this name.
bool is_frame_name(std::string_view name) {
    if (!name.ends_with(".png")) return false;
    name.remove_suffix(4);
    const std::size_t first = name.find('-'), last = name.rfind('-');
    return first != std::string_view::npos && first < last &&
           are_digits(name.substr(0, first), 4) && are_digits(name.substr(last + 1), 7);
}

std::filesystem::path file_name(const std::string& script) {
    return std::filesystem::path(script).filename();
}

}  // namespace

bool is_called_like_a_movie(const std::filesystem::path& path) {
    if (is_film(path)) return true;
    constexpr std::array<std::string_view, 5> endings = {".mov", ".avi", ".mkv", ".ogv", ".m4v"};
    const std::string ending = lower_ending(path);
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

std::string frame_name(std::size_t number, const std::string& stage, std::int64_t step) {
    return fmt::format("{:04}-{}-{:07}.png", number, stage, step);
}

Result<std::vector<std::filesystem::path>> earlier_frames(const std::filesystem::path& folder,
                                                          const Script& script, bool is_resumed) {
    std::vector<std::filesystem::path> frames;
    std::error_code error;
    // If the folder is missing or cannot be read, an error is reported when frames are written.
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (is_frame_name(entry->path().filename().string())) frames.push_back(entry->path());
    }
    std::sort(frames.begin(), frames.end());
    if (is_resumed && !frames.empty()) {
        return failure(fmt::format("the folder '{}' holds frames of an earlier run",
                                   folder.string()),
                       "name another folder with --frames, because a resumed run numbers its "
                       "frames from the start");
    }
    for (const auto& frame : frames) {
        const auto drawn = read_embedded_script(frame);
        if (drawn && file_name(drawn->name) == file_name(script.name)) continue;
        return failure(fmt::format("the folder '{}' holds frames that {} did not draw, such as {}",
                                   folder.string(), script.name, frame.filename().string()),
                       "name another folder with --frames, or remove them");
    }
    return frames;
}

std::size_t remove_stale_frames(std::span<const std::filesystem::path> earlier,
                                std::span<const std::filesystem::path> written) {
    std::set<std::filesystem::path> fresh;
    for (const auto& path : written) fresh.insert(path.filename());
    std::size_t removed = 0;
    for (const auto& path : earlier) {
        std::error_code error;
        if (!fresh.contains(path.filename()) && std::filesystem::remove(path, error)) ++removed;
    }
    return removed;
}

}  // namespace cascade
