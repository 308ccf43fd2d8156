// Copies that share a mesh and a material are in one node. Nodes of the same mesh share its
// vertices.
#include "export/instanced_model.h"

#include "core/check.h"
#include "core/file_format.h"
#include "core/with_commas.h"
#include "core/write_encoded.h"
#include "export/channels.h"
#include "export/glb_file.h"
#include "export/group_colours.h"
#include "export/model_writer.h"
#include "export/obj.h"
#include "picture/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace cascade {

namespace {

using Json = GlbFile::Json;

constexpr float roughness = 0.6F;  ///< Equal to the default of GlbLook::roughness.

double component(const Quaternion& q, std::size_t c) {
    // In glTF, the real part is last.
    return c == 0 ? q.x : c == 1 ? q.y : c == 2 ? q.z : q.w;
}

bool has_triangles(const InstancedModel& model) {
    return (model.body && !model.body->triangles.empty()) || model.copies.triangle_count() > 0;
}

/// The origin for the coordinates of the body and of the copies. If the copies are merged, `points`
/// are their points.
Result<Vector3d> origin_of(const InstancedModel& model, std::vector<Vector3d> points = {}) {
    CHECK(has_triangles(model), "there is a body or a copy");
    const std::vector<Placement>& placements = model.copies.placements;
    if (model.body) {
        points.insert(points.end(), model.body->points.begin(), model.body->points.end());
    }
    Vector3d low = points.empty() ? placements[0].place : points[0], high = low;
    const auto reach = [&](Vector3d p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    };
    for (const Vector3d& p : points) reach(p);
    for (const Placement& placement : placements) {
        points.push_back(placement.place);
        const double size = length(placement.scale);
        reach(placement.place + Vector3d{size, size, size});
        reach(placement.place - Vector3d{size, size, size});
    }
    Result<Vector3d> origin = origin_of_glb(points, low, high);
    if (!origin) return failure(origin.error().message, "scale the model");
    return origin;
}

void add_body(const InstancedModel& model, GlbFile& file) {
    if (!model.body) return;
    GlbLook look;
    look.colours = model.colours;
    file.add_node({{"mesh", add_model(*model.body, look, file)}});
}

/// The vertices and corners of a small mesh as a primitive without material.
Json primitive_of(const TriangleMesh& mesh, GlbFile& file) {
    const std::size_t count = mesh.positions.size();
    Json attributes;
    attributes["POSITION"] = file.add_places(count, [&](std::size_t k) {
        // Positions are relative to the mesh's own origin, not to the file's.
        const Vector3& p = mesh.positions[k];
        return Vector3d{p.x, p.y, p.z} + file.origin();
    });
    attributes["NORMAL"] = file.add_numbers<float>(
        GlbFile::vertex_buffer, "VEC3", count,
        [&](std::size_t k, std::size_t c) { return GlbFile::component(mesh.normals[k], c); });
    if (!mesh.shades.empty()) {
        attributes["COLOR_0"] =
            file.add_numbers<std::uint8_t>(GlbFile::vertex_buffer, "VEC4", count,
                                           [&](std::size_t k, std::size_t c) {
                                               return c == 3 ? 255u : level_of(mesh.shades[k], 255);
                                           });
    }
    return {{"attributes", attributes}, {"indices", file.add_corners(mesh.triangles, count, true)}};
}

/// The attributes of some copies. `light` is the light of their material.
Json attributes_of(const std::vector<const Placement*>& copies, const Colour& light,
                   GlbFile& file) {
    const std::size_t count = copies.size();
    Json attributes;
    attributes["TRANSLATION"] =
        file.add_numbers<float>(0, "VEC3", count, [&](std::size_t k, std::size_t c) {
            return GlbFile::component(copies[k]->place - file.origin(), c);
        });
    attributes["ROTATION"] =
        file.add_numbers<std::int16_t>(0, "VEC4", count, [&](std::size_t k, std::size_t c) {
            return std::lround(component(copies[k]->turn, c) * 32767);
        });
    attributes["SCALE"] =
        file.add_numbers<float>(0, "VEC3", count, [&](std::size_t k, std::size_t c) {
            return GlbFile::component(copies[k]->scale, c);
        });
    attributes["_COLOR_0"] =
        file.add_numbers<float>(0, "VEC3", count, [&](std::size_t k, std::size_t c) {
            return light[c] > 0 ? light_of(shown(copies[k]->colour)[c]) / light[c] : 1.0F;
        });
    return attributes;
}

void add_copies(const Instances& copies, GlbFile& file) {
    std::vector<Colour> colours;
    for (const Placement& placement : copies.placements) {
        colours.push_back(shown(placement.colour));
    }
    const ColourGroups groups = group_colours(colours, most_copy_materials);
    std::vector<std::size_t> materials;
    for (const Colour& mean : groups.means) {
        const Colour light = light_of(mean);
        Json material = plain_material(roughness);
        material["pbrMetallicRoughness"]["baseColorFactor"] = {light[0], light[1], light[2], 1.0};
        materials.push_back(file.add("materials", std::move(material)));
    }
    // The copies of each node, by their mesh and material.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<const Placement*>> nodes;
    for (std::size_t k = 0; k < copies.placements.size(); ++k) {
        const Placement& placement = copies.placements[k];
        nodes[{placement.mesh, groups.group[k]}].push_back(&placement);
    }
    Json primitive;
    std::uint32_t mesh_of_primitive = 0;
    for (const auto& [key, placements] : nodes) {
        const auto [mesh, group] = key;
        if (copies.meshes[mesh].triangles.empty()) continue;
        if (primitive.empty() || mesh != mesh_of_primitive) {
            primitive = primitive_of(copies.meshes[mesh], file);
            mesh_of_primitive = mesh;
        }
        primitive["material"] = materials[group];
        Json node = {{"mesh", file.add("meshes", {{"primitives", Json::array({primitive})}})}};
        node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] =
            attributes_of(placements, light_of(groups.means[group]), file);
        file.add_node(std::move(node));
    }
}

