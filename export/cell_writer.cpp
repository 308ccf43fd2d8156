// Collects the same arrays for both formats. Each link is written once, with the lower index first.
#include "export/cell_writer.h"

#include "core/check.h"
#include "core/write_encoded.h"
#include "export/model_writer.h"
#include "export/npz_arrays.h"
#include "export/vtp.h"
#include "mesh/normals.h"

#include <cstdint>

namespace cascade {

namespace {

struct PlacesAndNormals {
    std::vector<Vector3d> places, normals;
};

PlacesAndNormals places_and_normals(const SurfaceMesh& mesh, const SurfaceCells& cells) {
    const CornerNormals normals = corner_normals(mesh);
    PlacesAndNormals result;
    for (const SurfacePlace& place : cells.places) {
        result.places.push_back(position_of(mesh, place));
        result.normals.push_back(normals.at(mesh, place));
    }
    return result;
}

struct Link {
    std::uint32_t low = 0, high = 0;
    double weight = 0;
};

/// The pairs of cells with a common Voronoi edge. Each pair appears once.
std::vector<Link> links_of(const SurfaceCells& cells) {
    std::vector<Link> links;
    for (std::uint32_t cell = 0; cell < cells.places.size(); ++cell) {
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            if (edge.neighbour <= cell) continue;
            const double weight = edge.distance > 0 ? edge.length / edge.distance : 0;
            links.push_back({cell, edge.neighbour, weight});
        }
    }
    return links;
}

}  // namespace

Result<std::string> encode_npz(const SurfaceMesh& mesh, const SurfaceCells& cells,
                               const CellResults& results) {
    const PlacesAndNormals at = places_and_normals(mesh, cells);
    const std::size_t count = cells.places.size();
    NpzArrays arrays;
    arrays.add_vectors("points", at.places);
    arrays.add_vectors("normals", at.normals);
    arrays.add<double>("areas", "<f8", count, 1,
                       [&](std::size_t row, std::size_t) { return cells.areas[row]; });
    const std::vector<Link> links = links_of(cells);
    arrays.add<std::uint32_t>("links", "<u4", links.size(), 2,
                              [&](std::size_t row, std::size_t column) {
                                  return column == 0 ? links[row].low : links[row].high;
                              });
    arrays.add<double>("weights", "<f8", links.size(), 1,
                       [&](std::size_t row, std::size_t) { return links[row].weight; });
    if (!results.colours.empty()) arrays.add_colours("colors", results.colours);
    arrays.add_channels(results.channels,
                        {"points", "normals", "areas", "links", "weights", "colors"});
    return encode_zip(arrays.entries());
}

std::string encode_vtp(const SurfaceMesh& mesh, const SurfaceCells& cells,
                       const CellResults& results) {
    const PlacesAndNormals at = places_and_normals(mesh, cells);
    VtpPoints points;
    points.places = at.places;
    points.normals = at.normals;
    points.colours = results.colours;
    points.areas = cells.areas;
    points.channels = results.channels;
    return encode_vtp(points);
}

Result<void> write_cells(const std::filesystem::path& path, const SurfaceMesh& mesh,
                         const SurfaceCells& cells, const CellResults& results) {
    CHECK(results.colours.empty() || results.colours.size() == cells.places.size(),
          "there is a colour for each cell");
    for (const Channel& channel : results.channels) {
        CHECK(channel.values.size() == cells.places.size(), "a channel has a number for each cell");
    }
    return write_encoded(path, [&] { return encode_cells(path, mesh, cells, results); });
}

}  // namespace cascade
