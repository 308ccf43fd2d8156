// Films that the program ffmpeg encodes.
#pragma once

#include "film/film.h"

namespace cascade {

/// Fails, and says what to install, if there is no program ffmpeg in the folders of PATH.
Result<void> find_ffmpeg(const std::filesystem::path& film);

/// Lets ffmpeg encode a white frame of this size, and drops it. Fails at once when `cancel` is set.
Result<void> try_ffmpeg(const std::filesystem::path& film, std::int64_t width, std::int64_t height,
                        const std::atomic<bool>& cancel);

/// A film in MP4 (H.264) or WebM (VP9) of frames like the first. ffmpeg gets the frames through a
/// pipe. Sides of an odd number of pixels get one more, since both formats have colours for squares
/// of two by two: the last row or column once more. A WebM film has alpha if the first frame has
/// it; else frames are laid on white. When `cancel` is set, ffmpeg may go on while it gets on. What
/// it has written is a film only if it holds all frames. Writing fails by a signal unless the
/// program ignores SIGPIPE.
BeginFilm begin_ffmpeg;

}  // namespace cascade
