// Counts the frames of a film that another program has written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace cascade {

/// The number of frames in an MP4 file with one track or in a WebM file. Empty if the file is
/// empty, incomplete or in another format. Does not decode pixels.
std::optional<std::int64_t> frames_in_film(const std::filesystem::path& path, bool is_webm);

}  // namespace cascade
