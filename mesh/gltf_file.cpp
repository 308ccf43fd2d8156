// Reads glTF and GLB files with tinygltf: all meshes of the scene, transformed by its nodes.
#include "core/json_size.h"
#include "mesh/model_file.h"

#include <fmt/format.h>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE  // Textures are not needed.
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace cascade {

namespace {

constexpr std::size_t deepest_nesting = 128;

/// Limits derived from the file's size, with an allowance for small files: a small file can use the
/// same mesh or list the same triangles any number of times.
struct Bounds {
    std::size_t points, corners;

    explicit Bounds(std::size_t bytes)
        : points(std::min(std::size_t{1} << 27, (std::size_t{1} << 18) + bytes)),
          corners(std::min(std::size_t{1} << 29, (std::size_t{1} << 20) + 4 * bytes)) {}
};

/// A transformation: a 4 × 4 matrix, column by column as in glTF.
using Matrix = std::array<double, 16>;
constexpr Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t k = 0; k < 4; ++k) {
                result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
            }
        }
    }
    return result;
}

Vector3d place(const Matrix& m, Vector3d p) {
    const auto row = [&](std::size_t k) {
        return m[k] * p.x + m[4 + k] * p.y + m[8 + k] * p.z + m[12 + k];
    };
    return {row(0), row(1), row(2)};
}

/// The matrix of a node, or that of its translation, rotation (a quaternion) and scale.
Matrix matrix_of(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        Matrix matrix;
        std::copy(node.matrix.begin(), node.matrix.end(), matrix.begin());
        return matrix;
    }
    Matrix matrix = identity;
    if (node.rotation.size() == 4) {
        const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2],
                     w = node.rotation[3];
        // clang-format off
        matrix = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
                  2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
                  2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0,
                  0, 0, 0, 1};
        // clang-format on
    }
    if (node.scale.size() == 3) {
        for (std::size_t k = 0; k < 12; ++k) matrix[k] *= node.scale[k / 4];
    }
    if (node.translation.size() == 3) {
        for (std::size_t k = 0; k < 3; ++k) matrix[12 + k] = node.translation[k];
    }
    return matrix;
}

/// The numbers of an accessor whose range in its buffer is valid.
class Numbers {
public:
    static std::optional<Numbers> of(const tinygltf::Model& model, int number) {
        if (number < 0 || static_cast<std::size_t>(number) >= model.accessors.size()) return {};
        const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(number)];
        const std::size_t view = static_cast<std::size_t>(accessor.bufferView);
        if (accessor.sparse.isSparse || accessor.bufferView < 0 ||
            view >= model.bufferViews.size()) {
            return {};
        }
        const tinygltf::BufferView& bytes = model.bufferViews[view];
        if (bytes.buffer < 0 || static_cast<std::size_t>(bytes.buffer) >= model.buffers.size()) {
            return {};
        }
        const std::vector<unsigned char>& data =
            model.buffers[static_cast<std::size_t>(bytes.buffer)].data;
        Numbers numbers;
        numbers.type_ = accessor.componentType;
        numbers.is_normalized_ = accessor.normalized;
        numbers.count_ = accessor.count;
        const int components = tinygltf::GetNumComponentsInType(accessor.type);
        const int component_size = tinygltf::GetComponentSizeInBytes(accessor.componentType);
        const int stride = accessor.ByteStride(bytes);
        if (components < 1 || component_size < 1 || stride < 1) return {};
        numbers.components_ = static_cast<std::size_t>(components);
        numbers.component_size_ = static_cast<std::size_t>(component_size);
        numbers.stride_ = static_cast<std::size_t>(stride);
        const std::size_t element = numbers.components_ * numbers.component_size_;
        const std::size_t size = data.size();
        if (bytes.byteOffset > size || accessor.byteOffset > size - bytes.byteOffset) return {};
        const std::size_t begin = bytes.byteOffset + accessor.byteOffset;
        if (accessor.count > 0 &&
            (element > size - begin ||
             (accessor.count - 1) > (size - begin - element) / numbers.stride_)) {
            return {};
        }
        numbers.data_ = data.data() + begin;
        return numbers;
    }

    std::size_t count() const { return count_; }
    std::size_t components() const { return components_; }

    double at(std::size_t element, std::size_t component) const {
        const unsigned char* from = data_ + element * stride_ + component * component_size_;
        switch (type_) {
            case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled(read<std::int8_t>(from), 127);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return scaled(read<std::uint8_t>(from), 255);
            case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled(read<std::int16_t>(from), 32767);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return scaled(read<std::uint16_t>(from), 65535);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return read<std::uint32_t>(from);
            case TINYGLTF_COMPONENT_TYPE_FLOAT: return read<float>(from);
            case TINYGLTF_COMPONENT_TYPE_DOUBLE: return read<double>(from);
            default: return 0;
        }
    }

