// Scales the body and calls the writer of levels.
#include "run/pictures/body_file.h"

#include "core/enough_memory.h"
#include "core/run_control.h"
#include "export/levels.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

namespace {

Result<WrittenFiles> write_levels_of(const std::filesystem::path& path, const SurfaceMesh& body,
                                     const Grid& grid, const PointResults& results, int levels) {
    ModelLevel finest{body,
                      {results.colours.begin(), results.colours.end()},
                      {results.channels.begin(), results.channels.end()}};
    const double longest = grid.spacing * static_cast<double>(grid.longest_side());
    for (Vector3d& point : finest.mesh.points) point = point * longest;
    const auto all = levels_of(std::move(finest), levels, 2 * grid.spacing, never_cancelled);
    if (!all) return tl::unexpected(all.error());
    auto paths = write_levels(path, *all);
    if (!paths) return tl::unexpected(paths.error());
    return WrittenFiles{*std::move(paths),
                        remarks_of_origin(path, origin_of_file(path, all->front().mesh))};
}

}  // namespace

Result<WrittenFiles> write_body(const std::filesystem::path& path, const SurfaceMesh& body,
                                const Grid& grid, const PointResults& results, int levels) {
    if (body.points.empty()) {
        return failure(
            fmt::format("'{}' is not written, because the body is empty: its formula is "
                        "nowhere above 0",
                        path.string()));
    }
    return enough_memory_for([&] { return write_levels_of(path, body, grid, results, levels); },
                             "cannot write '" + path.string() + "': there is not enough memory");
}

}  // namespace cascade
