// Writes models as binary PLY files.
#include "export/model_writer.h"
#include "mesh/normals.h"
#include "picture/float_bytes.h"
#include "picture/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace cascade {

namespace {

/// Replaces white space, which would end the name.
std::string one_word(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c == 127; }, '_');
    return name;
}

/// Names for the channels. A channel must not have a name that G. Turk defined, or that readers
/// take for texture coordinates or colours.
std::vector<std::string> property_names(std::span<const Channel> channels) {
    std::vector<Channel> named;
    for (const Channel& channel : channels) named.push_back({one_word(channel.name), {}});
    // clang-format off
    return distinct_names(named, {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha",
                                  "r", "g", "b", "s", "t", "u", "v", "texture_s", "texture_t",
                                  "texture_u", "texture_v", "texcoord", "material_index"});
    // clang-format on
}

std::string head_of(const SurfaceMesh& mesh, const PointResults& results, bool is_single) {
    std::string head =
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment Cascade\nelement vertex {}\n",
                    mesh.points.size());
    for (const char axis : {'x', 'y', 'z'}) {
        head += fmt::format("property {} {}\n", is_single ? "float" : "double", axis);
    }
    head += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!results.colours.empty()) {
        head += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    for (const std::string& name : property_names(results.channels)) {
        head += fmt::format("property float {}\n", name);
    }
    head += fmt::format("element face {}\nproperty list uchar int vertex_indices\n",
                        mesh.triangles.size());
    if (!mesh.texture.empty()) head += "property list uchar float texcoord\n";
    return head + "end_header\n";
}

}  // namespace

std::string encode_ply(const SurfaceMesh& mesh, const PointResults& results) {
    const bool is_single = are_single(mesh.points);
    const std::vector<Vector3d> normals = point_normals(mesh);
    std::string bytes = head_of(mesh, results, is_single);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        for (const double number : {mesh.points[p].x, mesh.points[p].y, mesh.points[p].z}) {
            if (is_single) append_number(bytes, static_cast<float>(number));
            else append_number(bytes, number);
        }
        for (const double number : {normals[p].x, normals[p].y, normals[p].z}) {
            append_number(bytes, static_cast<float>(number));
        }
        if (!results.colours.empty()) {
            for (const float number : shown(results.colours[p])) {
                append_number(bytes, static_cast<std::uint8_t>(level_of(number, 255)));
            }
        }
        for (const Channel& channel : results.channels) append_number(bytes, channel.values[p]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        append_number(bytes, std::uint8_t{3});
        for (const std::uint32_t corner : mesh.triangles[t]) append_number(bytes, corner);
        if (mesh.texture.empty()) continue;
        append_number(bytes, std::uint8_t{6});
        for (const TexturePlace& place : mesh.texture[t]) {
            for (const float number : place) append_number(bytes, number);
        }
    }
    return bytes;
}

}  // namespace cascade
