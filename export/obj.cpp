// Models as Wavefront OBJ files.
#include "export/model_writer.h"
#include "surface/point_normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace cascade {

std::string encode_obj(const SurfaceMesh& mesh, const PointResults& results) {
    std::string text = "# Cascade\n";
    auto out = std::back_inserter(text);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        const Vector3d& place = mesh.points[p];
        fmt::format_to(out, "v {} {} {}", place.x, place.y, place.z);
        if (!results.colours.empty()) {
            for (const float number : shown(results.colours[p])) {
                fmt::format_to(out, " {:.6g}", std::clamp(number, 0.0F, 1.0F));
            }
        }
        text += '\n';
    }
    for (const Vector3d& normal : point_normals(mesh)) {
        fmt::format_to(out, "vn {:.6g} {:.6g} {:.6g}\n", normal.x, normal.y, normal.z);
    }
    for (const auto& corners : mesh.texture) {
        for (const TexturePlace& place : corners) {
            fmt::format_to(out, "vt {} {}\n", place[0], place[1]);
        }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        text += 'f';
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t point = mesh.triangles[t][k] + 1;
            if (mesh.texture.empty()) fmt::format_to(out, " {0}//{0}", point);
            else fmt::format_to(out, " {0}/{1}/{0}", point, 3 * t + k + 1);
        }
        text += '\n';
    }
    return text;
}

}  // namespace cascade
