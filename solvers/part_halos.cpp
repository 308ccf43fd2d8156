// Finds how many passes parts can compute between two exchanges, and the planes that passes read.
#include "solvers/part_halos.h"

#include "solvers/layers_in_memory.h"
#include "solvers/tiling.h"

#include <algorithm>
#include <limits>

namespace cascade {
namespace {

/// With more passes than this between two exchanges, the time spent waiting for messages would
/// hardly fall, and neighbouring parts would compute more layers twice.
constexpr std::int64_t enough_levels = 16;

bool needs_whole_planes(const StepProblem::Pass& pass) {
    return !pass.solves.empty() || !pass.convolutions.empty() || pass.filter;
}

Side divided_side(const Grid& grid) { return grid.depth > 1 ? Side::front : Side::top; }

/// Calls `look` with the rules of each plane that is read at neighbours.
template <typename Look>
void for_all_rules(const StepProblem& problem, const Look& look) {
    for (const SpeciesId id : ids_below<SpeciesId>(problem.species_needs_halo.size())) {
        if (problem.species_needs_halo[id.index()]) look(problem.sides_of(id));
    }
    for (const StepProblem::Pass& pass : problem.passes) {
        for (const StepProblem::Result& result : pass.results) {
            if (result.needs_halo) look(problem.sides_of(result));
        }
    }
}

/// Whether some planes are periodic along the divided axis, and others are not.
bool wraps_in_part(const StepProblem& problem) {
    const Side first = divided_side(problem.grid);
    bool some = false, all = true;
    for_all_rules(problem, [&](const SideRules& rules) {
        for (const Side side : {first, opposite(first)}) {
            const bool is_periodic = rules[side].kind == SideKind::periodic;
            some = some || is_periodic;
            all = all && is_periodic;
        }
    });
    return some && !all;
}

}  // namespace

bool wraps_between_parts(const StepProblem& problem) {
    if (problem.grid.linked) return false;
    bool wraps = false;
    for_all_rules(problem, [&](const SideRules& rules) {
        wraps = wraps || rules[divided_side(problem.grid)].kind == SideKind::periodic;
    });
    return wraps;
}

void fill_across(const StepProblem& problem, std::span<Field> species) {
    if (problem.grid.linked) return;
    for (std::size_t k = 0; k < species.size(); ++k) {
        const SideRules rules = problem.sides_of(SpeciesId(k));
        if (rules[divided_side(problem.grid)].kind == SideKind::periodic) copy_across(species[k]);
    }
}

int levels_of_halo(const StepProblem& problem, std::span<const RowRange> parts,
                   std::int64_t thickness) {
    const std::vector<StepProblem::Pass>& passes = problem.passes;
    if (parts.size() < 2 || std::any_of(passes.begin(), passes.end(), needs_whole_planes)) return 1;
    if (std::all_of(passes.begin(), passes.end(), needs_all_rows)) return 1;
    if (!problem.grid.linked) {
        if (wraps_in_part(problem)) return 1;
        if (wraps_between_parts(problem) && !problem.changing_sides.empty()) return 1;
    }
    std::int64_t thinnest = std::numeric_limits<std::int64_t>::max();
    for (const RowRange& part : parts) thinnest = std::min(thinnest, part.count());
    const std::int64_t layers = thinnest / rows_of_layer(PlaneLayout(problem.grid));
    return static_cast<int>(
        std::clamp<std::int64_t>(layers / (thickness * rows_reached(problem)), 1, enough_levels));
}

void HaloReads::add(Field* plane, std::int64_t width) {
    const auto is_in = [&](const std::vector<Field*>& all) {
        return std::find(all.begin(), all.end(), plane) != all.end();
    };
    if (width == 0 || is_in(written_)) return;
    width_ = std::max(width_, width);
    if (!is_in(planes_)) planes_.push_back(plane);
}

/// Whether some pass reads the plane at neighbours. Scratch registers may be swapped after a step,
/// so the planes of a species in all scratch registers count as one.
bool HaloReads::is_read_at_neighbours(const StepProblem::PlaneRef& ref) const {
    const StepProblem& problem = problem_.get();
    if (!problem.has_halo()) return true;
    const auto is_new = [](RegisterId id) { return id == old_register || id == new_register; };
    const auto is_same = [&](const StepProblem::PlaneRef& other) {
        const auto* const one = std::get_if<StepProblem::SpeciesPlane>(&ref);
        const auto* const two = std::get_if<StepProblem::SpeciesPlane>(&other);
        if (one == nullptr || two == nullptr) return ref == other;
        return one->species == two->species && is_new(one->in_register) == is_new(two->in_register);
    };
    const auto* const own = std::get_if<StepProblem::SpeciesPlane>(&ref);
    if (own != nullptr && is_new(own->in_register) &&
        problem.species_needs_halo[own->species.index()]) {
        return true;
    }
    return std::any_of(
        problem.passes.begin(), problem.passes.end(), [&](const StepProblem::Pass& pass) {
            return std::any_of(pass.results.begin(), pass.results.end(), [&](const auto& result) {
                return result.needs_halo && is_same(result.plane);
            });
        });
}

}  // namespace cascade
