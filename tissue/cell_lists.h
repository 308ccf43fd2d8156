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
    /// Builds lists with `skin`, or with a wider skin for fast cells. Refuses lists that take more
    /// than `most_bytes`.
    CellLists(const NeighbourRule& rule, double skin, double most_bytes,
              const TissueSpecies& species, Team& team);

    /// Builds the lists for this state, whose positions must be finite. If `is_full` is true, the
    /// lists stay valid in every step that the limit of movement in one step allows. Throws
    /// std::bad_alloc.
    Result<void> build(const Tissue& tissue, const std::vector<Field>& state, bool is_full);
    /// Builds the lists of the given cells, which are new or have moved in memory. Since the last
    /// search, no other cell may have moved in memory or been changed from outside. Cells may have
    /// been removed if no remaining cell has their index. Throws std::bad_alloc.
    Result<void> renew(const Tissue& tissue, std::span<const std::uint32_t> cells);
    /// Builds new lists for the cells whose slack would not be enough in the next step if they move
    /// as in the last step.
    Result<void> renew_restless(const Tissue& tissue);
    /// Whether the lists are valid in this state, and also if positions differ from this state by
    /// up to and including `around`.
    bool reach(const Tissue& tissue, const std::vector<Field>& state, double around) const;
    /// Whether the lists of these cells are valid at their present positions.
    bool reach(const Tissue& tissue, std::span<const std::uint32_t> cells) const;
    /// Whether so many links lead far away in memory that reordering cells would save time. For a
    /// large tissue, true before the first lists are built.
    bool wants_order(const Tissue& tissue) const;
    /// Reorders the cells. Lists must be built afterwards. Throws std::bad_alloc.
    void put_in_order(Tissue& tissue);
    /// Begins a step with the cells at their present positions.
    void begin_step(const Tissue& tissue);
    /// Ends a step with the cells at their present positions, and records each cell's restlessness.
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
    PlaneLayout layout_;  ///< The layout of the links.
    std::shared_ptr<MovementWatch> watch_ = std::make_shared<MovementWatch>();
    double far_part_ = 0;  ///< The fraction of far links when cells were last reordered.
    bool is_disordered_ = true, is_just_ordered_ = false;
    std::int64_t builds_ = 0;
};

}  // namespace cascade
