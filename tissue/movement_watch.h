// Watches how far cells move within a step, at every evaluation of the rates.
#pragma once

#include "core/vector3.h"
#include "ir/backend.h"
#include "solvers/step_problem.h"
#include "tissue/neighbours.h"
#include "tissue/tissue_rules.h"

#include <atomic>
#include <memory>
#include <span>
#include <vector>

namespace cascade {

/// Measures how far cells move. A cell's movement is the distance between its earlier and its
/// present position, plus its growth, because a growing cell approaches other cells, too.
class MovementWatch {
public:
    /// The limit of a cell's movement in a step, as a multiple of slack_of() for a skin of 1.
    static constexpr double most_of_radius = 0.5;
    /// With this skin, lists stay valid in every step in which no cell moves farther than
    /// `most_of_radius` allows. Includes a margin for rounding.
    static constexpr double full_skin = 0.52;

    /// Must be called when lists have been built with these skins, for cells at these positions.
    void begin_lists(std::span<const Vector3d> places, std::span<const double> radii,
                     const NeighbourRule& rule, std::span<const float> skins);
    /// Must be called when the list of one cell has been built at this position. The cell may be
    /// new.
    void renew(std::size_t cell, Vector3d place, double radius, const NeighbourRule& rule,
               double skin);
    void resize(std::size_t cells) { listed_.resize(cells); }
    /// Begins a step at these positions.
    void begin_step(std::span<const Vector3d> places, std::span<const double> radii,
                    const NeighbourRule& rule);
    /// Records that a cell was moved by this vector from a periodic side to the opposite side. Such
    /// a shift does not count as a movement.
    void shift(std::size_t cell, Vector3d by) { listed_[cell].place = listed_[cell].place + by; }

    /// Whether a cell has moved so far since begin_step() that its list may miss a neighbour.
    bool left_lists() const { return left_lists_.load(std::memory_order_relaxed); }
    /// Whether a cell has moved too far for one step, or its position is not finite.
    bool went_too_far() const { return went_too_far_.load(std::memory_order_relaxed); }
    /// Called by kernels with a cell's position when rates are evaluated.
    void look(std::size_t cell, Vector3d place, double radius);
    /// Whether the list of a cell is valid at this position, and at all positions within a distance
    /// `around` of it.
    bool reaches(std::size_t cell, Vector3d place, double radius, double around) const {
        return is_within(listed_[cell], place, radius, around);
    }
    /// The movement of a cell since the beginning of the step, expressed as the smallest skin with
    /// which its list would stay valid.
    double way_of(std::size_t cell, Vector3d place) const;
    std::size_t count() const { return listed_.size(); }

private:
    struct Mark {
        Vector3d place;
        double radius = 0;
        /// The limit of movement. Infinite if no cell has any extent, because such cells have no
        /// neighbours.
        double limit = 0;
    };
    bool is_within(const Mark& mark, Vector3d place, double radius, double around = 0) const;

    double reach_ = 1;
    std::vector<Mark> listed_, started_;
    std::atomic<bool> left_lists_{false}, went_too_far_{false};
};

/// A step with an additional pass before each evaluation of rates. This pass calls the watch with
/// the positions of all cells.
StepProblem watched(const TissueStep& step, const TissueSpecies& species,
                    std::shared_ptr<MovementWatch> watch);

}  // namespace cascade
