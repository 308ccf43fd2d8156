// How fast a film is.
#pragma once

namespace cascade {

/// How long the frames of a film are shown.
struct FilmRequest {
    double frames_per_second = 0;  ///< 0 for 10, or what `seconds` gives.
    double seconds = 0;            ///< Of the whole film; 0 for what its frames take.
};

}  // namespace cascade
