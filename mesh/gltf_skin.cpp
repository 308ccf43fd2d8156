// A point's matrix is the weighted mean over its joints. Each joint contributes the inverse of its
// matrix at the time of binding, followed by its matrix in the scene.
#include "mesh/gltf_skin.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade {

GltfNodePlaces::GltfNodePlaces(const tinygltf::Model& model)
    : model_(model), parents_(model.nodes.size(), -1), places_(model.nodes.size()) {
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        for (const int child : model.nodes[node].children) {
            if (part_of(model.nodes, child)) {
                parents_[static_cast<std::size_t>(child)] = static_cast<int>(node);
            }
        }
    }
}

Result<GltfMatrix> GltfNodePlaces::of(int node) {
    // Goes up to the first node whose matrix is known, and from there down to `node`.
    std::vector<std::size_t> path;
    GltfMatrix place = gltf_identity;
    for (int at = node; at >= 0; at = parents_[static_cast<std::size_t>(at)]) {
        const auto number = static_cast<std::size_t>(at);
        if (number >= places_.size()) {
            return failure(fmt::format("the glTF file has no node {}", at));
        }
        if (places_[number]) {
            place = *places_[number];
            break;
        }
        path.push_back(number);
        if (path.size() > places_.size())
            return failure("the nodes of the glTF file do not form a tree");
    }
    for (; !path.empty(); path.pop_back()) {
        place = product(place, matrix_of_node(model_.nodes[path.back()]));
        places_[path.back()] = place;
    }
    return place;
}

GltfMatrix matrix_of_node(const tinygltf::Node& node) {
    if (node.matrix.size() != 16) {
        return matrix_of_parts(node.translation, node.rotation, node.scale);
    }
    GltfMatrix matrix;
    std::copy(node.matrix.begin(), node.matrix.end(), matrix.begin());
    return matrix;
}

Result<std::vector<GltfMatrix>> joints_of_skin(const tinygltf::Model& model, int number,
                                               GltfNodePlaces& places) {
    const tinygltf::Skin* const skin = part_of(model.skins, number);
    if (!skin) return failure(fmt::format("the glTF file has no skin {}", number));
    std::optional<GltfNumbers> bound;  // nullopt means identity matrices.
    if (skin->inverseBindMatrices >= 0) {
        bound = GltfNumbers::of(model, skin->inverseBindMatrices);
        if (!bound || bound->components() != 16 || bound->count() < skin->joints.size()) {
            return failure(fmt::format(
                "skin {} of the glTF file has fewer matrices than joints, or has matrices beyond "
                "its data",
                number));
        }
    }
    std::vector<GltfMatrix> joints;
    for (std::size_t k = 0; k < skin->joints.size(); ++k) {
        const int node = skin->joints[k];
        if (node < 0) return failure(fmt::format("the glTF file has no node {}", node));
        Result<GltfMatrix> place = places.of(node);
        if (!place) return tl::unexpected(place.error());
        if (bound) {
            GltfMatrix inverse;
            for (std::size_t c = 0; c < 16; ++c) inverse[c] = bound->at(k, c);
            place = product(*place, inverse);
        }
        joints.push_back(*place);
    }
    return joints;
}

Result<GltfWeights> GltfWeights::of(const tinygltf::Model& model,
                                    const tinygltf::Primitive& primitive, std::size_t count) {
    GltfWeights weights;
    for (int set = 0;; ++set) {
        const auto joints = primitive.attributes.find(fmt::format("JOINTS_{}", set));
        const auto shares = primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
        const auto end = primitive.attributes.end();
        if (joints == end && shares == end) return weights;
        const auto at = [&](auto found) -> std::optional<GltfNumbers> {
            if (found == end) return {};
            auto numbers = GltfNumbers::of(model, found->second);
            if (numbers && (numbers->components() != 4 || numbers->count() < count)) return {};
            return numbers;
        };
        const auto of_joints = at(joints), of_shares = at(shares);
        if (!of_joints || !of_shares) {
            return failure(
                "the skinned points of the glTF file lack joints or weights, or have them "
                "beyond its data");
        }
        weights.sets_.push_back({*of_joints, *of_shares});
    }
}

Result<GltfMatrix> GltfWeights::matrix_at(std::size_t point,
                                          const std::vector<GltfMatrix>& joints) const {
    const auto joint = [&](const Set& set, std::size_t k) -> const GltfMatrix* {
        const double number = set.joints.at(point, k);
        const bool is_there = number >= 0 && number < static_cast<double>(joints.size());
        return is_there ? &joints[static_cast<std::size_t>(number)] : nullptr;
    };
    GltfMatrix sum{};
    double all = 0;
    for (const Set& set : sets_) {
        for (std::size_t k = 0; k < 4; ++k) {
            const double weight = set.weights.at(point, k);
            if (!(weight != 0)) continue;
            const GltfMatrix* const matrix = joint(set, k);
            if (!matrix) {
                return failure(
                    fmt::format("a point of the glTF file follows joint {}, but its "
                                "skin has only {}",
                                set.joints.at(point, k), joints.size()));
            }
            for (std::size_t c = 0; c < 16; ++c) sum[c] += weight * (*matrix)[c];
            all += weight;
        }
    }
    if (all == 0) {
        const GltfMatrix* const first = joint(sets_.front(), 0);
        return first ? *first : gltf_identity;
    }
    for (double& number : sum) number /= all;
    return sum;
}

}  // namespace cascade
