// Has a pattern settled? What `until: steady(e)` measures (spec/time.md says why).
//
// A pattern forms, and then it goes on rearranging itself, the longer the larger its plane is. The
// two are told apart by the speed at which cells change, and by what that speed means at the
// stage's age t: speed · t is how far the stage would go if it went on so for as long again as it
// has run. This *progress* rises while noise grows or fronts spread, is greatest when the pattern
// comes into being, and falls behind it.
#pragma once

#include "core/plane.h"

#include <limits>
#include <span>
#include <vector>

namespace cascade {

/// How one species has come into being so far.
struct Formation {
    double least = std::numeric_limits<double>::max();  ///< The smallest progress of its pattern,
    double greatest = 0;                                ///< the greatest,
    double speed = 0;                                   ///< the speed of its pattern then,
    bool risen = false;  ///< and whether that was far above the smallest before.

    bool operator==(const Formation&) const = default;
};

/// Remembers what it saw of a stage, and judges its next state.
class SteadyWatch {
public:
    /// The state of a stage as it begins: nothing is judged.
    void begin(std::span<const Field> species);

    /// Goes on from a look of an earlier run.
    void remember(std::vector<Field> species, double t, std::vector<Formation> formations);

    /// Looks at the species at time t, later than the last look. True where the speed of every
    /// species, rms(new − old)/Δt, is at most `tolerance` times the speed of its pattern (the same
    /// without the change of the mean) when that made the greatest progress; a species whose
    /// progress never rose has to be slow by its own contrast as well. Where there was no look
    /// before, this is the first and nothing is judged. With a mask `inside` the cells count where
    /// it is not 0.
    bool settled(std::span<const Field> species, double t, double tolerance,
                 const Mask* inside = nullptr);

    std::span<const Field> last() const { return last_; }
    double last_time() const { return last_time_; }
    std::span<const Formation> formations() const { return formations_; }

private:
    void keep(std::span<const Field> species, double t);

    std::vector<Field> last_;
    double last_time_ = 0;
    std::vector<Formation> formations_;
};

}  // namespace cascade
