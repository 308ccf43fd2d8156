// What a change changes shows where the start, computed anew, gives the cells other values.
#include "run/session/kept_cells.h"

#include "tissue/tissue.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

namespace {

using Values = std::vector<double>;

class CellChange {
public:
    CellChange(Simulation& simulation, std::uint32_t stage, const KeptStage& kept)
        : simulation_(simulation), stage_(stage), kept_(kept), record_(*kept.record.cells) {}

    Result<void> make(const Simulation* before, const StageMoment& moment) {
        take_values();
        restore(moment);
        const auto now = simulation_.values_of_start(stage_);
        if (now.empty() && !missing_.empty() && !record_.numbers.empty()) {
            return failure(fmt::format("'{}' is new, and cells that were born since stage '{}' "
                                       "began have no value to start with",
                                       system().item_name(missing_[0]), kept_.name),
                           "go back to the start of the stage, and change it there");
        }
        if (now.empty()) return {};
        for (const ItemId item : missing_) values_of(item) = now[item.index()];
        const auto then =
            before != nullptr ? before->values_of_start(stage_of(*before)) : std::vector<Values>();
        for (const ItemId item : system().items()) {
            if (is_changed(item, now, then)) values_of(item) = now[item.index()];
        }
        restore(moment);
        return {};
    }

private:
    void restore(const StageMoment& moment) {
        StageRecord record{moment, {}, std::make_shared<const TissueRecord>(record_)};
        simulation_.restore(stage_, std::move(record));
    }

    const System& system() const { return simulation_.program().system_of(stage_); }
    Values& values_of(ItemId item) {
        const auto species = system().species_of(item);
        return species ? record_.species[species->index()] : record_.kept[item.index()];
    }

    /// The place of an item among all items that were kept, or their number.
    std::size_t kept_item(ItemId item) const {
        const auto found = std::ranges::find(kept_.items, system().item_name(item));
        return static_cast<std::size_t>(found - kept_.items.begin());
    }

    /// The values that have been kept by this name; none if it was the same in all cells.
    Values kept_values(ItemId item) const {
        const auto found = std::ranges::find(kept_.species, system().item_name(item));
        const auto species = static_cast<std::size_t>(found - kept_.species.begin());
        if (species < kept_.species.size()) return kept_.record.cells->species[species];
        const std::size_t other = kept_item(item);
        return other < kept_.items.size() ? kept_.record.cells->kept[other] : Values();
    }

    void take_values() {
        record_.species.assign(system().species_count(), {});
        record_.kept.assign(system().item_count(), {});
        for (const ItemId item : system().items()) {
            const bool varies = !simulation_.program().stages[stage_].uniform[item];
            if (!system().is_species(item) && !varies) continue;
            values_of(item) = kept_values(item);
            if (!values_of(item).empty()) continue;
            missing_.push_back(item);
            values_of(item).resize(record_.numbers.size());
        }
        const std::size_t frozen = system().frozen_item().index();
        record_.frozen.reset();
        if (!record_.kept[frozen].empty()) record_.frozen = frozen;
        // Lengths of steps are chosen anew.
        record_.stiffest.clear();
        record_.time.control = {};
        record_.time.stiffness = 0;
        record_.time.estimated_at = -1;
    }

    /// The number that the kept stage has in its program.
    std::uint32_t stage_of(const Simulation& before) const {
        const auto& stages = before.program().stages;
        const auto found = std::ranges::find(stages, kept_.name, &Stage::name);
        return static_cast<std::uint32_t>(found - stages.begin());
    }

    /// Does a parameter start with other values than it did?
    bool is_changed(ItemId item, const std::vector<Values>& now,
                    const std::vector<Values>& then) const {
        const auto& restarts = system().cells->restarts;
        const bool starts_again = item < restarts.next() && !restarts[item].nodes.empty();
        if (system().is_species(item) || starts_again || now[item.index()].empty()) return false;
        if (kept_.painted.contains(std::string(system().item_name(item)))) return false;
        const std::size_t old = kept_item(item);
        return old < then.size() && then[old] != now[item.index()];
    }

    Simulation& simulation_;
    std::uint32_t stage_;
    const KeptStage& kept_;
    TissueRecord record_;
    std::vector<ItemId> missing_;  ///< Those that had no values.
};

}  // namespace

Result<void> go_on_with_cells(Simulation& simulation, const Simulation* before, std::uint32_t stage,
                              const KeptStage& kept, const StageMoment& moment) {
    return CellChange(simulation, stage, kept).make(before, moment);
}

}  // namespace cascade
