// The speed that the options request for a film.
#pragma once

namespace cascade {

/// The requested speed of a film, from which the durations of its frames follow.
struct FilmRequest {
    /// 0: computed from `seconds`. If that is 0, too, the rate is 10.
    double frames_per_second = 0;
    /// The duration of the whole film. 0: computed from the frames per second.
    double seconds = 0;
};

}  // namespace cascade