private:
    template <typename T>
    static T read(const unsigned char* from) {
        T value;
        std::memcpy(&value, from, sizeof(T));
        return value;
    }
    double scaled(double value, double one) const { return is_normalized_ ? value / one : value; }

    const unsigned char* data_ = nullptr;
    std::size_t count_ = 0, components_ = 1, component_size_ = 1, stride_ = 1;
    int type_ = 0;
    bool is_normalized_ = false;
};

class SceneReader {
public:
    SceneReader(const tinygltf::Model& model, Bounds bounds) : model_(model), bounds_(bounds) {}

    Result<PolygonSoup> read() {
        if (model_.scenes.empty()) {
            for (const tinygltf::Mesh& mesh : model_.meshes) {
                if (const auto added = add_mesh(mesh, identity); !added) {
                    return tl::unexpected(added.error());
                }
            }
        } else {
            const int wanted = std::max(0, model_.defaultScene);
            const std::size_t number = static_cast<std::size_t>(wanted);
            if (number >= model_.scenes.size())
                return failure("the glTF file's scene is not there");
            for (const int node : model_.scenes[number].nodes) {
                if (const auto added = add_node(node); !added) return tl::unexpected(added.error());
            }
        }
        if (soup_.points.empty()) return failure("the glTF file has no triangles");
        if (!all_have_texture_) soup_.texture.clear();
        for (PointAttribute& attribute : colours_) {
            if (any_colour_) soup_.attributes.push_back(std::move(attribute));
        }
        return std::move(soup_);
    }

private:
    /// Adds a node and its descendants iteratively: a hostile file nests deeply or in cycles.
    Result<void> add_node(int root) {
        std::vector<std::pair<int, Matrix>> waiting = {{root, identity}};
        std::size_t visits = 0;
        while (!waiting.empty()) {
            const auto [number, above] = waiting.back();
            waiting.pop_back();
            if (number < 0 || static_cast<std::size_t>(number) >= model_.nodes.size()) {
                return failure(fmt::format("node {} of the glTF file is not there", number));
            }
            if (++visits > model_.nodes.size()) {
                return failure("the nodes of the glTF file are no tree");
            }
            const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(number)];
            const Matrix matrix = product(above, matrix_of(node));
            if (node.mesh >= 0) {
                if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) {
                    return failure(fmt::format("mesh {} of the glTF file is not there", node.mesh));
                }
                const auto added =
                    add_mesh(model_.meshes[static_cast<std::size_t>(node.mesh)], matrix);
                if (!added) return added;
            }
            for (const int child : node.children) waiting.emplace_back(child, matrix);
        }
        return {};
    }

    Result<void> add_mesh(const tinygltf::Mesh& mesh, const Matrix& matrix) {
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            const bool has_triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                                       primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                                       primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN ||
                                       primitive.mode == -1;
            if (!has_triangles) continue;  // Points and lines have no surface.
            if (const auto added = add_triangles(primitive, matrix); !added) return added;
        }
        return {};
    }

    Result<void> add_triangles(const tinygltf::Primitive& primitive, const Matrix& matrix) {
        const auto attribute = [&](const char* name) -> std::optional<Numbers> {
            const auto found = primitive.attributes.find(name);
            if (found == primitive.attributes.end()) return {};
            return Numbers::of(model_, found->second);
        };
        if (primitive.extensions.contains("KHR_draco_mesh_compression")) {
            return failure("the glTF file is compressed by Draco, which is not read",
                           "export it without compression");
        }
        const std::optional<Numbers> places = attribute("POSITION");
        if (!places || places->components() != 3) {
            return failure("the glTF file has triangles without places or beyond its data");
        }
        const std::size_t first = soup_.points.size();
        if (places->count() > bounds_.points - first) {
            return failure(fmt::format(
                "the glTF file has more than {} points, too many for its size", bounds_.points));
        }
        for (std::size_t k = 0; k < places->count(); ++k) {
            soup_.points.push_back(
                place(matrix, {places->at(k, 0), places->at(k, 1), places->at(k, 2)}));
        }
        add_colours(attribute("COLOR_0"), first);

        const std::optional<Numbers> texture = attribute("TEXCOORD_0");
        const bool has_texture =
            texture && texture->components() == 2 && texture->count() == places->count();
        all_have_texture_ = all_have_texture_ && has_texture;
        std::optional<Numbers> indices;
        if (primitive.indices >= 0) {
            indices = Numbers::of(model_, primitive.indices);
            if (!indices) return failure("the triangles of the glTF file lie beyond its data");
        }
        const std::size_t count = indices ? indices->count() : places->count();
        for (std::size_t k = 0; k < count && indices; ++k) {
            const double point = indices->at(k, 0);
            if (!(point >= 0 && point < static_cast<double>(places->count())) ||
                point != std::floor(point)) {
                return failure(
                    fmt::format("a triangle of the glTF file names point {}, but there are "
                                "only {}",
                                point, places->count()));
            }
        }
        const auto add_triangle = [&](std::initializer_list<std::size_t> corners) {
            for (const std::size_t c : corners) {
                const std::size_t number =
                    indices ? static_cast<std::size_t>(indices->at(c, 0)) : c;
                soup_.corners.push_back(static_cast<std::uint32_t>(first + number));
                // glTF has the origin at the upper left.
                soup_.texture.push_back(
                    has_texture ? TexturePlace{static_cast<float>(texture->at(number, 0)),
                                               static_cast<float>(1 - texture->at(number, 1))}
                                : TexturePlace{});
            }
            soup_.ends.push_back(soup_.corners.size());
        };
        const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const bool is_fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        if (count > (bounds_.corners - soup_.corners.size()) / 3) {
            return failure(fmt::format(
                "the glTF file has more than {} corners, too many for its size", bounds_.corners));
        }
        for (std::size_t k = 0; k + 2 < count; k += is_strip || is_fan ? 1 : 3) {
            if (is_fan) add_triangle({0, k + 1, k + 2});
            else if (is_strip && k % 2 == 1) add_triangle({k + 1, k, k + 2});
            else add_triangle({k, k + 1, k + 2});
        }
        return {};
    }

    void add_colours(const std::optional<Numbers>& colours, std::size_t first) {
        const std::size_t count = soup_.points.size() - first;
        const bool has_colours = colours && colours->components() >= 3 && colours->count() == count;
        any_colour_ = any_colour_ || has_colours;
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t k = 0; k < count; ++k) {
                colours_[c].values.push_back(has_colours ? static_cast<float>(colours->at(k, c))
                                                         : 1.0F);
            }
        }
    }

    const tinygltf::Model& model_;
    const Bounds bounds_;
    PolygonSoup soup_;
    bool all_have_texture_ = true;
    bool any_colour_ = false;
    std::array<PointAttribute, 3> colours_{PointAttribute{"red", {}}, PointAttribute{"green", {}},
                                           PointAttribute{"blue", {}}};
};

