// The folder that --frames fills: what lies in it already, and how a movie is made of it.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Is a path called like a movie, which a folder should not be? Its ending is .mp4, .gif, .webm or
/// another of that kind.
bool is_called_like_a_movie(const std::filesystem::path& path);
/// The commands that make a movie of that name: for a hint.
std::string how_to_make_a_movie(const std::filesystem::path& path);

/// "0012-large-0003400.png": the name of frame `number`.
std::string frame_name(std::size_t number, const std::string& stage, std::int64_t step);

/// The frames of an earlier run of a script of the same name that the folder holds: those that are
/// to go when new ones have been written. Fails if there are frames that another script drew, or
/// that nobody knows, or any at all where the run goes on with a saved one (`is_resumed`). Other
/// files do not matter.
Result<std::vector<std::filesystem::path>> earlier_frames(const std::filesystem::path& folder,
                                                          const Script& script, bool is_resumed);

/// Removes those of `earlier` that have not been written again. Returns their number.
std::size_t remove_stale_frames(std::span<const std::filesystem::path> earlier,
                                std::span<const std::filesystem::path> written);

}  // namespace cascade
