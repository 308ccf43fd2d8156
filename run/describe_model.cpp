#include "run/describe_model.h"

#include "core/with_commas.h"
#include "surface/make_mesh.h"
#include "surface/model_file.h"
#include "surface/relax.h"
#include "surface/scatter.h"
#include "surface/voronoi_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

std::string counted(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", with_commas(static_cast<std::int64_t>(count)), noun,
                       count == 1 ? "" : "s");
}

/// What a closed surface of one piece can be bent into.
std::string kind_of(const MeshFacts& facts) {
    if (facts.boundaries > 0) {
        return fmt::format("{} {}", facts.boundaries, facts.boundaries == 1 ? "boundary" : "boundaries");
    }
    if (facts.pieces > 1) return "closed";
    const std::int64_t holes = 1 - facts.euler_characteristic / 2;
    if (holes == 0) return "closed like a sphere";
    if (holes == 1) return "closed like a torus";
    return fmt::format("closed with {} holes", holes);
}

void describe_mesh(const MadeMesh& made, std::vector<std::string>& lines) {
    const MeshFacts facts = facts_of(made.mesh);
    lines.push_back(fmt::format("{}, {}, {}", counted(facts.points, "point"),
                                counted(facts.triangles, "triangle"),
                                counted(facts.pieces, "piece")));
    lines.push_back(fmt::format("{}, Euler characteristic {}", kind_of(facts),
                                facts.euler_characteristic));
    const Vector3d size = facts.high - facts.low;
    lines.push_back(fmt::format("size {:.4g} × {:.4g} × {:.4g}, area {:.4g}", size.x, size.y, size.z,
                                facts.area));
    std::string kept;
    for (const PointAttribute& attribute : made.mesh.attributes) {
        kept += (kept.empty() ? "" : ", ") + attribute.name;
    }
    if (!made.mesh.texture.empty()) lines.push_back("texture coordinates");
    if (!kept.empty()) lines.push_back("attributes " + kept);
    for (const std::string& repair : made.repairs) lines.push_back("repaired: " + repair);
}

void describe_cells(const SurfaceMesh& mesh, const CellRequest& request, Team& team,
                    const std::atomic<bool>& cancel, std::vector<std::string>& lines) {
    std::vector<SurfacePlace> places =
        scatter(mesh, static_cast<std::size_t>(request.count), request.seed);
    relax(mesh, places, relaxing_rounds, team, cancel);
    const SurfaceCells cells = voronoi_cells(mesh, std::move(places), team, cancel);
    if (cancel) return;
    double sum = 0, squares = 0;
    for (const double area : cells.areas) {
        sum += area;
        squares += area * area;
    }
    const auto count = static_cast<double>(cells.areas.size());
    const double mean = sum / count;
    const double deviation = std::sqrt(std::max(0.0, squares / count - mean * mean));
    lines.push_back(fmt::format("{} of mean area {:.4g}, deviation {:.1f} %, {:.2f} walls each",
                                counted(cells.areas.size(), "cell"), mean, 100 * deviation / mean,
                                static_cast<double>(cells.walls.size()) / count));
    if (cells.bare_area > 0) {
        lines.push_back(fmt::format("{:.2g} % of the surface is too far from any cell",
                                    100 * cells.bare_area / (sum + cells.bare_area)));
    }
}

}  // namespace

Result<std::vector<std::string>> describe_model(const std::filesystem::path& path,
                                                const std::optional<CellRequest>& cells, Team& team,
                                                const std::atomic<bool>& cancel) {
    Result<PolygonSoup> soup = read_model(path);
    if (!soup) return tl::unexpected(soup.error());
    const Result<MadeMesh> made = make_mesh(*std::move(soup));
    if (!made) {
        return failure(fmt::format("'{}': {}", path.string(), made.error().message),
                       made.error().hint);
    }
    std::vector<std::string> lines;
    describe_mesh(*made, lines);
    if (cells) describe_cells(made->mesh, *cells, team, cancel, lines);
    return lines;
}

}  // namespace cascade
