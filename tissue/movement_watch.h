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

/// A cell moves by the distance between its positions. Growth counts as approaching others.
class MovementWatch {
public:
    /// The limit of a cell's movement in a step, as a multiple of its radius, or of half the
    /// distance of neighbours if that is larger.
    static constexpr double most_of_radius = 0.5;
    /// With this skin, lists last for every step that is not too long, with a margin for rounding.
    static constexpr double full_skin = 0.52;

    /// Begins lists built with these skins for cells at these positions.
    void begin_lists(std::span<const Vector3d> places, std::span<const double> radii,
                     const NeighbourRule& rule, std::span<const float> skins);
    /// Renews the list of one cell, which may be new, at this position.
    void renew(std::size_t cell, Vector3d place, double radius, const NeighbourRule& rule,
               double skin);
    void resize(std::size_t cells) { listed_.resize(cells); }
    /// Begins a step at these positions.
    void begin_step(std::span<const Vector3d> places, std::span<const double> radii,
                    const NeighbourRule& rule);
    /// Shifts a cell that was put elsewhere without moving, through a periodic side.
    void shift(std::size_t cell, Vector3d by) { listed_[cell].place = listed_[cell].place + by; }

    /// Whether a cell has gone so far since begin_step() that the lists may miss a neighbour.
    bool left_lists() const { return left_lists_.load(std::memory_order_relaxed); }
    /// Whether a cell has gone too far for one step, or its position is not finite.
    bool went_too_far() const { return went_too_far_.load(std::memory_order_relaxed); }
    /// Called by kernels with a cell's position when rates are evaluated.
    void look(std::size_t cell, Vector3d place, double radius);
    /// Whether the lists are valid for a cell at this position, and for some distance around it.
    bool reaches(std::size_t cell, Vector3d place, double radius, double around) const {
        return is_within(listed_[cell], place, radius, around);
    }
    /// A cell's distance from the beginning of the step, as the skin that it would take.
    double way_of(std::size_t cell, Vector3d place) const;
    std::size_t count() const { return listed_.size(); }

private:
    struct Mark {
        Vector3d place;
        double radius = 0;
        double limit = 0;  ///< Infinite if no cell has any extent, so that none has neighbours.
    };
    bool is_within(const Mark& mark, Vector3d place, double radius, double around = 0) const;

    double reach_ = 1;
    std::vector<Mark> listed_, started_;
    std::atomic<bool> left_lists_{false}, went_too_far_{false};
};

/// Inserts a pass that watches positions before each evaluation of rates in the step.
StepProblem watched(const TissueStep& step, const TissueSpecies& species,
                    std::shared_ptr<MovementWatch> watch);

}  // namespace cascade
