#include "tests/support/small_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace cascade::test {

namespace {

template <typename T>
std::string bytes_in_order(T value, bool big_endian) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

std::string base64_of(std::string_view data) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t k = 0; k + 2 < data.size(); k += 3) {
        const unsigned word = static_cast<unsigned>(static_cast<unsigned char>(data[k])) << 16 |
                              static_cast<unsigned>(static_cast<unsigned char>(data[k + 1])) << 8 |
                              static_cast<unsigned char>(data[k + 2]);
        for (const int shift : {18, 12, 6, 0}) text += digits[word >> shift & 63];
    }
    return text;
}

/// Positions and indices of one triangle: 42 bytes.
std::string triangle_data() {
    std::string data;
    for (const float number : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F})
        data += bytes_of(number);
    for (std::uint16_t corner = 0; corner < 3; ++corner) data += bytes_of(corner);
    return data;
}

std::string gltf_with_buffer(std::string_view indices_accessor, std::string_view buffer) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
           R"("nodes":[{"scale":[2,2,2],"children":[1]},{"translation":[1,0,0],"mesh":0}],)"
           R"("meshes":[{"primitives":[{)" +
           std::string(indices_accessor) +
           R"("attributes":{"POSITION":0}}]}],)"
           R"("buffers":[{"byteLength":42)" +
           std::string(buffer) +
           R"(}],"bufferViews":[{"buffer":0,"byteLength":36},)"
           R"({"buffer":0,"byteOffset":36,"byteLength":6}],"accessors":[)"
           R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
           R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
}

/// A GLB file with a skinned node and an instanced node, sparse positions, a morph target, and a
/// second set of texture coordinates with a transform.
std::string rich_glb() {
    constexpr std::string_view json =
        R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_mesh_gpu_instancing"],"scene":0,)"
        R"("scenes":[{"nodes":[0,1,2]}],"nodes":[{"mesh":0,"skin":0},{"children":[3]},{"mesh":0,)"
        R"("weights":[1],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":5,)"
        R"("SCALE":5,"_COLOR_0":5}}}},{"translation":[1,0,0]}],"skins":[{"joints":[3,1]}],)"
        R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1,)"
        R"("extensions":{"KHR_texture_transform":{"offset":[1,0],"scale":[2,2],"rotation":1}}}}}],)"
        R"("meshes":[{"weights":[0.5],"primitives":[{"material":0,"indices":1,"attributes":)"
        R"({"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3,"TEXCOORD_1":6},"targets":[{"POSITION":4}]}]}],)"
        R"("buffers":[{"byteLength":68}],"bufferViews":[{"buffer":0,"byteLength":36},)"
        R"({"buffer":0,"byteOffset":36,"byteLength":6},{"buffer":0,"byteOffset":44,"byteLength":12},)"
        R"({"buffer":0,"byteOffset":56,"byteLength":12}],"accessors":[)"
        R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,)"
        R"("indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":0}}},)"
        R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},)"
        R"({"bufferView":2,"componentType":5121,"count":3,"type":"VEC4"},)"
        R"({"bufferView":3,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"},)"
        R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
        R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
        R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}]})";
    std::string data = triangle_data() + std::string(14, '\0');
    for (int point = 0; point < 3; ++point) data += std::string("\xff\0\0\0", 4);
    return glb_file(json, data);
}

constexpr std::string_view text_ply = R"(ply
format ascii 1.0
comment a tetrahedron of polygons and a strip
element vertex 4
property float x
property float y
property double z
property uchar red
property float s
property float t
element face 2
property list uchar int vertex_indices
element tristrips 1
property list int int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 1 0
0 1 0.5 7 0 1
0 0 1e0 0 0.5 -.5
3 0 2 1
3 0 1 3
5 0 3 2 -1 1
)";

std::string binary_ply(bool big) {
    std::string file = "ply\nformat binary_";
    file += big ? "big" : "little";
    file +=
        "_endian 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty ushort z\n"
        "element face 1\nproperty list uint8 uint16 vertex_index\n"
        "property list uint8 float texcoord\nend_header\n";
    for (const float k : {0.F, 1.F, 2.F}) {
        file += bytes_of(k, big) + bytes_of(0.1 * k * k, big) +
                bytes_of(static_cast<std::uint16_t>(k), big);
    }
    file += '\3';
    for (const auto corner : std::array<std::uint16_t, 3>{0, 2, 1}) file += bytes_of(corner, big);
    file += '\6';
    for (const float place : {0.F, 0.F, 1.F, 0.F, 0.F, 1.F}) file += bytes_of(place, big);
    return file;
}

