// Reads and writes fields one position of the grid after the other.
#include "run/commands/followed_cells.h"

#include "core/check.h"
#include "run/domain/metric_planes.h"

namespace cascade {

namespace {

using continuation::DomainCells;
using continuation::Vector;

/// Calls a function with the column, row and slice of each position of the grid. The column changes
/// fastest.
void for_each_position(const Grid& grid, const auto& use) {
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) use(i, j, k);
        }
    }
}

std::vector<double> values_of(const Field& field, const Grid& grid) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(grid.cell_count()));
    for_each_position(grid,
                      [&](auto i, auto j, auto k) { values.push_back(field.number_at(i, j, k)); });
    return values;
}

std::vector<double> model_plane(const SimulationDomain& domain, ModelPlane plane) {
    const auto k = static_cast<std::size_t>(plane);
    return values_of(is_made_when_read(plane) ? domain.model->values->plane(plane)
                                              : domain.model->cells->spread().planes[k],
                     domain.grid);
}

std::vector<double> metric_plane(const SimulationDomain& domain, MetricPlane plane) {
    const auto planes = metric_planes(*domain.program);
    CHECK(planes && !planes->empty(), "the run has the metric");
    return values_of((*planes)[static_cast<std::size_t>(plane)], domain.grid);
}

/// Says for each position of the grid whether it is a cell of the domain. Returns an empty list if
/// all positions are.
std::vector<bool> inside_of(const SimulationDomain& domain) {
    const Mask* const mask = domain.model  ? &domain.model->cells->spread().inside
                             : domain.mask ? &domain.mask->inside
                                           : nullptr;
    std::vector<bool> inside;
    if (mask == nullptr) return inside;
    for_each_position(domain.grid,
                      [&](auto i, auto j, auto k) { inside.push_back(mask->at(i, j, k) != 0); });
    return inside;
}

/// Returns the rotations that map a sphere or a torus to itself, about axes through the middle of
/// its box. Each rotation is given by the three components of its velocity in all cells.
std::vector<std::array<std::vector<double>, 3>> turns_of(const SimulationDomain& domain) {
    const ModelShape shape = domain.program->domain.model->shape;
    std::vector<std::size_t> axes;
    if (shape == ModelShape::sphere) axes = {0, 1, 2};
    if (shape == ModelShape::torus) axes = {1};
    std::array<std::vector<double>, 3> place;
    constexpr std::array planes{ModelPlane::place_x, ModelPlane::place_y, ModelPlane::place_z};
    for (std::size_t k = 0; k < 3 && !axes.empty(); ++k) {
        place[k] = model_plane(domain, planes[k]);
    }
    std::vector<std::array<std::vector<double>, 3>> turns;
    for (const std::size_t axis : axes) {
        const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
        std::array<std::vector<double>, 3> velocity;
        velocity[axis].assign(place[0].size(), 0);
        velocity[last] = place[next];
        velocity[next] = place[last];
        for (double& each : velocity[next]) each = -each;
        turns.push_back(std::move(velocity));
    }
    return turns;
}

}  // namespace

DomainCells followed_cells(const Simulation& simulation) {
    const SimulationDomain& domain = simulation.domain();
    DomainCells cells{domain.grid, inside_of(domain), nullptr, {}, {}};
    if (domain.model) {
        cells.links = &domain.model->cells->links_with_gradients();
        cells.areas = model_plane(domain, ModelPlane::area);
        cells.turns = turns_of(domain);
    } else if (domain.program->domain.surface && domain.program->domain.surface->has_metric) {
        cells.areas = metric_plane(domain, MetricPlane::area);
    }
    return cells;
}

std::vector<double> followed_values(const Simulation& simulation, std::uint32_t stage,
                                    const Formula& formula) {
    const SimulationDomain& domain = simulation.domain();
    const Node& node = formula.nodes.back();
    if (const auto* plane = node.as<ModelPlane>()) {
        return model_plane(domain, *plane);
    }
    if (const auto* value = node.as<SurfaceValueId>()) {
        return values_of(domain.model->values->value(*value), domain.grid);
    }
    if (const auto* plane = node.as<MetricPlane>()) return metric_plane(domain, *plane);
    return values_of(simulation.evaluate(formula, stage).front(), domain.grid);
}

Vector followed_state(const Simulation& simulation, std::uint32_t stage) {
    const SimulationDomain& domain = simulation.domain();
    const auto species = domain.program->system_of(stage).species();
    const auto count = static_cast<Eigen::Index>(species.size());
    const std::vector<bool> inside = inside_of(domain);
    Vector state(domain.grid.cell_count() * count);
    Eigen::Index cells = 0;
    for (Eigen::Index s = 0; s < count; ++s) {
        const auto id = species[SpeciesId(static_cast<std::size_t>(s))];
        const std::vector<double> values = values_of(simulation.field(stage, id), domain.grid);
        cells = 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (inside.empty() || inside[k]) state[cells++ * count + s] = values[k];
        }
    }
    return state.head(cells * count);
}

void set_followed_state(Simulation& simulation, std::uint32_t stage, const Vector& state) {
    const SimulationDomain& domain = simulation.domain();
    const std::vector<bool> inside = inside_of(domain);
    simulation.change_stage(stage, [&](StageState& changed) {
        const std::size_t count = changed.species().size();
        for (std::size_t s = 0; s < count; ++s) {
            auto from = static_cast<Eigen::Index>(s);
            std::size_t position = 0;
            double last = 0;
            for_each_position(domain.grid, [&](auto i, auto j, auto k) {
                const bool is_cell = inside.empty() || inside[position++];
                if (is_cell) {
                    last = state[from];
                    from += static_cast<Eigen::Index>(count);
                }
                // In the padding of a model's last row, the last cell is repeated.
                if (is_cell || domain.model) changed.species()[s].at<double>(i, j, k) = last;
            });
        }
    });
}

}  // namespace cascade
