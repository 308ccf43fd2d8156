// The folder of --frames, and the frames of earlier runs in it.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Whether a path ends like the name of a film (.mp4, .gif, .webm …). The path of a folder should
/// not end so.
bool is_called_like_a_movie(const std::filesystem::path& path);

/// Returns the name of frame `number`, such as "0012-large-0003400.png".
std::string frame_name(std::size_t number, const std::string& stage, std::int64_t step);

/// Returns the frames in the folder that an earlier run of a script with the same name has written.
/// They will be removed after the new frames have been written. Fails if the folder has frames of
/// another script or of unknown origin. Also fails if the run is resumed and the folder has any
/// frames. Other files are ignored.
Result<std::vector<std::filesystem::path>> earlier_frames(const std::filesystem::path& folder,
                                                          const Script& script, bool is_resumed);

/// Removes the files of `earlier` that are not among `written`. Returns their number.
std::size_t remove_stale_frames(std::span<const std::filesystem::path> earlier,
                                std::span<const std::filesystem::path> written);

}  // namespace cascade
