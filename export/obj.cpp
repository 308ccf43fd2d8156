// Models as Wavefront OBJ files.
#include "export/model_writer.h"
#include "mesh/normals.h"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <vector>

namespace cascade {

std::string encode_obj(const SurfaceMesh& mesh, const PointResults& results) {
    std::string text = "# Cascade\n";
    auto out = std::back_inserter(text);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        const Vector3d& place = mesh.points[p];
        fmt::format_to(out, "v {} {} {}", place.x, place.y, place.z);
        if (!results.colours.empty()) {
            for (const float number : shown(results.colours[p])) {
                fmt::format_to(out, " {:.6g}", number);
            }
        }
        text += '\n';
    }
    const CornerNormals normals = corner_normals(mesh);
    for (const Vector3d& normal : normals.normals) {
        fmt::format_to(out, "vn {:.6g} {:.6g} {:.6g}\n", normal.x, normal.y, normal.z);
    }
    std::vector<std::size_t> texture;  // Index of each corner's coordinates, from 1.
    texture.reserve(3 * mesh.texture.size());
    std::map<TexturePlace, std::size_t> known;
    for (const auto& corners : mesh.texture) {
        for (const TexturePlace& place : corners) {
            const auto [entry, is_new] = known.emplace(place, known.size() + 1);
            if (is_new) fmt::format_to(out, "vt {} {}\n", place[0], place[1]);
            texture.push_back(entry->second);
        }
    }
    text += "s 1\n";  // Smooth: some programs use normals only then.
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        text += 'f';
        for (std::size_t k = 0; k < 3; ++k) {
            fmt::format_to(out, " {}/", mesh.triangles[t][k] + 1);
            if (!mesh.texture.empty()) fmt::format_to(out, "{}", texture[3 * t + k]);
            fmt::format_to(out, "/{}", normals.numbers[t][k] + 1);
        }
        text += '\n';
    }
    return text;
}

}  // namespace cascade
