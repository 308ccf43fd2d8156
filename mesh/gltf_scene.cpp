// Visits nodes iteratively and limits the number of placements, because a hostile file may nest
// nodes deeply or in cycles, or place the same data again and again.
#include "mesh/gltf_scene.h"

#include "core/result.h"
#include "mesh/gltf_instances.h"
#include "mesh/gltf_matrix.h"
#include "mesh/gltf_model.h"
#include "mesh/gltf_numbers.h"
#include "mesh/gltf_skin.h"
#include "mesh/gltf_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

namespace {

/// The position, shape and light of a mesh.
struct GltfPlacing {
    const GltfMatrix&
        matrix;  ///< The node's matrix. It is not applied to points that a skin positions.
    const std::vector<GltfMatrix>* joints;  ///< The joints' matrices; null without a skin.
    std::span<const double> weights;        ///< The morph targets' weights; 0 for missing weights.
    /// The factors by which a copy's colours are multiplied.
    std::optional<std::array<double, 3>> light = {};
};

/// Whether a matrix mirrors, which reverses the orientation of triangles.
bool mirrors(const GltfMatrix& m) {
    const auto column = [&](std::size_t k) {
        return Vector3d{m[4 * k], m[4 * k + 1], m[4 * k + 2]};
    };
    return dot(cross(column(0), column(1)), column(2)) < 0;
}

/// An attribute of a primitive with its morph targets.
class MorphedAttribute {
public:
    /// nullopt if the primitive has no such attribute, or if the attribute has fewer than `least`
    /// components or exceeds the file's data. Targets that lack the attribute do not change it.
    /// Fails if a target has fewer points than the attribute or exceeds the data.
    static Result<std::optional<MorphedAttribute>> of(const tinygltf::Model& model,
                                                      const tinygltf::Primitive& primitive,
                                                      const std::string& name, std::size_t least,
                                                      std::span<const double> weights);

    std::size_t count() const { return base_.count(); }
    std::size_t components() const { return base_.components(); }
    /// The number of arrays that add up to a value: the base and the targets.
    std::size_t parts() const { return 1 + targets_.size(); }
    double at(std::size_t element, std::size_t component) const {
        double sum = base_.at(element, component);
        for (const Target& target : targets_) {
            if (component < target.shift.components())
                sum += target.weight * target.shift.at(element, component);
        }
        return sum;
    }

private:
    struct Target {
        double weight;
        GltfNumbers shift;
    };
    explicit MorphedAttribute(const GltfNumbers& base) : base_(base) {}
    GltfNumbers base_;
    std::vector<Target> targets_;  ///< Targets with weights other than 0.
};

Result<std::optional<MorphedAttribute>> MorphedAttribute::of(const tinygltf::Model& model,
                                                             const tinygltf::Primitive& primitive,
                                                             const std::string& name,
                                                             std::size_t least,
                                                             std::span<const double> weights) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return std::nullopt;
    const auto base = GltfNumbers::of(model, found->second);
    if (!base || base->components() < least) return std::nullopt;
    MorphedAttribute attribute(*base);
    for (std::size_t k = 0; k < std::min(weights.size(), primitive.targets.size()); ++k) {
        const auto target = primitive.targets[k].find(name);
        if (weights[k] == 0 || target == primitive.targets[k].end()) continue;
        const auto shift = GltfNumbers::of(model, target->second);
        if (!shift || shift->count() < base->count()) {
            return failure(
                "a morph target of the glTF file has too few points, or its data lie beyond the "
                "end of the file's data");
        }
        attribute.targets_.push_back({weights[k], *shift});
    }
    return attribute;
}

/// The steps that one copy costs: the numbers and matrices that are read.
constexpr std::size_t steps_of_copy = 8;

/// Limits on the data that a file may place, derived from its size. Even a small file can use the
/// same mesh or list the same triangles any number of times. A copy takes only a few bytes in the
/// file but may have thousands of triangles. Small files get an allowance.
struct SceneBounds {
    std::size_t points, corners, steps;

