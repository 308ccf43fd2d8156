// The JSON chunk by nlohmann's library, then one binary buffer. Coordinates that binary32 cannot
// represent are relative to the model's centre, which the node's translation adds.
#include "export/glb.h"

#include "core/check.h"
#include "export/channels.h"
#include "mesh/normals.h"
#include "picture/float_bytes.h"
#include "picture/srgb.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cascade {

namespace {

using Json = nlohmann::ordered_json;

// Numeric codes of the format.
constexpr int type_of_bytes16 = 5123, type_of_bytes32 = 5125, type_of_floats = 5126;
constexpr int vertex_buffer = 34962, index_buffer = 34963;

constexpr double least_size = 1e-30, largest_size = 1e30;

/// A buffer with views, and accessors that describe the views.
class Buffer {
public:
    /// A view of the bytes that `write` appends; `target` is 0 for pictures.
    template <typename Write>
    std::size_t add_view(int target, const Write& write) {
        const std::size_t begin = bytes_.size();
        write(bytes_);
        Json view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}};
        if (target != 0) view["target"] = target;
        views_.push_back(std::move(view));
        bytes_.append((4 - bytes_.size() % 4) % 4, '\0');
        return views_.size() - 1;
    }

    std::size_t add_accessor(std::size_t view, int type, std::string_view shape,
                             std::size_t count) {
        accessors_.push_back(
            {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}});
        return accessors_.size() - 1;
    }
    Json& accessor(std::size_t number) { return accessors_[number]; }

    /// An accessor of floats; `number(k, c)` is component c of element k.
    template <typename Take>
    std::size_t add_floats(std::string_view shape, std::size_t count, std::size_t components,
                           const Take& number) {
        const std::size_t view = add_view(vertex_buffer, [&](std::string& bytes) {
            for (std::size_t k = 0; k < count; ++k) {
                for (std::size_t c = 0; c < components; ++c) append_number(bytes, number(k, c));
            }
        });
        return add_accessor(view, type_of_floats, shape, count);
    }

    const std::string& bytes() const { return bytes_; }
    void describe(Json& file) const {
        file["accessors"] = accessors_;
        file["bufferViews"] = views_;
        file["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    }

private:
    std::string bytes_;
    Json views_ = Json::array(), accessors_ = Json::array();
};

float component(Vector3d v, std::size_t c) {
    return static_cast<float>(c == 0 ? v.x : c == 1 ? v.y : v.z);
}

struct Extent {
    Vector3d middle;
    double size = 0;      ///< The longest side of its bounding box.
    double farthest = 0;  ///< Largest magnitude of a coordinate.
};

Extent extent_of(const SurfaceMesh& mesh) {
    const MeshFacts facts = facts_of(mesh);
    const Vector3d sides = facts.high - facts.low;
    Extent extent;
    extent.middle = facts.low + sides * 0.5;
    extent.size = std::max({sides.x, sides.y, sides.z});
    for (const double number :
         {facts.low.x, facts.low.y, facts.low.z, facts.high.x, facts.high.y, facts.high.z}) {
        extent.farthest = std::max(extent.farthest, std::abs(number));
    }
    return extent;
}

class GlbFile {
public:
    GlbFile(const SurfaceMesh& mesh, const GlbLook& look)
        : mesh_(mesh), look_(look), vertices_(render_vertices(mesh, corner_normals(mesh))) {}

    Result<std::string> encode() {
        const Extent extent = extent_of(mesh_);
        if (!(extent.size >= least_size && extent.farthest <= largest_size)) {
            return failure(
                fmt::format("a model of size {:.3g} with coordinates of up to {:.3g} does "
                            "not fit into a GLB file, which holds binary32 numbers",
                            extent.size, extent.farthest),
                "scale the model, or write a PLY file");
        }
        const Vector3d origin = are_single(mesh_.points) ? Vector3d{} : extent.middle;
        Json file;
        file["asset"] = {{"version", "2.0"}, {"generator", "Cascade"}};
        file["scene"] = 0;
        file["scenes"] = Json::array({{{"nodes", {0}}}});
        Json node = {{"mesh", 0}};
        if (!(origin == Vector3d{})) node["translation"] = {origin.x, origin.y, origin.z};
        file["nodes"] = Json::array({node});
        file["meshes"] = Json::array({{{"primitives", Json::array({primitive(origin)})}}});
        file["materials"] = Json::array({material(file)});
        buffer_.describe(file);
        return pack(file.dump());
    }

private:
    Json primitive(Vector3d origin) {
        const std::size_t count = vertices_.points.size();
        Json attributes;
        attributes["POSITION"] = add_places(origin);
        attributes["NORMAL"] =
            buffer_.add_floats("VEC3", count, 3, [&](std::size_t k, std::size_t c) {
                return component(vertices_.normals[k], c);
            });
        if (!vertices_.texture.empty()) {
            // glTF has the origin at the upper left.
            attributes["TEXCOORD_0"] =
                buffer_.add_floats("VEC2", count, 2, [&](std::size_t k, std::size_t c) {
                    const float place = vertices_.texture[k][c];
                    return c == 0 ? place : 1 - place;
                });
            attributes["TANGENT"] =
                buffer_.add_floats("VEC4", count, 4, [&](std::size_t k, std::size_t c) {
                    const Tangent& tangent = vertices_.tangents[k];
                    return c == 3 ? static_cast<float>(tangent.side)
                                  : component(tangent.direction, c);
                });
        }
        if (!look_.colours.empty()) attributes["COLOR_0"] = add_colours();
        const std::size_t corners = buffer_.add_view(index_buffer, [&](std::string& bytes) {
            for (const auto& triangle : vertices_.triangles) {
                for (const std::uint32_t vertex : triangle) append_number(bytes, vertex);
            }
        });
        return {{"attributes", attributes},
                {"indices", buffer_.add_accessor(corners, type_of_bytes32, "SCALAR",
                                                 3 * vertices_.triangles.size())},
                {"material", 0}};
    }

    std::size_t add_places(Vector3d origin) {
        std::array<float, 3> low, high;
        low.fill(std::numeric_limits<float>::max());
        high.fill(std::numeric_limits<float>::lowest());
        const std::size_t number = buffer_.add_floats(
            "VEC3", vertices_.points.size(), 3, [&](std::size_t k, std::size_t c) {
                const float place = component(mesh_.points[vertices_.points[k]] - origin, c);
                low[c] = std::min(low[c], place);
                high[c] = std::max(high[c], place);
                return place;
            });
        buffer_.accessor(number)["min"] = low;
        buffer_.accessor(number)["max"] = high;
        return number;
    }

    std::size_t add_colours() {
        const std::size_t count = vertices_.points.size();
        const std::size_t view = buffer_.add_view(vertex_buffer, [&](std::string& bytes) {
            for (const std::uint32_t point : vertices_.points) {
                for (const float light : light_of(shown(look_.colours[point]))) {
                    append_number(bytes, static_cast<std::uint16_t>(level_of(light, 65535)));
                }
                append_number(bytes, std::uint16_t{65535});
            }
        });
        const std::size_t number = buffer_.add_accessor(view, type_of_bytes16, "VEC4", count);
        buffer_.accessor(number)["normalized"] = true;
        return number;
    }

    Json material(Json& file) {
        Json surface = {{"metallicFactor", 0.0}, {"roughnessFactor", look_.roughness}};
        Json result;
        if (!look_.colour_map.empty()) {
            surface["baseColorTexture"] = {{"index", add_picture(file, look_.colour_map)}};
        }
        result["pbrMetallicRoughness"] = surface;
        if (!look_.normal_map.empty()) {
            result["normalTexture"] = {{"index", add_picture(file, look_.normal_map)}};
        }
        const bool has_boundary =
            std::any_of(mesh_.across.begin(), mesh_.across.end(), [](const auto& edges) {
                return std::any_of(edges.begin(), edges.end(),
                                   [](const TriangleEdge& edge) { return !edge.exists(); });
            });
        if (has_boundary) result["doubleSided"] = true;
        return result;
    }

    /// The index of its texture, which repeats outside of 0 … 1, the format's default.
    std::size_t add_picture(Json& file, std::string_view png) {
        const std::size_t view =
            buffer_.add_view(0, [&](std::string& bytes) { bytes.append(png); });
        file["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
        file["textures"].push_back({{"source", file["images"].size() - 1}});
        return file["textures"].size() - 1;
    }

    Result<std::string> pack(std::string text) const {
        text.append((4 - text.size() % 4) % 4, ' ');
        constexpr std::size_t head_size = 12, chunk_head_size = 8;
        const std::size_t size =
            head_size + 2 * chunk_head_size + text.size() + buffer_.bytes().size();
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
        append_word(buffer_.bytes().size());
        bytes += std::string_view("BIN\0", 4);
        return bytes + buffer_.bytes();
    }

    const SurfaceMesh& mesh_;
    const GlbLook& look_;
    RenderVertices vertices_;
    Buffer buffer_;
};

}  // namespace

Result<std::string> encode_glb(const SurfaceMesh& mesh, const GlbLook& look) {
    CHECK(look.colours.empty() || look.colours.size() == mesh.points.size(),
          "there is a colour for each point");
    CHECK((look.colour_map.empty() && look.normal_map.empty()) || !mesh.texture.empty(),
          "pictures lie over models with texture coordinates");
    return GlbFile(mesh, look).encode();
}

}  // namespace cascade
