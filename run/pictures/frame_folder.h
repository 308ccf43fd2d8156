// The folder of --frames, and earlier frames in it.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// True if the path has the ending of a movie (.mp4, .gif, .webm …), which a folder should not.
bool is_called_like_a_movie(const std::filesystem::path& path);

/// "0012-large-0003400.png": the name of frame `number`.
std::string frame_name(std::size_t number, const std::string& stage, std::int64_t step);

/// The frames of an earlier run of a script with the same name in the folder. They are removed
/// after new ones have been written. Fails if there are frames of another script or of unknown
/// origin, or any at all if the run is resumed. Other files are ignored.
Result<std::vector<std::filesystem::path>> earlier_frames(const std::filesystem::path& folder,
                                                          const Script& script, bool is_resumed);

/// Removes those of `earlier` that were not written again. Returns their number.
std::size_t remove_stale_frames(std::span<const std::filesystem::path> earlier,
                                std::span<const std::filesystem::path> written);

}  // namespace cascade