/// Checks the size of the JSON text: tinygltf needs hundreds of bytes for some objects of two
/// bytes, and recurses at each level.
Result<void> check_json(std::string_view json) {
    const JsonSize size = measure_json(json);
    if (size.depth > deepest_nesting) {
        return failure(fmt::format("the glTF file nests more than {} lists", deepest_nesting));
    }
    constexpr std::size_t bytes_of_object = 1000, bytes_of_value = 200;
    const std::size_t wanted = bytes_of_object * size.objects + bytes_of_value * size.values;
    if (wanted > (std::size_t{48} << 20) + 64 * json.size()) {
        return failure("the glTF file has more objects than a model needs");
    }
    return {};
}

/// The JSON text of a binary file: its length is at byte 12, and it begins at byte 20.
std::string_view json_of(std::string_view bytes, bool is_binary) {
    if (!is_binary || bytes.size() < 20) return bytes;
    std::uint32_t length = 0;
    for (std::size_t k = 4; k-- > 0;)
        length = length << 8 | static_cast<unsigned char>(bytes[12 + k]);
    return bytes.substr(20, length);
}

/// Callbacks for reading external buffers. tinygltf's own open any file and use a shell.
class Buffers {
public:
    explicit Buffers(const GrantedFiles& files) : files_(files) {}

