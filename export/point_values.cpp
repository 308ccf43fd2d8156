// Each point becomes a position in its first triangle. Threads filter ranges of positions.
#include "export/point_values.h"

namespace cascade {

std::vector<SurfacePlace> places_of_points(const SurfaceMesh& mesh) {
    std::vector<SurfacePlace> places(mesh.points.size());
    // The loop runs backwards, so that each point gets its first triangle.
    for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
        for (std::size_t k = 0; k < 3; ++k) {
            SurfacePlace& place = places[mesh.triangles[t][k]];
            place.triangle = static_cast<std::uint32_t>(t);
            place.weights = {0, 0, 0};
            place.weights[k] = 1;
        }
    }
    return places;
}

std::vector<Channel> values_at(std::span<const SurfacePlace> places, const CellFilter& filter,
                               std::span<const Channel> cells, Team& team) {
    std::vector<Channel> result;
    for (const Channel& channel : cells) {
        result.push_back({channel.name, std::vector<float>(places.size())});
    }
    team.run([&](int index) {
        const RowRange mine =
            split_rows(static_cast<std::int64_t>(places.size()), index, team.size());
        std::vector<CellShare> shares;
        for (auto p = static_cast<std::size_t>(mine.begin); p < static_cast<std::size_t>(mine.end);
             ++p) {
            filter.shares(places[p], shares);
            for (std::size_t c = 0; c < cells.size(); ++c) {
                float sum = 0;
                for (const CellShare& share : shares) {
                    sum += share.weight * cells[c].values[share.cell];
                }
                result[c].values[p] = sum;
            }
        }
    });
    return result;
}

}  // namespace cascade