std::string binary_stl() {
    std::string file(80, ' ');
    file += bytes_of(std::uint32_t{2});
    for (int k = 0; k < 2; ++k) {
        const float side = k == 0 ? 1.F : -1.F;
        for (const float number : {0.F, 0.F, side, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, side, 0.F}) {
            file += bytes_of(number);
        }
        file += std::string(2, '\0');
    }
    return file;
}

constexpr std::string_view text_obj =
    "# a tetrahedron\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 1 1\n"
    "vt 0 0\nvt 1 0\nvt 0.5 1\nvn 0 0 1\ng all\n"
    "f 1/1/1 3/3/1 2/2/1\nf 1/1 2/2 4/3\nf -3/1 -2/2 -1/3\nf 1//1 4//1 3//1\n";

constexpr std::string_view text_off =
    "COFF\n# a tetrahedron\n4 4 6\n0 0 0 255 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n0 0 1 0 51 0\n"
    "3 0 2 1\n3 0 1 3\n3 1 2 3 1 0 0\n3 0 3 2\n";

constexpr std::string_view text_stl =
    "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 -1e0 0\n"
    "vertex 1 0 0\nendloop\nendfacet\nendsolid one\n";

}  // namespace

std::string bytes_of(float value, bool big_endian) { return bytes_in_order(value, big_endian); }
std::string bytes_of(double value, bool big_endian) { return bytes_in_order(value, big_endian); }
std::string bytes_of(std::uint16_t value, bool big_endian) {
    return bytes_in_order(value, big_endian);
}
std::string bytes_of(std::uint32_t value, bool big_endian) {
    return bytes_in_order(value, big_endian);
}

std::string gltf_text(std::string_view indices_accessor) {
    return gltf_with_buffer(indices_accessor, R"(,"uri":"data:application/octet-stream;base64,)" +
                                                  base64_of(triangle_data()) + '"');
}

std::string glb_file(std::string_view json, std::string_view data) {
    const auto chunk = [](std::string_view kind, std::string_view bytes, char filler) {
        std::string filled(bytes);
        while (filled.size() % 4 != 0) filled += filler;
        return bytes_of(static_cast<std::uint32_t>(filled.size())) + std::string(kind) + filled;
    };
    const std::string chunks =
        chunk("JSON", json, ' ') + chunk(std::string_view("BIN\0", 4), data, '\0');
    return "glTF" + bytes_of(std::uint32_t{2}) +
           bytes_of(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

std::vector<SmallModel> small_models() {
    return {{"PLY text", "ply", std::string(text_ply)},
            {"PLY little-endian", "ply", binary_ply(false)},
            {"PLY big-endian", "ply", binary_ply(true)},
            {"OBJ", "obj", std::string(text_obj)},
            {"OFF", "off", std::string(text_off)},
            {"STL text", "stl", std::string(text_stl)},
            {"STL binary", "stl", binary_stl()},
            {"glTF", "gltf", gltf_text()},
            {"GLB", "glb", glb_file(gltf_with_buffer(R"("indices":1,)", ""), triangle_data())},
            {"GLB with a skin", "glb", rich_glb()}};
}

std::string small_torus_obj() {
    std::string text;
    for (int i = 0; i < 16; ++i) {
        for (int j = 0; j < 8; ++j) {
            const double a = i * std::numbers::pi / 8, b = j * std::numbers::pi / 4,
                         r = 1 + 0.4 * std::cos(b);
            text +=
                fmt::format("v {} {} {}\n", r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
        }
    }
    for (int i = 0; i < 16; ++i) {
        for (int j = 0; j < 8; ++j) {
            const int right = (i + 1) % 16 * 8 + 1, here = 8 * i + 1, up = (j + 1) % 8;
            text += fmt::format("f {} {} {} {}\n", here + j, right + j, right + up, here + up);
        }
    }
    return text;
}

}  // namespace cascade::test
