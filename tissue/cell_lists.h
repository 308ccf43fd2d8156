// Keeps the neighbours of a tissue's cells up to date, and the cells in an order that memory likes.
#pragma once

#include "core/links.h"
#include "core/parallel.h"
#include "core/result.h"
#include "tissue/kept_lists.h"
#include "tissue/movement_watch.h"
#include "tissue/tissue.h"
#include "tissue/tissue_rules.h"

#include <memory>
#include <span>
#include <vector>

namespace cascade {

class CellLists {
public:
    /// Lists are built with `skin`, with a wider one for cells that move fast, and refused if they
    /// would take more than `most_bytes`.
    CellLists(const NeighbourRule& rule, double skin, double most_bytes,
              const TissueSpecies& species, Team& team);

    /// Builds the lists for cells at the places of this state, which must be finite. `is_full`: so
    /// that they last for every step that is not too long. Throws std::bad_alloc.
    Result<void> build(const Tissue& tissue, const std::vector<Field>& state, bool is_full);
    /// Finds the lists of these cells anew, which are new or elsewhere. No other cell has moved in
    /// memory or changed from outside since lists were found, but cells may have gone of which none
    /// of the others has the place. Throws std::bad_alloc.
    Result<void> renew(const Tissue& tissue, std::span<const std::uint32_t> cells);
    /// The same for cells that will leave their lists in the next step if they go on as in the last
    /// one.
    Result<void> renew_restless(const Tissue& tissue);
    /// Do the lists hold for all cells in this state, and for some way around their places?
    bool reach(const Tissue& tissue, const std::vector<Field>& state, double around) const;
    /// Do they hold for these cells at the present?
    bool reach(const Tissue& tissue, std::span<const std::uint32_t> cells) const;
    /// Do enough links lead far away in memory for another order to save time? True before
    /// the first lists of a large tissue.
    bool wants_order(const Tissue& tissue) const;
    /// Puts the cells in a better order, after which lists must be built. Throws std::bad_alloc.
    void put_in_order(Tissue& tissue);
    /// A step begins at the present places,
    void begin_step(const Tissue& tissue);
    /// and leads to the present ones. Notes how restless the cells are.
    void end_step(Tissue& tissue);

    const Links& links() const { return links_; }
    const std::shared_ptr<MovementWatch>& watch() const { return watch_; }
    /// The mean radius of the cells when the last step began.
    double mean_radius() const { return mean_radius_; }
    std::int64_t builds() const { return builds_; }

private:
    void read(const Tissue& tissue, const std::vector<Field>& state);
    void take(const Tissue& tissue, const std::vector<bool>& changed);
    double most_links() const;
    double skin_of(const Tissue& tissue, std::size_t cell, double least) const;

    NeighbourRule rule_;
    double skin_, most_bytes_, mean_radius_ = 0;
    TissueSpecies species_;
    Team& team_;
    std::vector<Vector3d> places_;
    std::vector<double> radii_;
    std::vector<float> skins_;
    KeptLists kept_;
    Links links_;
    PlaneLayout layout_;  ///< Of the links.
    std::shared_ptr<MovementWatch> watch_ = std::make_shared<MovementWatch>();
    double far_part_ = 0;  ///< Of the links, when cells were last put in order.
    bool is_disordered_ = true, is_just_ordered_ = false;
    std::int64_t builds_ = 0;
};

}  // namespace cascade
