// A file is a header of 12 bytes, a chunk of JSON and a chunk with the buffer. Each chunk is padded
// to a multiple of 4 bytes.
#include "export/glb_file.h"

#include "export/channels.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade {

namespace {

constexpr double least_size = 1e-30, largest_size = 1e30;

}  // namespace

Result<Vector3d> origin_of_glb(std::span<const Vector3d> points, Vector3d low, Vector3d high) {
    const Vector3d sides = high - low;
    const double size = std::max({sides.x, sides.y, sides.z});
    double farthest = 0;
    for (const double number : {low.x, low.y, low.z, high.x, high.y, high.z}) {
        farthest = std::max(farthest, std::abs(number));
    }
    if (!(size >= least_size && farthest <= largest_size)) {
        return failure(fmt::format("a model of size {:.3g} with coordinates of up to {:.3g} does "
                                   "not fit into a GLB file, whose numbers have only 32 bits",
                                   size, farthest),
                       "scale the model, or write a PLY file");
    }
    return are_single(points) ? Vector3d{} : low + sides * 0.5;
}

GlbFile::Json plain_material(float roughness) {
    return {{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", roughness}}}};
}

GlbFile::GlbFile(Vector3d origin) : origin_(origin) {
    file_["asset"] = {{"version", "2.0"}, {"generator", "Cascade"}};
    file_["scene"] = 0;
    file_["scenes"] = Json::array({{{"nodes", Json::array()}}});
}

std::size_t GlbFile::add(const char* list, Json part) {
    file_[list].push_back(std::move(part));
    return file_[list].size() - 1;
}

std::size_t GlbFile::add_node(Json node, bool is_in_scene) {
    if (!(origin_ == Vector3d{})) node["translation"] = {origin_.x, origin_.y, origin_.z};
    const std::size_t number = add("nodes", std::move(node));  // This may move the lists in memory.
    if (is_in_scene) file_["scenes"][0]["nodes"].push_back(number);
    return number;
}

void GlbFile::use(const char* extension) { file_["extensionsUsed"].push_back(extension); }

void GlbFile::require(const char* extension) {
    use(extension);
    file_["extensionsRequired"].push_back(extension);
}

std::size_t GlbFile::add_zeros(std::size_t count) {
    const std::array<float, 3> zero{};
    accessors_.push_back({{"componentType", code_of<float>()},
                          {"count", count},
                          {"type", "VEC3"},
                          {"min", zero},
                          {"max", zero}});
    return accessors_.size() - 1;
}

std::size_t GlbFile::add_corners(std::span<const std::array<std::uint32_t, 3>> triangles,
                                 std::size_t vertices, bool is_compact) {
    const auto corner = [&](std::size_t k, std::size_t) { return triangles[k / 3][k % 3]; };
    const std::size_t count = 3 * triangles.size();
    // Index 65535 has a special meaning: it would begin a new strip.
    return is_compact && vertices <= 65535
               ? add_numbers<std::uint16_t>(index_buffer, "SCALAR", count, corner)
               : add_numbers<std::uint32_t>(index_buffer, "SCALAR", count, corner);
}

Result<std::string> GlbFile::pack() {
    file_["accessors"] = accessors_;
    file_["bufferViews"] = views_;
    file_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    std::string text = file_.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    constexpr std::size_t head_size = 12, chunk_head_size = 8;
    const std::size_t size = head_size + 2 * chunk_head_size + text.size() + bytes_.size();
    if (size > std::numeric_limits<std::uint32_t>::max()) {
        return failure("a GLB file holds at most 4 GiB", "write a PLY file");
    }
    std::string bytes = "glTF";
    bytes.reserve(size);
    const auto append_word = [&](std::size_t word) {
        append_number(bytes, static_cast<std::uint32_t>(word));
    };
    append_word(2);
    append_word(size);
    append_word(text.size());
    bytes += "JSON";
    bytes += text;
    append_word(bytes_.size());
    bytes += std::string_view("BIN\0", 4);
    return bytes + bytes_;
}

}  // namespace cascade
