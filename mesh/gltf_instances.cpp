// Each attribute is an accessor with one element per copy. Names of custom attributes begin with an
// underscore.
#include "mesh/gltf_instances.h"

#include "core/quaternion.h"

#include <array>

namespace cascade {

namespace {

std::vector<double> element_of(const std::optional<GltfNumbers>& numbers, std::size_t k) {
    std::vector<double> element;
    if (!numbers) return element;
    for (std::size_t c = 0; c < numbers->components(); ++c) element.push_back(numbers->at(k, c));
    return element;
}

}  // namespace

Result<GltfInstances> GltfInstances::of(const tinygltf::Model& model, const tinygltf::Node& node) {
    GltfInstances instances;
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    if (found == node.extensions.end()) return instances;
    const auto wrong = [] {
        return failure(
            "the copies of a mesh (EXT_mesh_gpu_instancing) in the glTF file lie beyond its data, "
            "or have different numbers of positions, rotations and sizes");
    };
    if (!found->second.IsObject() || !found->second.Get("attributes").IsObject()) return wrong();
    const tinygltf::Value& attributes = found->second.Get("attributes");
    bool has_bytes = false;
    const auto read = [&](const char* name, std::size_t components,
                          std::optional<GltfNumbers>& numbers) {
        const tinygltf::Value& number = attributes.Get(name);
        if (number.Type() == tinygltf::NULL_TYPE) return true;
        if (!number.IsInt()) return false;
        numbers = GltfNumbers::of(model, number.GetNumberAsInt());
        if (!numbers || numbers->components() != components) return false;
        has_bytes = has_bytes || numbers->has_bytes();
        if (instances.count_ && *instances.count_ != numbers->count()) return false;
        instances.count_ = numbers->count();
        return true;
    };
    if (!read("TRANSLATION", 3, instances.translation_) ||
        !read("ROTATION", 4, instances.rotation_) || !read("SCALE", 3, instances.scale_)) {
        return wrong();
    }
    const tinygltf::Value& colour = attributes.Get("_COLOR_0");
    if (colour.IsInt()) instances.colour_ = GltfNumbers::of(model, colour.GetNumberAsInt());
    // If there is no attribute of translation, rotation or scale, all copies would coincide, so one
    // copy is enough.
    if (!instances.count_) instances.count_ = 1;
    else if (!has_bytes && *instances.count_ > 0) return wrong();
    return instances;
}

GltfMatrix GltfInstances::matrix(std::size_t copy) const {
    std::vector<double> turn = element_of(rotation_, copy);
    if (!turn.empty()) {
        // Quaternions of normalized integers are only nearly of length 1.
        const Quaternion q = of_length_1({turn[3], turn[0], turn[1], turn[2]});
        turn = {q.x, q.y, q.z, q.w};
    }
    return matrix_of_parts(element_of(translation_, copy), turn, element_of(scale_, copy));
}

std::optional<std::array<double, 3>> GltfInstances::light(std::size_t copy) const {
    if (!colour_ || colour_->components() < 3 || copy >= colour_->count()) return {};
    return std::array{colour_->at(copy, 0), colour_->at(copy, 1), colour_->at(copy, 2)};
}

}  // namespace cascade
