// Converts between the order of cells in memory and the cells' own order.
#include "run/domain/tensor_links.h"

#include "run/domain/cell_planes.h"

namespace cascade {

namespace {

TensorConduction conduction_on(const ModelCells& model) {
    Team team(hardware_threads());
    const SpreadCells& spread = model.spread();
    return {model.mesh,
            spread.cells,
            cell_frames(model.mesh, spread.cells),
            conduction_of(spread.cells, spread.are_spread, spread.unit),
            team,
            never_cancelled};
}

}  // namespace

TensorLinks::TensorLinks(const ModelCells& model)
    : model_(model), conduction_(conduction_on(model)) {
    LinkList list;
    list.ends = conduction_.ends();
    for (const VoronoiEdge& link : conduction_.links()) list.neighbours.push_back(link.neighbour);
    list.weights = conduction_.isotropic();
    links_ = Links(list, PlaneLayout(model.grid()), model.spread().links.precision(),
                   model.spread().order);
}

const Links& TensorLinks::links_with_gradients() const {
    std::call_once(has_gradients_, [&] {
        const std::vector<Vector3d> of_edges = model_.gradient_weights();
        std::vector<Vector3d> gradients;
        auto next = of_edges.begin();
        for (const VoronoiEdge& link : conduction_.links())
            gradients.push_back(link.length > 0 ? *next++ : Vector3d{});
        links_with_gradients_ =
            links_.with_gradients(gradients, conduction_.ends(), PlaneLayout(model_.grid()),
                                  model_.spread().order);
    });
    return links_with_gradients_;
}

std::vector<double> TensorLinks::by_cell(const Field& plane) const {
    std::vector<double> values(model_.count());
    for_each_place(model_.grid(), model_.spread().order,
                   [&](std::int64_t row, std::int64_t i, std::size_t cell, bool is_cell) {
                       if (is_cell) values[cell] = plane.number_at(i, row);
                   });
    return values;
}

Field TensorLinks::weights(const Field& low, const Field& right, const Field& down) const {
    const std::vector<double> to_right = by_cell(right), downwards = by_cell(down);
    std::vector<Vector2d> along;
    for (std::size_t cell = 0; cell < to_right.size(); ++cell)
        along.push_back({to_right[cell], downwards[cell]});
    return links_.numbers_of(conduction_.weights(by_cell(low), along), conduction_.ends(),
                             PlaneLayout(model_.grid()), model_.spread().order);
}

}  // namespace cascade
