// Writes models as binary STL files (3D Systems, "StereoLithography Interface Specification",
// 1988), for 3-D printers: triangles with their normals only.
#include "export/model_writer.h"
#include "picture/float_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cascade {

namespace {

/// The largest rounding error of coordinates, as a fraction of a typical edge length.
constexpr double most_rounding = 1e-3;

}  // namespace

Vector3d stl_origin(const SurfaceMesh& mesh) {
    if (mesh.triangles.empty() || are_single(mesh.points)) return {};
    const SurfaceMesh::Box box = mesh.box();
    const Vector3d sides = box.high - box.low, middle = box.low + sides * 0.5;
    const double size = std::max({sides.x, sides.y, sides.z});
    const double away = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)});
    const double edge = std::sqrt(mesh.total_area() / static_cast<double>(mesh.triangles.size()));
    const double rounding = away * std::numeric_limits<float>::epsilon() / 2;
    return away > size && rounding > most_rounding * edge ? middle : Vector3d{};
}

std::string encode_stl(const SurfaceMesh& mesh, Vector3d origin) {
    constexpr std::size_t size_of_head = 80, size_of_triangle = 50;
    // The header must not begin with "solid", because text files begin with this word.
    std::string bytes = "binary STL, Cascade";
    bytes.resize(size_of_head, ' ');
    bytes.reserve(size_of_head + 4 + size_of_triangle * mesh.triangles.size());
    append_number(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    const auto append = [&](Vector3d v) {
        for (const double number : {v.x, v.y, v.z})
            append_number(bytes, static_cast<float>(number));
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vector3d normal = mesh.double_area_normal(t);
        const double size = length(normal);
        append(size > 0 ? normal * (1 / size) : Vector3d{});
        for (std::size_t k = 0; k < 3; ++k) append(mesh.corner(t, k) - origin);
        append_number(bytes, std::uint16_t{0});
    }
    return bytes;
}

}  // namespace cascade
