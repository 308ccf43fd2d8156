// Keeps the neighbours of a tissue's cells up to date, and the cells in a cache-friendly order.
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
    /// Builds lists with `skin`, wider for fast cells, and refuses lists of more than `most_bytes`.
    CellLists(const NeighbourRule& rule, double skin, double most_bytes,
              const TissueSpecies& species, Team& team);

    /// Builds the lists for this state, whose positions must be finite. `is_full`: lists that last
    /// for every step that is not too long. Throws std::bad_alloc.
    Result<void> build(const Tissue& tissue, const std::vector<Field>& state, bool is_full);
    /// Finds the lists of these cells, which are new or have moved in memory. Since the last
    /// search, no other cell may have moved in memory or changed from outside. Cells may have been
    /// removed if no remaining cell has their index. Throws std::bad_alloc.
    Result<void> renew(const Tissue& tissue, std::span<const std::uint32_t> cells);
    /// Renews the lists of cells that will outrun them in the next step if they go on as in the
    /// last one.
    Result<void> renew_restless(const Tissue& tissue);
    /// Whether the lists are valid within `around` of all cells in this state.
    bool reach(const Tissue& tissue, const std::vector<Field>& state, double around) const;
    /// Whether they are valid for these cells now.
    bool reach(const Tissue& tissue, std::span<const std::uint32_t> cells) const;
    /// Whether enough links lead far away in memory for another order to save time. True before the
    /// first lists of a large tissue.
    bool wants_order(const Tissue& tissue) const;
    /// Reorders the cells, after which lists must be built. Throws std::bad_alloc.
    void put_in_order(Tissue& tissue);
    /// Begins a step at the present positions.
    void begin_step(const Tissue& tissue);
    /// Ends a step at the present positions and records how restless the cells are.
    void end_step(Tissue& tissue);

    const Links& links() const { return links_; }
    const std::shared_ptr<MovementWatch>& watch() const { return watch_; }
    /// The cells' mean radius at the beginning of the last step.
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
    PlaneLayout layout_;  ///< The links' layout.
    std::shared_ptr<MovementWatch> watch_ = std::make_shared<MovementWatch>();
    double far_part_ = 0;  ///< The part of far links when cells were last reordered.
    bool is_disordered_ = true, is_just_ordered_ = false;
    std::int64_t builds_ = 0;
};

}  // namespace cascade
