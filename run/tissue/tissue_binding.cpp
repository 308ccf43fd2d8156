// A separate kernel computes the values that plans read at the crawling cells from planes of the
// domain.
#include "run/tissue/tissue_binding.h"

#include "run/stage/plan_runner.h"

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

/// Returns the links between the cells of a tissue, in the order in which memory stores the cells.
Result<Links> links_between(const Tissue& tissue, const TissueStage& stage,
                            const NeighbourRule& rule, Team& team) {
    const auto number = [&](SpeciesId species, std::size_t cell) {
        return tissue.value(species.index(), cell);
    };
    std::vector<Vector3d> places;
    std::vector<double> radii;
    const SpeciesId radius = stage.species_of(stage.rules().radius);
    for (std::size_t cell = 0; cell < tissue.count(); ++cell) {
        const auto component = [&](std::size_t k) {
            return number(stage.species_of(stage.rules().place, k), cell);
        };
        places.push_back({component(0), component(1), component(2)});
        radii.push_back(std::max(0.0, number(radius, cell)));
    }
    constexpr double skin = 0.01, most_links = 1e9;
    auto lists = find_neighbours({places, radii, tissue.ranks()}, rule, skin, most_links, team);
    if (!lists) return tl::unexpected(lists.error());
    Links links;
    links.assign({lists->ends, lists->neighbours}, tissue.layout(), tissue.precision());
    return links;
}

}  // namespace

bool reads_links(const StepPlan& plan) {
    const auto is_link = [](const Instruction& each) { return each.op == Op::theirs; };
    return std::ranges::any_of(plan.passes, [&](const Pass& pass) {
        const auto& code = pass.bound.kernel->code;
        return std::any_of(code.begin(), code.end(), is_link);
    });
}

TissueBinding binding_of(const TissueStage& stage, const Tissue& tissue,
                         std::span<const StepPlan* const> plans,
                         std::shared_ptr<NearTriangles> near) {
    TissueBinding binding;
    binding.count = static_cast<std::int64_t>(tissue.count());
    binding.numbers = &tissue.number_plane();
    binding.ones = &tissue.ones();
    for (std::size_t k = 0; k < 3; ++k) {
        binding.place[k] = {stage.stage, ItemId(stage.rules().place.index() + k)};
    }
    binding.sensed = sensed_by(plans);
    std::vector<Sense> senses;
    for (const PlaneSource& source : binding.sensed) {
        senses.push_back(stage.ground.sense_of(source, stage.fields));
    }
    const PlaneLayout& layout = tissue.layout();
    binding.sense = make_sense_kernel(stage.ground.surroundings(), std::move(senses),
                                      std::move(near), layout.width * layout.height);
    return binding;
}

NeighbourRule neighbours_of(const TissueStage& stage, double near) {
    return {stage.rules().reach, near, stage.ground.surroundings()->period()};
}

Result<std::vector<Field>> evaluate_in(const Tissue& tissue, const StepPlan& plan,
                                       const TissueStage& stage, const NeighbourRule& rule,
                                       const Compile& compile, Team& team) {
    auto near = std::make_shared<NearTriangles>();
    near->before = near->now = tissue.triangles;
    const StepPlan* const plans[] = {&plan};
    TissueBinding binding = binding_of(stage, tissue, plans, std::move(near));
    Links links;
    if (reads_links(plan)) {
        auto made = links_between(tissue, stage, rule, team);
        if (!made) return tl::unexpected(made.error());
        links = std::move(*made);
        binding.links = &links;
    }
    BindingContext context = stage.fields;
    context.grid = tissue.grid();
    context.tissue = &binding;
    return run_plan(plan, compile, context, tissue.grid(), team);
}

}  // namespace cascade
