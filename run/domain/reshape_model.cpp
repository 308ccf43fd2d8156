// Estimates the memory that OpenMesh's tools need, and describes the result.
#include "run/domain/reshape_model.h"

#include "core/counted.h"
#include "core/quantities.h"
#include "mesh/simplify.h"
#include "mesh/subdivide.h"
#include "run/domain/free_memory.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

namespace {

/// Bytes for a triangle, including its half-edges and the data of OpenMesh's tools.
constexpr double bytes_when_subdivided = 300, bytes_when_simplified = 400;

Result<void> check_memory(double triangles, double bytes_each) {
    const auto free = static_cast<double>(available_memory());
    if (free == 0 || triangles * bytes_each <= free) return {};
    return failure(fmt::format("{} need about {}, but {} are free",
                               counted(static_cast<std::size_t>(triangles), "triangle"),
                               with_unit(triangles * bytes_each, "B"), with_unit(free, "B")),
                   "");
}

std::string size_of(const SurfaceMesh& mesh) {
    return fmt::format("{}, {}", counted(mesh.points.size(), "point"),
                       counted(mesh.triangles.size(), "triangle"));
}

Result<void> subdivide_model(SurfaceMesh& mesh, int times, std::vector<std::string>& lines) {
    double triangles = static_cast<double>(mesh.triangles.size());
    for (int k = 0; k < times; ++k) triangles *= 4;
    if (triangles <= static_cast<double>(most_subdivided)) {
        if (auto fits = check_memory(triangles, bytes_when_subdivided); !fits) return fits;
    }
    auto fine = subdivide(mesh, times);
    if (!fine) return tl::unexpected(fine.error());
    mesh = *std::move(fine);
    lines.push_back("subdivided: " + size_of(mesh));
    return {};
}

Result<void> simplify_model(SurfaceMesh& mesh, std::size_t triangles,
                            const std::atomic<bool>& cancel, std::vector<std::string>& lines) {
    if (mesh.triangles.size() <= triangles) {
        lines.push_back("not simplified: it has no more triangles than requested");
        return {};
    }
    if (auto fits = check_memory(static_cast<double>(mesh.triangles.size()), bytes_when_simplified);
        !fits) {
        return fits;
    }
    auto simple = simplify(mesh, triangles, {}, cancel);
    if (!simple) return tl::unexpected(simple.error());
    const bool loses_texture = !mesh.texture.empty();
    mesh = std::move(simple->mesh);
    std::string line = "simplified: " + size_of(mesh);
    if (mesh.triangles.size() > triangles) {
        line += ", fewer would change its connections or fold it";
    }
    if (loses_texture) line += ", without its texture coordinates (use --unwrap to make new ones)";
    lines.push_back(std::move(line));
    return {};
}

}  // namespace

Result<std::vector<std::string>> reshape(SurfaceMesh& mesh, const Reshaping& how,
                                         const std::atomic<bool>& cancel) {
    std::vector<std::string> lines;
    Result<void> done;
    if (how.subdivide > 0) done = subdivide_model(mesh, how.subdivide, lines);
    if (done && how.simplify) done = simplify_model(mesh, *how.simplify, cancel, lines);
    if (!done) return tl::unexpected(done.error());
    return lines;
}

}  // namespace cascade
