// Has a pattern settled? What `until: steady(e)` measures (spec/time.md says why).
#pragma once

#include "core/plane.h"

#include <span>
#include <vector>

namespace cascade {

/// The change of the species from `before` to `now`, which lie `time` apart, per unit of time and in
/// units of the pattern itself: rms(now − before) / (time · (deviation over the cells + 10⁻⁶ rms)),
/// the largest over the species. 0 for a species that is 0 everywhere and stays so. Of the cells where
/// `inside` is not 0, the others being 0; of all where there is none.
double relative_change_rate(std::span<const Field> before, std::span<const Field> now, double time,
                            const Mask* inside = nullptr);

/// Remembers the species of the last look and judges the next.
class SteadyWatch {
public:
    /// Goes on from a look of an earlier run.
    void remember(std::vector<Field> species, double t);

    /// Looks at the species at time t. True where, if they went on to change as they did since the
    /// last look for as long again as the stage has run, they would change by no more than
    /// `tolerance` times their own deviation. Never at the first look.
    bool settled(std::span<const Field> species, double t, double tolerance,
                 const Mask* inside = nullptr);

    std::span<const Field> last() const { return last_; }
    double last_time() const { return last_time_; }

private:
    std::vector<Field> last_;
    double last_time_ = 0;
};

}  // namespace cascade
