// Validates the options, then calls the function for each kind of cells.
#include "surface/make_cells.h"

#include "core/counted.h"
#include "core/with_commas.h"
#include "surface/cells_by_copy.h"
#include "surface/face_cells.h"
#include "surface/scatter.h"
#include "surface/vertex_cells.h"
#include "surface/voronoi_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr std::uint64_t most_cells = 0xfffffffe;

Result<void> check_anisotropy(const SurfaceMesh& mesh, const Anisotropy& anisotropy) {
    const std::size_t count = mesh.triangles.size();
    if (anisotropy.direction.size() != count || anisotropy.ratio.size() != count) {
        return failure(
            fmt::format("a surface of {} triangles is stretched by {} directions and {} "
                        "ratios",
                        count, anisotropy.direction.size(), anisotropy.ratio.size()));
    }
    for (std::size_t t = 0; t < count; ++t) {
        const double ratio = anisotropy.ratio[t];
        if (!(ratio >= 1 && ratio <= Anisotropy::largest_ratio)) {
            return failure(fmt::format("cells of triangle {} are to be {} times as long as wide", t,
                                       ratio),
                           fmt::format("ratios are 1 … {}", Anisotropy::largest_ratio));
        }
        if (!std::isfinite(dot(anisotropy.direction[t], anisotropy.direction[t]))) {
            return failure(fmt::format("the direction of cells of triangle {} is not finite", t));
        }
    }
    return {};
}

Result<void> check_count(const SurfaceMesh& mesh, std::uint64_t count) {
    if (count < 1 || count > most_cells) {
        return failure(fmt::format("a surface cannot have {} cells", count),
                       fmt::format("the number of cells is 1 … {}", most_cells));
    }
    const std::vector<std::uint32_t> components = connected_components(mesh);
    const std::uint64_t needed =
        *std::max_element(components.begin(), components.end()) + std::uint64_t{1};
    if (count >= needed) return {};
    return failure(fmt::format("{} cannot cover a surface of {} connected components",
                               counted(count, "cell"), with_commas(needed)),
                   fmt::format("use {} cells or more, or join components", with_commas(needed)));
}

}  // namespace

std::uint64_t count_cells(const SurfaceMesh& mesh, const CellOptions& options) {
    switch (options.kind) {
        case CellKind::places: return options.count;
        case CellKind::vertices: return mesh.points.size();
        case CellKind::faces: break;
    }
    std::vector<std::uint32_t> faces = mesh.faces;
    std::sort(faces.begin(), faces.end());
    const auto end = std::unique(faces.begin(), faces.end());
    return faces.empty() ? mesh.triangles.size() : static_cast<std::uint64_t>(end - faces.begin());
}

double memory_of_cells(const SurfaceMesh& mesh, const CellOptions& options) {
    const auto triangles = static_cast<double>(mesh.triangles.size());
    const auto count = static_cast<double>(count_cells(mesh, options));
    return options.kind == CellKind::places ? 900 * count + 300 * triangles : 400 * triangles;
}

Result<void> check_cells(const SurfaceMesh& mesh, const CellOptions& options) {
    if (mesh.triangles.empty()) return failure("the surface has no triangles");
    if (options.kind != CellKind::places) return {};
    if (Result<void> fine = check_count(mesh, options.count); !fine) return fine;
    return options.anisotropy ? check_anisotropy(mesh, *options.anisotropy) : Result<void>();
}

Result<SurfaceCells> make_cells(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                const std::atomic<bool>& cancel) {
    if (Result<void> fine = check_cells(mesh, options); !fine) return tl::unexpected(fine.error());
    if (options.kind == CellKind::faces) return face_cells(mesh);
    if (options.kind == CellKind::vertices) return vertex_cells(mesh);
    // A surface that cannot be copied may still be unfolded as it is.
    if (is_fine(mesh, options)) {
        Result<SurfaceCells> cells = cells_by_copy(mesh, options, team, cancel);
        if (cells) return cells;
    }
    std::vector<SurfacePlace> places =
        scatter(mesh, static_cast<std::size_t>(options.count), options.seed);
    relax(mesh, places, options.rounds, team, cancel, options.anisotropy);
    return voronoi_cells(mesh, std::move(places), team, cancel, options.anisotropy);
}

}  // namespace cascade
