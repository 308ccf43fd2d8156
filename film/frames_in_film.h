// How many frames a film holds that another program has written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace cascade {

/// The frames of an MP4 file with one track, or of a WebM file. Nothing if the file is empty, cut
/// or another one. Pixels are not decoded.
std::optional<std::int64_t> frames_in_film(const std::filesystem::path& path, bool is_webm);

}  // namespace cascade
