// A kernel without results compares present positions with earlier positions.
#include "tissue/movement_watch.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace cascade {
namespace {

class WatchKernel : public Kernel {
public:
    explicit WatchKernel(std::shared_ptr<MovementWatch> watch) : watch_(std::move(watch)) {}

    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        look(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        look(arguments, cells);
    }

private:
    template <typename Number>
    void look(const KernelArgumentsOf<Number>& arguments, const Patch& cells) const {
        const PlaneLayout& layout = arguments.layout;
        const auto count = static_cast<std::int64_t>(watch_->count());
        for (std::int64_t row = cells.rows.begin; row < cells.rows.end; ++row) {
            const std::int64_t first = row * layout.width;
            const std::int64_t last = std::min(first + layout.width, count);
            for (std::int64_t cell = first; cell < last; ++cell) {
                const std::int64_t at = layout.row_start(row) + cell - first;
                watch_->look(static_cast<std::size_t>(cell),
                             {arguments.fields[0][at], arguments.fields[1][at],
                              arguments.fields[2][at]},
                             arguments.fields[3][at]);
            }
        }
    }

    std::shared_ptr<MovementWatch> watch_;
};

using SpeciesPlane = StepProblem::SpeciesPlane;

}  // namespace

namespace {

/// The part of a slack that may be used. The rest is a margin for rounding.
constexpr double part_for_rounding = 0.98;

double limit_of(const NeighbourRule& rule, double part, double radius) {
    const double extent = slack_of(rule, 1, radius);
    return extent > 0 ? part * extent : std::numeric_limits<double>::infinity();
}

}  // namespace

void MovementWatch::begin_lists(std::span<const Vector3d> places, std::span<const double> radii,
                                const NeighbourRule& rule, std::span<const float> skins) {
    reach_ = rule.reach;
    listed_.clear();
    for (std::size_t k = 0; k < places.size(); ++k) {
        listed_.push_back(
            {places[k], radii[k], limit_of(rule, part_for_rounding * skins[k], radii[k])});
    }
}

void MovementWatch::renew(std::size_t cell, Vector3d place, double radius,
                          const NeighbourRule& rule, double skin) {
    listed_[cell] = {place, radius, limit_of(rule, part_for_rounding * skin, radius)};
}

void MovementWatch::begin_step(std::span<const Vector3d> places, std::span<const double> radii,
                               const NeighbourRule& rule) {
    started_.clear();
    for (std::size_t k = 0; k < places.size(); ++k) {
        started_.push_back({places[k], radii[k], limit_of(rule, most_of_radius, radii[k])});
    }
    left_lists_ = went_too_far_ = false;
}

bool MovementWatch::is_within(const Mark& mark, Vector3d place, double radius,
                              double around) const {
    if (!is_finite(place)) return false;
    const Vector3d way = place - mark.place;
    const double left = mark.limit - around - reach_ * std::max(radius - mark.radius, 0.0);
    return left >= 0 && dot(way, way) <= left * left;
}

double MovementWatch::way_of(std::size_t cell, Vector3d place) const {
    return length(place - started_[cell].place) / started_[cell].limit * most_of_radius;
}

void MovementWatch::look(std::size_t cell, Vector3d place, double radius) {
    if (!is_within(listed_[cell], place, radius)) {
        left_lists_.store(true, std::memory_order_relaxed);
    }
    if (!is_within(started_[cell], place, radius)) {
        went_too_far_.store(true, std::memory_order_relaxed);
    }
}

StepProblem watched(const TissueStep& step, const TissueSpecies& species,
                    std::shared_ptr<MovementWatch> watch) {
    const auto kernel = std::make_shared<WatchKernel>(std::move(watch));
    StepProblem result = *step.problem;
    result.passes.clear();
    std::set<RegisterId> seen{old_register};
    const auto state_of_place = [&](const StepProblem::PlaneRef& ref) -> std::optional<RegisterId> {
        const auto* const own = std::get_if<SpeciesPlane>(&ref);
        if (own == nullptr || own->species != SpeciesId(species.place)) return std::nullopt;
        const auto found = std::find(step.states.begin(), step.states.end(), own->in_register);
        return found == step.states.end() ? std::nullopt : std::optional(*found);
    };
    for (const StepProblem::Pass& pass : step.problem->passes) {
        for (const StepProblem::PlaneRef& ref : pass.fields) {
            const std::optional<RegisterId> state = state_of_place(ref);
            if (!state || !seen.insert(*state).second) continue;
            StepProblem::Pass look;
            look.kernel = kernel;
            for (const std::size_t k :
                 {species.place, species.place + 1, species.place + 2, species.radius}) {
                look.fields.push_back(SpeciesPlane{SpeciesId(k), *state});
            }
            result.passes.push_back(std::move(look));
        }
        for (const StepProblem::Result& written : pass.results) {
            if (const auto state = state_of_place(written.plane)) seen.erase(*state);
        }
        result.passes.push_back(pass);
    }
    return result;
}

}  // namespace cascade
