// The requested speed of a film.
#pragma once

namespace cascade {

/// The durations of the frames of a film.
struct FilmRequest {
    double frames_per_second = 0;  ///< 0: computed from `seconds`, or 10 if that is 0, too.
    double seconds = 0;            ///< The duration of the whole film. 0: computed from the rate.
};

}  // namespace cascade
