// The parts of a GLB file: a JSON text that describes views of one binary buffer.
#pragma once

#include "core/result.h"
#include "core/vector3.h"
#include "export/glb.h"
#include "picture/float_bytes.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

/// Builds a GLB file from parts. A part's number is its index in the list of its kind.
class GlbFile {
public:
    using Json = nlohmann::ordered_json;

    // The format's codes for buffers and for the wrapping of textures.
    static constexpr int vertex_buffer = 34962, index_buffer = 34963;
    static constexpr int wrap_repeat = 10497, wrap_clamp = 33071;

    /// Begins a file without parts. It has one scene, and `origin` is added to the position of
    /// every node.
    explicit GlbFile(Vector3d origin = {});

    /// Appends a part to a list and returns its number. Lists are "nodes", "meshes", "materials",
    /// "images", "textures", "samplers" and "animations".
    std::size_t add(const char* list, Json part);
    /// Adds a node, moved by the origin. If the node is not in the scene, another node must refer
    /// to it.
    std::size_t add_node(Json node, bool is_in_scene = true);
    /// Declares the use of an extension that readers may ignore.
    void use(const char* extension);
    void require(const char* extension);

    /// Adds a view of the bytes that `write` appends. `target` is 0 unless the bytes are vertices
    /// or indices.
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

    /// Adds an accessor of `count` elements of a shape such as "VEC3". `number(k, c)` gives
    /// component c of element k. The file stores numbers in the type `Number`. Integers represent
    /// fractions of their largest value.
    template <typename Number, typename Take>
    std::size_t add_numbers(int target, std::string_view shape, std::size_t count,
                            const Take& number) {
        const std::size_t components = shape == "SCALAR" ? 1 : shape.back() - std::size_t{'0'};
        const std::size_t view = add_view(target, [&](std::string& bytes) {
            for (std::size_t k = 0; k < count; ++k) {
                for (std::size_t c = 0; c < components; ++c) {
                    append_number(bytes, static_cast<Number>(number(k, c)));
                }
            }
        });
        Json accessor = {{"bufferView", view},
                         {"componentType", code_of<Number>()},
                         {"count", count},
                         {"type", shape}};
        if (std::is_integral_v<Number> && target != index_buffer) accessor["normalized"] = true;
        accessors_.push_back(std::move(accessor));
        return accessors_.size() - 1;
    }

    /// Adds positions of vertices with their bounds. `place(k)` is the absolute position in double
    /// precision. The file holds positions relative to the origin.
    template <typename Take>
    std::size_t add_places(std::size_t count, const Take& place) {
        return add_bounded(vertex_buffer, "VEC3", count, [&](std::size_t k, std::size_t c) {
            return component(place(k) - origin_, c);
        });
    }

    /// Does the same as add_numbers() for binary32, and stores the bounds of each component.
    template <typename Take>
    std::size_t add_bounded(int target, std::string_view shape, std::size_t count,
                            const Take& number) {
        std::vector<float> low, high;
        const std::size_t added =
            add_numbers<float>(target, shape, count, [&](std::size_t k, std::size_t c) {
                const float part = number(k, c);
                if (k == 0) {
                    low.push_back(part);
                    high.push_back(part);
                }
                low[c] = std::min(low[c], part);
                high[c] = std::max(high[c], part);
                return part;
            });
        accessors_[added]["min"] = low;
        accessors_[added]["max"] = high;
        return added;
    }

    /// Adds `count` vectors of zeros, which take no bytes.
    std::size_t add_zeros(std::size_t count);

    /// Adds the corners of triangles, as indices of `vertices` vertices. If `is_compact` is true,
    /// indices take as few bytes as possible.
    std::size_t add_corners(std::span<const std::array<std::uint32_t, 3>> triangles,
                            std::size_t vertices, bool is_compact);

    Vector3d origin() const { return origin_; }

    /// The bytes of the whole file. Fails above 4 GiB.
    Result<std::string> pack();

    template <typename Vector>
    static float component(const Vector& v, std::size_t c) {
        return static_cast<float>(c == 0 ? v.x : c == 1 ? v.y : v.z);
    }

private:
    template <typename Number>
    static constexpr int code_of() {
        if constexpr (std::is_same_v<Number, float>) return 5126;
        else if constexpr (std::is_same_v<Number, std::uint32_t>) return 5125;
        else if constexpr (std::is_same_v<Number, std::uint16_t>) return 5123;
        else if constexpr (std::is_same_v<Number, std::int16_t>) return 5122;
        else if constexpr (std::is_same_v<Number, std::uint8_t>) return 5121;
    }

    Vector3d origin_;
    Json file_;
    std::string bytes_;
    Json views_ = Json::array(), accessors_ = Json::array();
};

/// The origin of a file's coordinates: 0 if binary32 represents all coordinates exactly, otherwise
/// the middle of their range. `low` and `high` bound all points of the file. Fails if binary32
/// cannot represent the size of the model.
Result<Vector3d> origin_of_glb(std::span<const Vector3d> points, Vector3d low, Vector3d high);

/// A non-metallic material of this roughness.
GlbFile::Json plain_material(float roughness);

/// Adds a model with its look. Returns the index of its mesh.
std::size_t add_model(const SurfaceMesh& mesh, const GlbLook& look, GlbFile& file,
                      const GlbGrowth& growth = {});

}  // namespace cascade
