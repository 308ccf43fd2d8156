// Detects that a pattern has settled, for `until: steady(e)` (spec/time.md has the reasons).
//
// A pattern forms and then rearranges itself, for a longer time if its plane is larger. The two
// phases differ in the speed at which cells change, relative to the stage's age t: at that speed,
// another time t would change cells by speed · t. This *progress* rises while noise grows or fronts
// spread, is greatest when the pattern forms, and then falls.
#pragma once

#include "core/plane.h"

#include <limits>
#include <span>
#include <vector>

namespace cascade {

/// The formation of one species so far.
struct Formation {
    double least = std::numeric_limits<double>::max();  ///< The smallest progress of its pattern,
    double greatest = 0;                                ///< the greatest,
    double speed = 0;    ///< the speed of its pattern at the greatest,
    bool risen = false;  ///< and whether that was far above the smallest before it.

    bool operator==(const Formation&) const = default;
};

/// Remembers earlier states of a stage and judges the next one.
class SteadyWatch {
public:
    /// Sets the first state of a stage, which is not judged.
    void begin(std::span<const Field> species);

    /// Continues from the last state of an earlier run.
    void remember(std::vector<Field> species, double t, std::vector<Formation> formations);

    /// Judges the species at time t, later than the last call. Returns true if the stage has
    /// settled: the speed of every species, rms(new − old)/Δt, is at most `tolerance` times the
    /// speed of its pattern (the same without the change of the mean) at its greatest progress, and
    /// a species whose progress never rose is also slow relative to its own contrast. The first
    /// call only sets the first state. With a mask `inside`, only cells where it is not 0 count.
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
