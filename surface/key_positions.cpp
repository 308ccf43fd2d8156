// Each cell takes the value of the nearest key. Diffusion then smooths the borders.
#include "surface/key_positions.h"

#include "surface/distance.h"
#include "surface/graph_diffusion.h"
#include "surface/nearest_place.h"

#include <algorithm>
#include <limits>

namespace cascade {

namespace {

const KeyValue& nearest_in_space(const std::vector<KeyValue>& keys, Vector3d position) {
    return *std::min_element(keys.begin(), keys.end(), [&](const KeyValue& a, const KeyValue& b) {
        return length(a.position - position) < length(b.position - position);
    });
}

}  // namespace

std::vector<double> nearest_key_values(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                       std::span<const KeyValue> keys,
                                       const std::atomic<bool>& cancel) {
    const NearestPlace nearest(mesh);
    std::vector<SurfacePlace> places;
    std::vector<KeyValue> placed;
    for (const KeyValue& key : keys) {
        const auto place = nearest.find(key.position);
        if (!place) continue;
        places.push_back(*place);
        placed.push_back(key);
    }
    std::vector<double> values(cells.places.size());
    if (placed.empty()) return values;
    const SurfaceDistance distance(mesh, places, cancel);
    // In a component without a key, all cells get the value of the key nearest to the component's
    // first cell.
    std::vector<std::uint32_t> components;
    std::vector<const KeyValue*> chosen;
    for (std::size_t cell = 0; cell < values.size() && !cancel; ++cell) {
        const SurfacePlace& place = cells.places[cell];
        const std::uint32_t source = distance.at(place).source;
        if (source != SurfaceDistance::no_source) {
            values[cell] = placed[source].value;
            continue;
        }
        if (components.empty()) {
            components = connected_components(mesh);
            chosen.resize(1 + *std::max_element(components.begin(), components.end()));
        }
        const KeyValue*& key = chosen[components[place.triangle]];
        if (!key) key = &nearest_in_space(placed, position_of(mesh, place));
        values[cell] = key->value;
    }
    return values;
}

std::vector<double> smoothed(const SurfaceCells& cells, std::vector<double> values, double length,
                             Team& team, const std::atomic<bool>& cancel) {
    if (values.empty()) return values;
    DiffusionGraph<double> graph;
    graph.masses = cells.areas;
    graph.ends = cells.ends;
    graph.links.reserve(cells.edges.size());
    for (const VoronoiEdge& edge : cells.edges) {
        const double weight = edge.distance > 0 ? edge.length / edge.distance : 0;
        graph.links.push_back({edge.neighbour, weight, weight});
    }
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double least = *low, largest = *high;
    // Diffusion for a time t has the variance 2t.
    values = diffused(graph, std::move(values), length * length / 2, team, cancel);
    for (double& value : values) value = std::clamp(value, least, largest);
    return values;
}

}  // namespace cascade
