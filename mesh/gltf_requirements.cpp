// Checks requirements separately, because tinygltf ignores required extensions and reports a
// compressed file as broken.
#include "mesh/gltf_requirements.h"

#include "core/json_size.h"
#include "core/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace cascade {

namespace {

using GltfJson = nlohmann::json;

constexpr std::size_t deepest_nesting = 128;

/// Extensions that the reader knows how to apply, or refuses where a file needs their data.
constexpr std::array applied_extensions = {
    "EXT_mesh_gpu_instancing", "KHR_texture_transform",   "KHR_mesh_quantization",
    "EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_draco_mesh_compression",
    "KHR_node_visibility",
};

/// Extensions that do not change shapes, positions and texture coordinates. The same is true of
/// extensions that begin with one of look_prefixes.
constexpr std::array beside_the_shape = {
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "EXT_texture_avif",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_animation_pointer",
    "KHR_techniques_webgl",
    "KHR_texture_basisu",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_lod",
    "MSFT_texture_dds",
    "EXT_mesh_manifold",
};
constexpr std::array look_prefixes = {"KHR_materials_", "EXT_materials_", "ADOBE_materials_",
                                      "MSFT_packing_"};

/// A member of an object; null if the object lacks the member.
const GltfJson* member(const GltfJson* object, const char* name) {
    if (!object || !object->is_object()) return nullptr;
    const auto found = object->find(name);
    return found == object->end() ? nullptr : &*found;
}

/// The entry of a list whose index is `number`; null if the list lacks the entry.
const GltfJson* entry(const GltfJson* list, const GltfJson* number) {
    if (!list || !list->is_array() || !number || !number->is_number_integer()) return nullptr;
    const auto place = number->get<std::int64_t>();
    if (place < 0 || place >= static_cast<std::int64_t>(list->size())) return nullptr;
    return &(*list)[static_cast<std::size_t>(place)];
}

const GltfJson* extension(const GltfJson* part, const char* name) {
    return member(member(part, "extensions"), name);
}

/// Calls `visit` for each entry of a list, until a call fails.
template <typename Visit>
Result<void> for_each_entry(const GltfJson* list, const Visit& visit) {
    if (!list || !list->is_array()) return {};
    for (const GltfJson& each : *list) {
        if (Result<void> done = visit(each); !done) return done;
    }
    return {};
}

Result<void> check_version(const GltfJson& file) {
    const GltfJson* const least = member(member(&file, "asset"), "minVersion");
    if (least && least->is_string() && least->get_ref<const std::string&>() > "2.0") {
        return failure(fmt::format("the glTF file requires version {}, but only version 2.0 can "
                                   "be read",
                                   short_name(least->get_ref<const std::string&>(), 20)),
                       "export it as version 2.0");
    }
    const GltfJson* const version = member(member(&file, "asset"), "version");
    const GltfJson* const meshes = member(&file, "meshes");
    // Files of version 1 may omit the version, and have objects where later versions have lists.
    const bool is_old = (version && version->is_string() &&
                         version->get_ref<const std::string&>().starts_with("1")) ||
                        (!version && meshes && meshes->is_object());
    if (!is_old) return {};
    return failure("this is a glTF file of version 1, but only version 2 can be read",
                   "export it as version 2, which most modelling programs can write");
}

Result<void> check_extension(const GltfJson& name) {
    if (!name.is_string()) return {};
    const std::string& text = name.get_ref<const std::string&>();
    if (is_known_extension(text)) return {};
    return failure(fmt::format("the glTF file requires the extension '{}', which Cascade cannot "
                               "read",
                               short_name(text)),
                   "export it without this extension");
}

/// Fails if a buffer view has bytes only in a compressed form.
Result<void> check_view(const GltfJson& file, const GltfJson& view) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        if (!extension(&view, name)) continue;
        const GltfJson* const number = member(&view, "buffer");
        const GltfJson* const buffer = entry(member(&file, "buffers"), number);
        const bool has_bytes =
            member(buffer, "uri") || (number && *number == 0 && !extension(buffer, name));
        if (buffer && has_bytes) continue;
        return failure(fmt::format("the glTF file is compressed by Meshopt ({}), which Cascade "
                                   "cannot read",
                                   name),
                       "export it without compression, or decompress it");
    }
    return {};
}

/// Fails if triangles are compressed by Draco and have no uncompressed copy.
Result<void> check_primitive(const GltfJson& file, const GltfJson& primitive) {
    constexpr const char* name = "KHR_draco_mesh_compression";
    if (!extension(&primitive, name)) return {};
    const GltfJson* const accessors = member(&file, "accessors");
    const auto is_plain = [&](const GltfJson* number) {
        return member(entry(accessors, number), "bufferView") != nullptr;
    };
    const GltfJson* const indices = member(&primitive, "indices");
    if (is_plain(member(member(&primitive, "attributes"), "POSITION")) &&
        (!indices || is_plain(indices))) {
        return {};
    }
    return failure(fmt::format("the glTF file is compressed by Draco ({}), which Cascade cannot "
                               "read",
                               name),
                   "export it without compression");
}

/// Fails if the accessor of corners is sparse and has no base data. tinygltf refuses such files,
/// too, but gives no reason.
Result<void> check_corners(const GltfJson& file, const GltfJson& primitive) {
    const GltfJson* const corners =
        entry(member(&file, "accessors"), member(&primitive, "indices"));
    if (!corners || !member(corners, "sparse") || member(corners, "bufferView")) return {};
    return failure(
        "the glTF file stores the corners of triangles as sparse values without a base, which "
        "Cascade cannot read",
        "export it without sparse indices");
}

}  // namespace

Result<void> check_gltf_size(std::string_view json) {
    // tinygltf needs hundreds of bytes of memory for some objects of two bytes, and recurses at
    // each level.
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

bool is_known_extension(std::string_view name) {
    const auto is_in = [&](const auto& list) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    return is_in(applied_extensions) || is_in(beside_the_shape) ||
           std::any_of(look_prefixes.begin(), look_prefixes.end(),
                       [&](std::string_view prefix) { return name.starts_with(prefix); });
}

Result<void> check_gltf_requirements(std::string_view json) {
    const GltfJson file = GltfJson::parse(json, nullptr, false);
    if (!file.is_object()) return {};
    if (auto good = check_version(file); !good) return good;
    if (auto good = for_each_entry(member(&file, "extensionsRequired"), check_extension); !good) {
        return good;
    }
    // Checks Draco first: in a file with both extensions, the message about Draco says more.
    const auto check_mesh = [&](const GltfJson& mesh) {
        return for_each_entry(member(&mesh, "primitives"), [&](const GltfJson& primitive) {
            auto good = check_primitive(file, primitive);
            return good ? check_corners(file, primitive) : good;
        });
    };
    if (auto good = for_each_entry(member(&file, "meshes"), check_mesh); !good) return good;
    return for_each_entry(member(&file, "bufferViews"),
                          [&](const GltfJson& view) { return check_view(file, view); });
}

}  // namespace cascade