    SceneBounds(std::size_t bytes, bool has_copies)
        : points(std::min(std::size_t{1} << 27, (std::size_t{1} << 18) + bytes)),
          corners(std::min(std::size_t{1} << 29, (std::size_t{1} << 20) + 4 * bytes)),
          steps((std::size_t{1} << 24) + 16 * std::min(bytes, std::size_t{1} << 36)) {
        if (!has_copies) return;
        constexpr std::size_t copied_triangles = std::size_t{1} << 24;  // Limit for all copies.
        points = std::max(points, std::min(3 * copied_triangles, points + 64 * bytes));
        corners = std::max(corners, std::min(3 * copied_triangles, corners + 192 * bytes));
    }
};

class SceneReader {
public:
    SceneReader(const tinygltf::Model& model, std::size_t bytes)
        : model_(model), bounds_(bytes, has_copies(model)), places_(model) {}

    Result<PolygonSoup> read() {
        if (model_.scenes.empty()) {
            for (const tinygltf::Mesh& mesh : model_.meshes) {
                const auto added = add_mesh(mesh, {gltf_identity, nullptr, mesh.weights});
                if (!added) return tl::unexpected(added.error());
            }
        } else {
            const tinygltf::Scene* const scene =
                part_of(model_.scenes, std::max(0, model_.defaultScene));
            if (!scene) return failure("the glTF file has no such scene");
            for (const int node : scene->nodes) {
                if (const auto added = add_nodes(node); !added) {
                    return tl::unexpected(added.error());
                }
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
    static bool has_copies(const tinygltf::Model& model) {
        return std::any_of(model.nodes.begin(), model.nodes.end(), [](const auto& node) {
            return node.extensions.contains("EXT_mesh_gpu_instancing");
        });
    }

    /// Whether KHR_node_visibility hides the node. Its descendants are then hidden, too.
    static bool is_hidden(const tinygltf::Node& node) {
        const auto visibility = node.extensions.find("KHR_node_visibility");
        if (visibility == node.extensions.end() || !visibility->second.IsObject()) return false;
        const tinygltf::Value& visible = visibility->second.Get("visible");
        return visible.IsBool() && !visible.Get<bool>();
    }

    /// Counts steps of work that may add only a few points and corners, or none. Fails when the
    /// total exceeds the file's limit.
    Result<void> take_steps(std::size_t arrays, std::size_t length = 1) {
        if (length > 0 && arrays > (bounds_.steps - steps_) / length) {
            return failure(
                "the glTF file reads its data more often than a file of this size "
                "should");
        }
        steps_ += arrays * length;
        return {};
    }

    /// Adds a node and its descendants.
    Result<void> add_nodes(int root) {
        std::vector<std::pair<int, GltfMatrix>> waiting = {{root, gltf_identity}};
        std::size_t visits = 0;
        while (!waiting.empty()) {
            const auto [number, above] = waiting.back();
            waiting.pop_back();
            const tinygltf::Node* const node = part_of(model_.nodes, number);
            if (!node) return failure(fmt::format("the glTF file has no node {}", number));
            if (++visits > model_.nodes.size()) {
                return failure("the nodes of the glTF file do not form a tree");
            }
            if (is_hidden(*node)) continue;
            const GltfMatrix matrix = product(above, matrix_of_node(*node));
            if (node->mesh >= 0) {
                if (auto added = add_mesh_of(*node, matrix); !added) return added;
            }
            for (const int child : node->children) waiting.emplace_back(child, matrix);
        }
        return {};
    }

    Result<void> add_mesh_of(const tinygltf::Node& node, const GltfMatrix& matrix) {
        const tinygltf::Mesh* const mesh = part_of(model_.meshes, node.mesh);
        if (!mesh) return failure(fmt::format("the glTF file has no mesh {}", node.mesh));
        const std::span<const double> weights = node.weights.empty() ? mesh->weights : node.weights;
        const auto copies = GltfInstances::of(model_, node);
        if (!copies) return tl::unexpected(copies.error());
        if (node.skin >= 0) {
            if (copies->is_there()) {
                return failure("copies of a skinned mesh in the glTF file are not read");
            }
            const auto joints = joints_of(node.skin);
            if (!joints) return tl::unexpected(joints.error());
            return add_mesh(*mesh, {matrix, *joints, weights});
        }
        if (!copies->is_there()) return add_mesh(*mesh, {matrix, nullptr, weights});
        for (std::size_t k = 0; k < copies->count(); ++k) {
            if (auto good = take_steps(steps_of_copy); !good) return good;
            const GltfMatrix placed = product(matrix, copies->matrix(k));
            const GltfPlacing placing{placed, nullptr, weights, copies->light(k)};
            if (auto added = add_mesh(*mesh, placing); !added) return added;
        }
        return {};
    }

    /// The matrices of a skin's joints. Many nodes may share a skin.
    Result<const std::vector<GltfMatrix>*> joints_of(int skin) {
        const auto known = joints_.find(skin);
        if (known != joints_.end()) return &known->second;
        auto joints = joints_of_skin(model_, skin, places_);
        if (!joints) return tl::unexpected(joints.error());
        return &joints_.emplace(skin, *std::move(joints)).first->second;
    }

    Result<void> add_mesh(const tinygltf::Mesh& mesh, const GltfPlacing& placing) {
        if (auto good = take_steps(1); !good) return good;
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            if (auto good = take_steps(1 + primitive.targets.size()); !good) return good;
            const bool has_triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                                       primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                                       primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN ||
                                       primitive.mode == -1;
            if (!has_triangles) continue;  // Points and lines have no surface.
            const std::size_t first = soup_.points.size();
            if (auto added = add_points(primitive, placing); !added) return added;
            if (auto added = add_triangles(primitive, placing, first); !added) return added;
        }
        return {};
    }

    Result<void> add_points(const tinygltf::Primitive& primitive, const GltfPlacing& placing) {
        const auto morphed =
            MorphedAttribute::of(model_, primitive, "POSITION", 3, placing.weights);
        if (!morphed) return tl::unexpected(morphed.error());
        const std::optional<MorphedAttribute>& places = *morphed;
        if (!places || places->components() != 3) {
            return failure("the glTF file has triangles without positions or beyond its data");
        }
        const std::size_t first = soup_.points.size(), count = places->count();
        if (count > bounds_.points - first) {
            return failure(fmt::format(
                "the glTF file has more than {} points, too many for its size", bounds_.points));
        }
        auto weights =
            placing.joints ? GltfWeights::of(model_, primitive, count) : Result<GltfWeights>();
        if (!weights) return tl::unexpected(weights.error());
        const std::size_t arrays = places->parts() - 1 + 4 * weights->sets();
        if (auto good = take_steps(arrays, count); !good) return good;
        for (std::size_t k = 0; k < count; ++k) {
            const Vector3d place{places->at(k, 0), places->at(k, 1), places->at(k, 2)};
            if (weights->is_there()) {
                const auto matrix = weights->matrix_at(k, *placing.joints);
                if (!matrix) return tl::unexpected(matrix.error());
                soup_.points.push_back(moved_by(*matrix, place));
            } else {
                soup_.points.push_back(moved_by(placing.matrix, place));
            }
        }
        return add_colours(primitive, placing, first);
    }

    Result<void> add_triangles(const tinygltf::Primitive& primitive, const GltfPlacing& placing,
                               std::size_t first) {
        const std::size_t points = soup_.points.size() - first;
        std::optional<GltfNumbers> indices;
        if (primitive.indices >= 0) {
            indices = GltfNumbers::of(model_, primitive.indices);
            if (!indices) return failure("the triangles of the glTF file lie beyond its data");
        }
        const std::size_t count = indices ? indices->count() : points;
        if (count > (bounds_.corners - soup_.corners.size()) / 3) {
            return failure(fmt::format(
                "the glTF file has more than {} corners, too many for its size", bounds_.corners));
        }
        for (std::size_t k = 0; k < count && indices; ++k) {
            const double point = indices->at(k, 0);
            if (!(point >= 0 && point < static_cast<double>(points)) ||
                point != std::floor(point)) {
                return failure(
                    fmt::format("a triangle of the glTF file names point {}, but there are "
                                "only {}",
                                point, points));
            }
        }
        const auto places = texture_places(primitive, placing, points);
        if (!places) return tl::unexpected(places.error());
        const bool is_mirrored = placing.joints == nullptr && mirrors(placing.matrix);
        const auto add_triangle = [&](std::initializer_list<std::size_t> corners) {
            for (const std::size_t c : corners) {
                const std::size_t number =
                    indices ? static_cast<std::size_t>(indices->at(c, 0)) : c;
                soup_.corners.push_back(static_cast<std::uint32_t>(first + number));
                soup_.texture.push_back(places->empty() ? TexturePlace{} : (*places)[number]);
            }
            if (is_mirrored) {
                std::swap(soup_.corners.end()[-1], soup_.corners.end()[-2]);
                std::swap(soup_.texture.end()[-1], soup_.texture.end()[-2]);
            }
            soup_.ends.push_back(soup_.corners.size());
        };
        const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const bool is_fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        for (std::size_t k = 0; k + 2 < count; k += is_strip || is_fan ? 1 : 3) {
            if (is_fan) add_triangle({0, k + 1, k + 2});
            else if (is_strip && k % 2 == 1) add_triangle({k + 1, k, k + 2});
            else add_triangle({k, k + 1, k + 2});
        }
        return {};
    }

    /// The texture coordinates of each point. Empty if the primitive has no texture coordinates.
    Result<std::vector<TexturePlace>> texture_places(const tinygltf::Primitive& primitive,
                                                     const GltfPlacing& placing,
                                                     std::size_t points) {
        const GltfTexture texture = texture_of(model_, primitive);
        const auto morphed =
            MorphedAttribute::of(model_, primitive, texture.attribute, 2, placing.weights);
        if (!morphed) return tl::unexpected(morphed.error());
        const std::optional<MorphedAttribute>& numbers = *morphed;
        std::vector<TexturePlace> places;
        if (!numbers || numbers->components() != 2 || numbers->count() != points) {
            all_have_texture_ = false;
            return places;
        }
        if (auto good = take_steps(numbers->parts() - 1, points); !good) {
            return tl::unexpected(good.error());
        }
        places.reserve(points);
        for (std::size_t k = 0; k < points; ++k) {
            places.push_back(texture.place(numbers->at(k, 0), numbers->at(k, 1)));
        }
        return places;
    }

    Result<void> add_colours(const tinygltf::Primitive& primitive, const GltfPlacing& placing,
                             std::size_t first) {
        const auto morphed = MorphedAttribute::of(model_, primitive, "COLOR_0", 3, placing.weights);
        if (!morphed) return tl::unexpected(morphed.error());
        const std::optional<MorphedAttribute>& colours = *morphed;
        const std::size_t count = soup_.points.size() - first;
        const bool has_colours = colours && colours->count() == count;
        any_colour_ = any_colour_ || has_colours || placing.light;
        if (has_colours) {
            if (auto good = take_steps(colours->parts() - 1, count); !good) return good;
        }
        const tinygltf::Material* const material = part_of(model_.materials, primitive.material);
        for (std::size_t c = 0; c < 3; ++c) {
            double factor = placing.light ? (*placing.light)[c] : 1;
            if (material && material->pbrMetallicRoughness.baseColorFactor.size() > c)
                factor *= material->pbrMetallicRoughness.baseColorFactor[c];
            for (std::size_t k = 0; k < count; ++k) {
                colours_[c].values.push_back(
                    static_cast<float>(factor * (has_colours ? colours->at(k, c) : 1)));
            }
        }
        return {};
    }

    const tinygltf::Model& model_;
    const SceneBounds bounds_;
    std::size_t steps_ = 0;
    GltfNodePlaces places_;
    std::map<int, std::vector<GltfMatrix>> joints_;  ///< The joints of each skin.
    PolygonSoup soup_;
    bool all_have_texture_ = true;
    bool any_colour_ = false;
    std::array<PointAttribute, 3> colours_{PointAttribute{"red", {}, 1, true},
                                           PointAttribute{"green", {}, 1, true},
                                           PointAttribute{"blue", {}, 1, true}};
};

}  // namespace

Result<PolygonSoup> read_gltf_scene(const tinygltf::Model& model, std::size_t bytes) {
    return SceneReader(model, bytes).read();
}

}  // namespace cascade
