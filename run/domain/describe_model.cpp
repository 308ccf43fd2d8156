// Reads and repairs models in the same way as a run does. Computes the genus from the Euler
// characteristic. Measures how evenly cells are spread by their areas and by the distances to their
// nearest neighbours.
#include "run/domain/describe_model.h"

#include "atlas/texture_facts.h"
#include "core/counted.h"
#include "core/quantities.h"
#include "mesh/make_mesh.h"
#include "mesh/model_file.h"
#include "run/domain/free_memory.h"
#include "surface/tips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// Returns the name of a closed surface to which a component is homeomorphic. If the component is
/// not closed, returns the number of its boundaries.
std::string kind_of(const MeshFacts& facts) {
    if (facts.boundaries > 0) {
        return counted(facts.boundaries, "boundary", "boundaries");
    }
    if (facts.components > 1) return "closed";
    const std::int64_t holes = 1 - facts.euler_characteristic / 2;
    if (holes == 0) return "closed like a sphere";
    if (holes == 1) return "closed like a torus";
    return fmt::format("closed with {} holes", holes);
}

}  // namespace

std::string describe_texture(const SurfaceMesh& mesh) {
    const TextureFacts facts = texture_facts(mesh);
    std::string line =
        fmt::format("texture coordinates: {}, {:.1f} % of the texture covered",
                    counted(static_cast<std::int64_t>(facts.charts), "chart"), 100 * facts.covered);
    const auto add = [&](double part, std::string_view what) {
        if (part >= 5e-4) line += fmt::format(", {:.1f} % {}", 100 * part, what);
    };
    add(facts.shared, "of it several times");
    add(facts.mirrored, "of the surface mirrored");
    line += fmt::format("; lengths change by a factor of {:.2f} in the mean and {:.1f} at most",
                        facts.mean, facts.worst);
    return line;
}

std::vector<std::string> describe_model(const MadeMesh& made) {
    std::vector<std::string> lines;
    const MeshFacts facts = facts_of(made.mesh);
    lines.push_back(fmt::format("{}, {}, {}", counted(facts.points, "point"),
                                counted(facts.triangles, "triangle"),
                                counted(facts.components, "connected component")));
    lines.push_back(
        fmt::format("{}, Euler characteristic {}", kind_of(facts), facts.euler_characteristic));
    const Vector3d size = facts.high - facts.low;
    lines.push_back(fmt::format("size {:.4g} × {:.4g} × {:.4g}, area {:.4g}", size.x, size.y,
                                size.z, facts.area));
    std::string kept;
    for (const PointAttribute& attribute : made.mesh.attributes) {
        kept += (kept.empty() ? "" : ", ") + attribute.name;
    }
    if (!made.mesh.texture.empty()) lines.push_back(describe_texture(made.mesh));
    if (!kept.empty()) lines.push_back("attributes " + kept);
    for (const std::string& repair : made.repairs) lines.push_back("repaired: " + repair);
    return lines;
}

std::vector<std::string> describe_points(const SurfaceMesh& mesh, const std::atomic<bool>& cancel) {
    const SurfaceMesh::Box box = mesh.box();
    const Vector3d size = box.high - box.low;
    const double longest = std::max({size.x, size.y, size.z});
    std::vector<std::string> lines{"points (x, y, z of distance, keys and along):"};
    const auto add = [&](const std::string& name, Vector3d position) {
        const Vector3d at = (position - box.low) * (1 / longest);
        lines.push_back(fmt::format("  {:<8} {:.4f}, {:.4f}, {:.4f}", name, at.x, at.y, at.z));
    };
    const auto extreme = [&](const char* name, double Vector3d::*axis, bool is_most) {
        const auto [least, most] = std::ranges::minmax_element(mesh.points, {}, axis);
        add(name, is_most ? *most : *least);
    };
    extreme("left", &Vector3d::x, false);
    extreme("right", &Vector3d::x, true);
    extreme("bottom", &Vector3d::y, false);
    extreme("top", &Vector3d::y, true);
    extreme("back", &Vector3d::z, false);
    extreme("front", &Vector3d::z, true);
    int number = 0;
    for (const Vector3d& tip : tips_of(mesh, cancel)) add(fmt::format("tip {}", ++number), tip);
    return lines;
}

namespace {

struct MeanAndDeviation {
    double mean = 0;
    double deviation = 0;  ///< The standard deviation as a percentage of the mean.
};

MeanAndDeviation mean_and_deviation(const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (const double value : values) {
        sum += value;
        squares += value * value;
    }
    const auto count = static_cast<double>(values.size());
    const double mean = sum / count;
    return {mean, 100 * std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean};
}

Result<void> check_memory_of_cells(const SurfaceMesh& mesh, const CellOptions& options) {
    const double needed = memory_of_cells(mesh, options);
    const auto free = static_cast<double>(available_memory());
    if (free == 0 || needed <= free) return {};
    return failure(fmt::format("{} need about {}, but {} are free",
                               counted(count_cells(mesh, options), "cell"), with_unit(needed, "B"),
                               with_unit(free, "B")),
                   "use fewer cells");
}

}  // namespace

Result<std::vector<std::string>> describe_cells(const SurfaceMesh& mesh, const CellOptions& options,
                                                Team& team, const std::atomic<bool>& cancel) {
    if (Result<void> fits = check_memory_of_cells(mesh, options); !fits) {
        return tl::unexpected(fits.error());
    }
    const Result<SurfaceCells> cells = make_cells(mesh, options, team, cancel);
    if (!cells) return tl::unexpected(cells.error());
    std::vector<std::string> lines;
    if (cancel) return lines;
    const MeanAndDeviation areas = mean_and_deviation(cells->areas);
    lines.push_back(fmt::format(
        "{} of mean area {:.4g}, deviation {:.1f} %, {:.2f} neighbours each",
        counted(cells->areas.size(), "cell"), areas.mean, areas.deviation,
        static_cast<double>(cells->edges.size()) / static_cast<double>(cells->areas.size())));
    std::vector<double> nearest;
    for (std::size_t cell = 0; cell < cells->areas.size(); ++cell) {
        const auto edges = cells->edges_of(cell);
        if (edges.empty()) continue;
        nearest.push_back(
            std::min_element(edges.begin(), edges.end(), [](const auto& a, const auto& b) {
                return a.distance < b.distance;
            })->distance);
    }
    if (!nearest.empty()) {
        const MeanAndDeviation distances = mean_and_deviation(nearest);
        lines.push_back(fmt::format("the nearest neighbour {:.4g} away, deviation {:.1f} %",
                                    distances.mean, distances.deviation));
    }
    return lines;
}

Result<MadeMesh> read_and_repair(const std::filesystem::path& path, const ReadAccess& access) {
    Result<PolygonSoup> soup = read_model(path, access);
    if (!soup) return tl::unexpected(soup.error());
    Result<MadeMesh> made = make_mesh(*std::move(soup));
    if (made) return made;
    return failure(fmt::format("'{}': {}", path.string(), made.error().message), made.error().hint);
}

}  // namespace cascade
