// Models as binary STL files (3D Systems, "StereoLithography Interface Specification", 1988), for
// 3-D printers: triangles with their normals, and nothing else.
#include "export/model_writer.h"
#include "picture/float_bytes.h"

#include <cstdint>

namespace cascade {

std::string encode_stl(const SurfaceMesh& mesh) {
    constexpr std::size_t size_of_head = 80, size_of_triangle = 50;
    // A head that begins with "solid" would be taken for that of a text.
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
        for (std::size_t k = 0; k < 3; ++k) append(mesh.corner(t, k));
        append_number(bytes, std::uint16_t{0});
    }
    return bytes;
}

}  // namespace cascade
