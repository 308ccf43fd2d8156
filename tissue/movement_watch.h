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

/// A cell moves by the distance between its places; growth counts as the way by which it comes
/// nearer to others.
class MovementWatch {
public:
    /// No cell may move farther in a step than this multiple of its radius, or of half the distance
    /// of neighbours if that is larger.
    static constexpr double most_of_radius = 0.5;
    /// With this skin, lists last for every step that is not too long. A part of the slack is left
    /// for rounding.
    static constexpr double full_skin = 0.52;

    /// Lists have been built with these skins for cells at these places.
    void begin_lists(std::span<const Vector3d> places, std::span<const double> radii,
                     const NeighbourRule& rule, std::span<const float> skins);
    /// The list of one cell, which may be a new one, has been found again at this place.
    void renew(std::size_t cell, Vector3d place, double radius, const NeighbourRule& rule,
               double skin);
    /// Sets the number of cells.
    void resize(std::size_t cells) { listed_.resize(cells); }
    /// A step begins at these places.
    void begin_step(std::span<const Vector3d> places, std::span<const double> radii,
                    const NeighbourRule& rule);
    /// A cell was put elsewhere without having moved, through a periodic side.
    void shift(std::size_t cell, Vector3d by) { listed_[cell].place = listed_[cell].place + by; }

    /// Since begin_step(): has a cell gone so far that the lists may miss a neighbour?
    bool left_lists() const { return left_lists_.load(std::memory_order_relaxed); }
    /// Has one gone too far for one step, or to a place that is not finite?
    bool went_too_far() const { return went_too_far_.load(std::memory_order_relaxed); }
    /// Called by kernels: a cell is at this place when rates are evaluated.
    void look(std::size_t cell, Vector3d place, double radius);
    /// Do the lists hold for a cell at this place, and for some way around it?
    bool reaches(std::size_t cell, Vector3d place, double radius, double around) const {
        return is_within(listed_[cell], place, radius, around);
    }
    /// How far a cell has gone from where the step began, as a skin that it would take.
    double way_of(std::size_t cell, Vector3d place) const;
    std::size_t count() const { return listed_.size(); }

private:
    struct Mark {
        Vector3d place;
        double radius = 0;
        double limit = 0;  ///< Infinite where no cell has any extent, so that none has neighbours.
    };
    bool is_within(const Mark& mark, Vector3d place, double radius, double around = 0) const;

    double reach_ = 1;
    std::vector<Mark> listed_, started_;
    std::atomic<bool> left_lists_{false}, went_too_far_{false};
};

/// The step's passes with one before each evaluation of rates that watches the places there.
StepProblem watched(const TissueStep& step, const TissueSpecies& species,
                    std::shared_ptr<MovementWatch> watch);

}  // namespace cascade
