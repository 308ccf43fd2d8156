// Adds to each value of the mesh what its morph targets change, times their weights.
#include "mesh/gltf_points.h"

namespace cascade {

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
                "a morph target of the glTF file has too few points, or lies beyond "
                "its data");
        }
        attribute.targets_.push_back({weights[k], *shift});
    }
    return attribute;
}

}  // namespace cascade