    tinygltf::FsCallbacks callbacks() {
        tinygltf::FsCallbacks calls{};
        calls.FileExists = [](const std::string&, void*) { return true; };  // Reading will fail.
        calls.ExpandFilePath = [](const std::string& name, void*) { return name; };
        calls.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*,
                                 const std::string& name, void* self) {
            return static_cast<Buffers*>(self)->read(name, *out);
        };
        calls.WriteWholeFile = [](std::string*, const std::string&,
                                  const std::vector<unsigned char>&, void*) { return false; };
        calls.user_data = this;
        return calls;
    }

    /// Why a buffer could not be read.
    const std::optional<Failure>& failure() const { return failure_; }

private:
    bool read(const std::string& name, std::vector<unsigned char>& out) {
        const Result<std::string> bytes = files_.read(name, largest_model_file);
        if (!bytes) failure_ = bytes.error();
        else out.assign(bytes->begin(), bytes->end());
        return bytes.has_value();
    }

    const GrantedFiles& files_;
    std::optional<Failure> failure_;
};

bool load(std::string_view bytes, bool is_binary, Buffers& buffers, tinygltf::Model& model,
          std::string& fault) {
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    reader.SetFsCallbacks(buffers.callbacks());
    std::string warning;
    const auto size = static_cast<unsigned>(bytes.size());
    try {  // An empty buffer makes the library throw std::out_of_range.
        return is_binary
                   ? reader.LoadBinaryFromMemory(
                         &model, &fault, &warning,
                         reinterpret_cast<const unsigned char*>(bytes.data()), size)
                   : reader.LoadASCIIFromString(&model, &fault, &warning, bytes.data(), size, "");
    } catch (const std::logic_error& error) {
        fault = error.what();
        return false;
    }
}

}  // namespace

Result<PolygonSoup> read_gltf(std::string_view bytes, const GrantedFiles& files) {
    const bool is_binary = bytes.starts_with("glTF");
    if (bytes.size() > std::numeric_limits<unsigned>::max())
        return failure("the glTF file is too large");
    if (auto good = check_json(json_of(bytes, is_binary)); !good)
        return tl::unexpected(good.error());
    tinygltf::Model model;
    std::string fault;
    Buffers buffers(files);
    if (!load(bytes, is_binary, buffers, model, fault)) {
        if (buffers.failure()) return tl::unexpected(*buffers.failure());
        while (fault.ends_with('\n')) fault.pop_back();
        std::replace(fault.begin(), fault.end(), '\n', ' ');
        return failure("this is no glTF file that can be read", fault);
    }
    std::size_t size = bytes.size();
    for (const tinygltf::Buffer& buffer : model.buffers) size += buffer.data.size();
    return SceneReader(model, Bounds(size)).read();
}

}  // namespace cascade
