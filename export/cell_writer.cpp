// Collects the same arrays for both formats; each link is written once, from the lower cell.
#include "export/cell_writer.h"

#include "core/check.h"
#include "core/write_encoded.h"
#include "export/model_writer.h"
#include "export/vtp.h"
#include "export/zip.h"
#include "mesh/normals.h"
#include "picture/float_bytes.h"
#include "picture/npy.h"

#include <fmt/format.h>

#include <array>
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

/// The arrays of an archive.
class Arrays {
public:
    /// Adds an array of rows × columns, or of rows if columns is 1; `type` is NumPy's.
    template <typename Number, typename Take>
    void add(const std::string& name, std::string_view type, std::size_t rows, std::size_t columns,
             const Take& take) {
        const std::string shape =
            columns == 1 ? fmt::format("{},", rows) : fmt::format("{}, {}", rows, columns);
        ZipEntry entry{name + ".npy", npy_head(type, shape)};
        entry.bytes.reserve(entry.bytes.size() + rows * columns * sizeof(Number));
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                append_number(entry.bytes, static_cast<Number>(take(row, column)));
            }
        }
        entries_.push_back(std::move(entry));
    }

    void add_vectors(const std::string& name, std::span<const Vector3d> vectors) {
        add<double>(name, "<f8", vectors.size(), 3, [&](std::size_t row, std::size_t column) {
            const Vector3d& v = vectors[row];
            return column == 0 ? v.x : column == 1 ? v.y : v.z;
        });
    }

    std::span<const ZipEntry> entries() const { return entries_; }

private:
    std::vector<ZipEntry> entries_;
};

struct Link {
    std::uint32_t low = 0, high = 0;
    double weight = 0;
};

/// Each Voronoi edge once.
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

Result<std::string> encode(const std::filesystem::path& path, const SurfaceMesh& mesh,
                           const SurfaceCells& cells, const CellResults& results) {
    if (path.extension() == ".npz") return encode_npz(mesh, cells, results);
    if (path.extension() == ".vtp") return encode_vtp(mesh, cells, results);
    return failure("a file of cells has a name that ends in .npz or .vtp");
}

}  // namespace

Result<std::string> encode_npz(const SurfaceMesh& mesh, const SurfaceCells& cells,
                               const CellResults& results) {
    const PlacesAndNormals at = places_and_normals(mesh, cells);
    const std::size_t count = cells.places.size();
    Arrays arrays;
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
    if (!results.colours.empty()) {
        arrays.add<float>("colors", "<f4", count, 3, [&](std::size_t row, std::size_t column) {
            return shown(results.colours[row])[column];
        });
    }
    const std::vector<std::string> names =
        distinct_names(results.channels,
                       {"points", "normals", "areas", "links", "weights", "colors"});
    for (std::size_t c = 0; c < names.size(); ++c) {
        const std::vector<float>& values = results.channels[c].values;
        arrays.add<float>(names[c], "<f4", count, 1,
                          [&](std::size_t row, std::size_t) { return values[row]; });
    }
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
    return write_encoded(path, [&] { return encode(path, mesh, cells, results); });
}

}  // namespace cascade