Colour darkened(const Colour& colour, float shade) {
    if (shade == 1) return colour;
    Colour light = light_of(colour);
    for (float& channel : light) channel *= shade;
    return stored_of(light);
}

void add_merged(const MergedCopies& merged, GlbFile& file) {
    const std::size_t count = merged.points.size();
    Json attributes;
    attributes["POSITION"] =
        file.add_places(count, [&](std::size_t k) { return merged.points[k]; });
    attributes["NORMAL"] = file.add_numbers<float>(
        GlbFile::vertex_buffer, "VEC3", count,
        [&](std::size_t k, std::size_t c) { return GlbFile::component(merged.normals[k], c); });
    attributes["COLOR_0"] = file.add_numbers<std::uint16_t>(
        GlbFile::vertex_buffer, "VEC4", count, [&](std::size_t k, std::size_t c) {
            return c == 3 ? 65535u : level_of(light_of(merged.colours[k][c]), 65535);
        });
    const Json primitive = {{"attributes", attributes},
                            {"indices", file.add_corners(merged.triangles, count, true)},
                            {"material", file.add("materials", plain_material(roughness))}};
    file.add_node({{"mesh", file.add("meshes", {{"primitives", Json::array({primitive})}})}});
}

}  // namespace

Result<std::string> encode_instanced_glb(const InstancedModel& model) {
    const Result<Vector3d> origin = origin_of(model);
    if (!origin) return tl::unexpected(origin.error());
    GlbFile file(*origin);
    add_body(model, file);
    if (model.copies.triangle_count() > 0) {
        file.require("EXT_mesh_gpu_instancing");
        add_copies(model.copies, file);
    }
    return file.pack();
}

Result<MergedCopies> merge_copies(const Instances& copies) {
    const std::uint64_t count = copies.triangle_count();
    if (count > most_merged_triangles) {
        const auto text = [](std::uint64_t number) {
            return with_commas(static_cast<std::int64_t>(number));
        };
        return failure(
            fmt::format("{} copies have {} triangles in total, but at most {} can be merged",
                        text(copies.placements.size()), text(count), text(most_merged_triangles)),
            "leave --merge out, or use coarser shapes");
    }
    MergedCopies merged;
    merged.triangles.reserve(count);
    for (const Placement& placement : copies.placements) {
        const TriangleMesh& mesh = copies.meshes[placement.mesh];
        const PlacementMap map(placement);
        const auto first = static_cast<std::uint32_t>(merged.points.size());
        const Colour colour = shown(placement.colour);
        for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
            const Vector3& p = mesh.positions[k];
            const Vector3d& scale = placement.scale;
            merged.points.push_back(
                placement.place +
                turned(placement.turn, {scale.x * p.x, scale.y * p.y, scale.z * p.z}));
            merged.normals.push_back(map.normal(mesh.normals[k]));
            merged.colours.push_back(darkened(colour, mesh.shades.empty() ? 1 : mesh.shades[k]));
        }
        for (const auto& [a, b, c] : mesh.triangles) {
            merged.triangles.push_back({first + a, first + b, first + c});
        }
    }
    return merged;
}

Result<std::string> encode_merged_glb(const InstancedModel& model) {
    const Result<MergedCopies> merged = merge_copies(model.copies);
    if (!merged) return tl::unexpected(merged.error());
    const Result<Vector3d> origin = origin_of(model, merged->points);
    if (!origin) return tl::unexpected(origin.error());
    GlbFile file(*origin);
    add_body(model, file);
    if (!merged->triangles.empty()) add_merged(*merged, file);
    return file.pack();
}

Result<std::string> encode_merged_obj(const InstancedModel& model) {
    const Result<MergedCopies> merged = merge_copies(model.copies);
    if (!merged) return tl::unexpected(merged.error());
    ObjText file;
    if (model.body) {
        file.begin("body");
        file.add(*model.body, {model.colours, {}});
    }
    if (!merged->triangles.empty()) {
        file.begin("copies");
        file.add(*merged);
    }
    return file.text();
}

Result<void> write_instanced(const std::filesystem::path& path, const InstancedModel& model,
                             bool is_merged) {
    if (!can_hold(path, FormatTrait::copies)) {
        return failure(
            fmt::format("cannot write '{}': copies on a model can be written only to a name that "
                        "ends in {}",
                        path.string(), endings_of(FormatTrait::copies, "or")));
    }
    if (!has_triangles(model)) {
        return failure(fmt::format("cannot write '{}': it would show nothing", path.string()),
                       "no cell is drawn, and there is no surface below them");
    }
    return write_encoded(path, [&] {
        if (is_of_format(path, FileFormat::obj)) return encode_merged_obj(model);
        return is_merged ? encode_merged_glb(model) : encode_instanced_glb(model);
    });
}

}  // namespace cascade
