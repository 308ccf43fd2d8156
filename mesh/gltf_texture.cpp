// The rotation is counterclockwise in the picture, as in the extension's example.
#include "mesh/gltf_texture.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace cascade {

namespace {

double number_or(const tinygltf::Value& list, std::size_t place, double otherwise) {
    if (!list.IsArray() || place >= list.ArrayLen()) return otherwise;
    const tinygltf::Value& value = list.Get(static_cast<int>(place));
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

/// Applies the extension's transformation of a texture.
void apply_transform(const tinygltf::Value& said, GltfTexture& texture, int& set) {
    if (!said.IsObject()) return;
    const tinygltf::Value &offset = said.Get("offset"), &scale = said.Get("scale"),
                          &rotation = said.Get("rotation"), &other_set = said.Get("texCoord");
    const double angle = rotation.IsNumber() ? rotation.GetNumberAsDouble() : 0;
    const double c = std::cos(angle), s = std::sin(angle);
    const double along_u = number_or(scale, 0, 1), along_v = number_or(scale, 1, 1);
    texture.rows = {c * along_u,  s * along_v, number_or(offset, 0, 0),
                    -s * along_u, c * along_v, number_or(offset, 1, 0)};
    if (other_set.IsInt()) set = other_set.GetNumberAsInt();
}

template <typename Info>
GltfTexture described_by(const Info& info) {
    GltfTexture texture;
    int set = info.texCoord;
    const auto transform = info.extensions.find("KHR_texture_transform");
    if (transform != info.extensions.end()) apply_transform(transform->second, texture, set);
    texture.attribute = fmt::format("TEXCOORD_{}", set);
    return texture;
}

/// The texture of colours by the old extension KHR_materials_pbrSpecularGlossiness, if the material
/// has one.
std::optional<GltfTexture> diffuse_texture(const tinygltf::Material& material) {
    const auto found = material.extensions.find("KHR_materials_pbrSpecularGlossiness");
    if (found == material.extensions.end() || !found->second.IsObject()) return {};
    const tinygltf::Value& info = found->second.Get("diffuseTexture");
    if (!info.IsObject()) return {};
    tinygltf::TextureInfo read;
    if (info.Get("texCoord").IsInt()) read.texCoord = info.Get("texCoord").GetNumberAsInt();
    const tinygltf::Value& extensions = info.Get("extensions");
    const char* const transform = "KHR_texture_transform";
    if (extensions.IsObject()) read.extensions[transform] = extensions.Get(transform);
    return described_by(read);
}

GltfTexture texture_of_material(const tinygltf::Material& material) {
    const auto& shine = material.pbrMetallicRoughness;
    if (shine.baseColorTexture.index >= 0) return described_by(shine.baseColorTexture);
    if (const auto texture = diffuse_texture(material)) return *texture;
    if (material.normalTexture.index >= 0) return described_by(material.normalTexture);
    if (shine.metallicRoughnessTexture.index >= 0) {
        return described_by(shine.metallicRoughnessTexture);
    }
    if (material.emissiveTexture.index >= 0) return described_by(material.emissiveTexture);
    if (material.occlusionTexture.index >= 0) return described_by(material.occlusionTexture);
    return {};
}

}  // namespace

TexturePlace GltfTexture::place(double u, double v) const {
    return {static_cast<float>(rows[0] * u + rows[1] * v + rows[2]),
            static_cast<float>(1 - (rows[3] * u + rows[4] * v + rows[5]))};
}

GltfTexture texture_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    const tinygltf::Material* const material = part_of(model.materials, primitive.material);
    if (!material) return {};
    GltfTexture texture = texture_of_material(*material);
    return primitive.attributes.contains(texture.attribute) ? texture : GltfTexture{};
}

}  // namespace cascade
