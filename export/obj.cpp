// Positions, normals and texture coordinates are indexed separately.
#include "export/obj.h"

#include "mesh/normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <vector>

namespace cascade {

void ObjText::begin(std::string_view name) {
    fmt::format_to(std::back_inserter(text_), "o {}\n", name);
}

void ObjText::add(const SurfaceMesh& mesh, const PointResults& results) {
    auto out = std::back_inserter(text_);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        const Vector3d& place = mesh.points[p];
        fmt::format_to(out, "v {} {} {}", place.x, place.y, place.z);
        if (!results.colours.empty()) {
            for (const float number : shown(results.colours[p])) {
                fmt::format_to(out, " {:.6g}", number);
            }
        }
        text_ += '\n';
    }
    const CornerNormals normals = corner_normals(mesh);
    for (const Vector3d& normal : normals.normals) {
        fmt::format_to(out, "vn {:.6g} {:.6g} {:.6g}\n", normal.x, normal.y, normal.z);
    }
    std::vector<std::size_t> texture;  // For each corner, the index of its texture coordinates.
    texture.reserve(3 * mesh.texture.size());
    std::map<TexturePlace, std::size_t> known;
    for (const auto& corners : mesh.texture) {
        for (const TexturePlace& place : corners) {
            const auto [entry, is_new] = known.emplace(place, places_ + known.size() + 1);
            if (is_new) fmt::format_to(out, "vt {} {}\n", place[0], place[1]);
            texture.push_back(entry->second);
        }
    }
    text_ +=
        "s 1\n";  // Marks faces as smooth, because some programs ignore the normals of other faces.
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        text_ += 'f';
        for (std::size_t k = 0; k < 3; ++k) {
            fmt::format_to(out, " {}/", points_ + mesh.triangles[t][k] + 1);
            if (!mesh.texture.empty()) fmt::format_to(out, "{}", texture[3 * t + k]);
            fmt::format_to(out, "/{}", normals_ + normals.numbers[t][k] + 1);
        }
        text_ += '\n';
    }
    points_ += mesh.points.size();
    normals_ += normals.normals.size();
    places_ += known.size();
}

namespace {

/// The number of digits of coordinates. Nine digits remain relative to the model's size, however
/// far from the origin the model is.
int digits_of(std::span<const Vector3d> points) {
    constexpr int usual = 9, all = 17;
    if (points.empty()) return usual;
    Vector3d low = points[0], high = low;
    for (const Vector3d& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    double farthest = 0;
    for (const double number : {low.x, low.y, low.z, high.x, high.y, high.z})
        farthest = std::max(farthest, std::abs(number));
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (!(size > 0) || !(farthest > size)) return usual;
    return std::min(usual + static_cast<int>(std::log10(farthest / size)), all);
}

}  // namespace

void ObjText::add(const MergedCopies& copies) {
    auto out = std::back_inserter(text_);
    const int digits = digits_of(copies.points);
    for (std::size_t k = 0; k < copies.points.size(); ++k) {
        const Vector3d& place = copies.points[k];
        const Colour& colour = copies.colours[k];
        fmt::format_to(out, "v {:.{}g} {:.{}g} {:.{}g} {:.4g} {:.4g} {:.4g}\n", place.x, digits,
                       place.y, digits, place.z, digits, colour[0], colour[1], colour[2]);
    }
    for (const Vector3& normal : copies.normals) {
        fmt::format_to(out, "vn {:.4g} {:.4g} {:.4g}\n", normal.x, normal.y, normal.z);
    }
    text_ += "s 1\n";
    for (const auto& triangle : copies.triangles) {
        text_ += 'f';
        for (const std::uint32_t corner : triangle) {
            fmt::format_to(out, " {}//{}", points_ + corner + 1, normals_ + corner + 1);
        }
        text_ += '\n';
    }
    points_ += copies.points.size();
    normals_ += copies.normals.size();
}

std::string encode_obj(const SurfaceMesh& mesh, const PointResults& results) {
    ObjText file;
    file.add(mesh, results);
    return file.text();
}

}  // namespace cascade
