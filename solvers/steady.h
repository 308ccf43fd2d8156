// Detects that a pattern has settled, for `until: steady(e)` (spec/time.md has the reasons).
//
// A pattern forms and then rearranges itself, for a longer time if its plane is larger. The two
// phases differ in the *progress* speed · t: by how much cells would change if they went on at
// their present speed for as long as the stage has already run. Progress rises while noise grows or
// fronts spread, is greatest when the pattern forms, and then falls.
#pragma once

#include "core/plane.h"

#include <limits>
#include <span>
#include <vector>

namespace cascade {

/// The formation of one species so far.
struct Formation {
    double least = std::numeric_limits<double>::max();  ///< The smallest progress of its pattern.
    double greatest = 0;                                ///< The greatest progress of its pattern.
    double speed = 0;  ///< The speed of its pattern at the greatest progress.
    bool risen =
        false;  ///< Whether the greatest progress was far above the smallest progress before it.

    bool operator==(const Formation&) const = default;
};

/// Stores earlier states of a stage and judges the next state.
class SteadyWatch {
public:
    /// Sets the first state of a stage. No judgement is made for this state.
    void begin(std::span<const Field> species);

    /// Continues from the last state of an earlier run.
    void remember(std::vector<Field> species, double t, std::vector<Formation> formations);

    /// Judges the species at time t, which must be later than in the last call. Returns true if the
    /// stage has settled. The speed of a species is rms(new − old)/Δt. The speed of its pattern
    /// leaves out the change of the mean. A species has settled if its speed is at most `tolerance`
    /// times the speed that its pattern had at the greatest progress. If the progress never rose,
    /// the species must also be slow relative to its own contrast. The first call only sets the
    /// first state. With a mask `inside`, only cells where the mask is not 0 count.
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
