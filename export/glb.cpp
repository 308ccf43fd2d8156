// Writes vertices, colours and pictures of one model.
#include "export/glb.h"

#include "core/check.h"
#include "export/channels.h"
#include "export/glb_file.h"
#include "mesh/normals.h"
#include "picture/srgb.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace cascade {

namespace {

using Json = GlbFile::Json;

/// When the part of the screen that the model covers shrinks by this factor, the next level of
/// detail appears. The number of triangles falls by the same factor from level to level.
constexpr double coverage_factor = 4;

/// Adds the parts of one model to a file.
class ModelParts {
public:
    ModelParts(const SurfaceMesh& mesh, const GlbLook& look, const GlbGrowth& growth, GlbFile& file)
        : mesh_(mesh),
          look_(look),
          growth_(growth),
          vertices_(render_vertices(mesh, corner_normals(mesh))),
          file_(file) {}

    std::size_t add() {
        Json primitive = this->primitive();
        primitive["material"] = file_.add("materials", material());
        if (growth_.moments.empty()) {
            return file_.add("meshes", {{"primitives", Json::array({primitive})}});
        }
        primitive["targets"] = targets();
        const std::vector<float> weights(growth_.moments.size());
        return file_.add("meshes",
                         {{"primitives", Json::array({primitive})}, {"weights", weights}});
    }

private:
    Json primitive() {
        const std::size_t count = vertices_.points.size();
        Json attributes;
        attributes["POSITION"] = file_.add_places(count, [&](std::size_t k) {
            return mesh_.points[vertices_.points[k]];
        });
        attributes["NORMAL"] = add_floats("VEC3", [&](std::size_t k, std::size_t c) {
            return GlbFile::component(vertices_.normals[k], c);
        });
        if (!vertices_.texture.empty()) {
            // In glTF, the origin is at the upper left.
            attributes["TEXCOORD_0"] = add_floats("VEC2", [&](std::size_t k, std::size_t c) {
                const float place = vertices_.texture[k][c];
                return c == 0 ? place : 1 - place;
            });
            attributes["TANGENT"] = add_floats("VEC4", [&](std::size_t k, std::size_t c) {
                const Tangent& tangent = vertices_.tangents[k];
                return c == 3 ? static_cast<float>(tangent.side)
                              : GlbFile::component(tangent.direction, c);
            });
        }
        if (!look_.colours.empty()) attributes["COLOR_0"] = add_colours();
        return {{"attributes", attributes},
                {"indices", file_.add_corners(vertices_.triangles, count, false)}};
    }

    template <typename Take>
    std::size_t add_floats(std::string_view shape, const Take& number) {
        return file_.add_numbers<float>(GlbFile::vertex_buffer, shape, vertices_.points.size(),
                                        number);
    }

    std::size_t add_colours() {
        return file_.add_numbers<std::uint16_t>(GlbFile::vertex_buffer, "VEC4",
                                                vertices_.points.size(),
                                                [&](std::size_t k, std::size_t c) {
                                                    return c == 3 ? 65535u
                                                                  : level_in(look_.colours, k, c);
                                                });
    }

    /// The light of a vertex as a 16-bit number.
    std::uint32_t level_in(std::span<const Colour> colours, std::size_t vertex,
                           std::size_t channel) const {
        return level_of(light_of(shown(colours[vertices_.points[vertex]])[channel]), 65535);
    }

    /// The morph targets: the differences between the mesh at each moment and the final mesh.
    Json targets() {
        Json targets = Json::array();
        const std::vector<Vector3d> normals = point_normals(mesh_);
        std::vector<std::array<int, 3>> levels(vertices_.points.size());
        for (std::size_t k = 0; k < levels.size(); ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                levels[k][c] = static_cast<int>(level_in(look_.colours, k, c));
            }
        }
        std::optional<std::size_t> still;
        for (const GlbMoment& moment : growth_.moments) {
            Json target;
            if (!moment.points.empty()) {
                add_shape(moment, normals, target);
            } else {
                // three.js shows the colours of a target only if it has positions.
                if (!still) still = file_.add_zeros(vertices_.points.size());
                target["POSITION"] = *still;
            }
            target["COLOR_0"] = file_.add_numbers<std::int16_t>(
                GlbFile::vertex_buffer, "VEC4", vertices_.points.size(),
                [&](std::size_t k, std::size_t c) {
                    if (c == 3) return 0;
                    // The value 1 is stored as 32767 in these signed integers, and as 65535 in
                    // colours.
                    return (static_cast<int>(level_in(moment.colours, k, c)) - levels[k][c]) / 2;
                });
            targets.push_back(std::move(target));
        }
        return targets;
    }

    /// At a crease a point has several normals. They rotate as the smooth normal of the point does.
    void add_shape(const GlbMoment& moment, const std::vector<Vector3d>& normals, Json& target) {
        SurfaceMesh moved;
        moved.points = moment.points;
        moved.triangles = mesh_.triangles;
        const std::vector<Vector3d> turned = point_normals(moved);
        const auto add = [&](const auto& difference) {
            return file_.add_bounded(GlbFile::vertex_buffer, "VEC3", vertices_.points.size(),
                                     [&](std::size_t k, std::size_t c) {
                                         return GlbFile::component(
                                             difference(k, vertices_.points[k]), c);
                                     });
        };
        target["POSITION"] = add([&](std::size_t, std::uint32_t point) {
            return moment.points[point] - mesh_.points[point];
        });
        target["NORMAL"] = add([&](std::size_t k, std::uint32_t point) {
            const Vector3d& own = vertices_.normals[k];
            return unit(own + turned[point] - normals[point]) - own;
        });
    }

    Json material() {
        Json result = plain_material(look_.roughness);
        if (!look_.colour_map.empty()) {
            result["pbrMetallicRoughness"]["baseColorTexture"] = {
                {"index", add_picture(look_.colour_map)}};
        }
        if (!look_.normal_map.empty()) {
            result["normalTexture"] = {{"index", add_picture(look_.normal_map)}};
        }
        if (!look_.surface_map.empty()) add_surface(result);
        if (!look_.emission_map.empty()) {
            result["emissiveTexture"] = {{"index", add_picture(look_.emission_map)}};
            result["emissiveFactor"] = {1, 1, 1};
        }
        if (look_.has.opacity) result["alphaMode"] = look_.is_cut ? "MASK" : "BLEND";
        const bool has_boundary =
            std::any_of(mesh_.across.begin(), mesh_.across.end(), [](const auto& edges) {
                return std::any_of(edges.begin(), edges.end(),
                                   [](const TriangleEdge& edge) { return !edge.exists(); });
            });
        if (has_boundary) result["doubleSided"] = true;
        return result;
    }

    /// Sets the factors of the material, which multiply the values of the map. A part that is not
    /// in the map has the value 1 there, so its factor is the value of the part.
    void add_surface(Json& material) {
        const std::size_t texture = add_picture(look_.surface_map);
        if (look_.has.occlusion) material["occlusionTexture"] = {{"index", texture}};
        if (!look_.has.roughness && !look_.has.metalness) return;
        Json& shine = material["pbrMetallicRoughness"];
        shine["metallicRoughnessTexture"] = {{"index", texture}};
        if (look_.has.roughness) shine["roughnessFactor"] = 1.0;
        if (look_.has.metalness) shine["metallicFactor"] = 1.0;
    }

    /// Adds a picture and returns the index of its texture.
    std::size_t add_picture(std::string_view png) {
        const std::size_t view = file_.add_view(0, [&](std::string& bytes) { bytes.append(png); });
        const std::size_t image =
            file_.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
        Json texture = {{"source", image}};
        if (!look_.repeats[0] || !look_.repeats[1]) texture["sampler"] = sampler();
        return file_.add("textures", std::move(texture));
    }

    /// The index of the only sampler, which says along which axes textures do not repeat. Without a
    /// sampler, textures repeat.
    std::size_t sampler() {
        const auto wrap = [&](bool repeats) {
            return repeats ? GlbFile::wrap_repeat : GlbFile::wrap_clamp;
        };
        if (!sampler_) {
            sampler_ = file_.add("samplers", {{"wrapS", wrap(look_.repeats[0])},
                                              {"wrapT", wrap(look_.repeats[1])}});
        }
        return *sampler_;
    }

    const SurfaceMesh& mesh_;
    const GlbLook& look_;
    const GlbGrowth& growth_;
    RenderVertices vertices_;
    GlbFile& file_;
    std::optional<std::size_t> sampler_;
};

/// A file without parts. Its origin is chosen so that the coordinates of the mesh are exact.
Result<GlbFile> file_for(const SurfaceMesh& mesh) {
    const SurfaceMesh::Box box = mesh.box();
    const Result<Vector3d> origin = origin_of_glb(mesh.points, box.low, box.high);
    if (!origin) return tl::unexpected(origin.error());
    return GlbFile(*origin);
}

/// Adds an animation in which each moment in turn has all the weight. At the end no moment has any
/// weight, so the mesh itself is shown. If the size of the model changes, a second track scales it.
void animate(std::size_t node, const GlbGrowth& growth, GlbFile& file) {
    const std::size_t count = growth.moments.size();
    const std::size_t times =
        file.add_bounded(0, "SCALAR", count + 1, [&](std::size_t k, std::size_t) {
            return static_cast<float>(growth.seconds * static_cast<double>(k));
        });
    const std::size_t weights =
        file.add_numbers<float>(0, "SCALAR", (count + 1) * count, [&](std::size_t k, std::size_t) {
            return k / count == k % count ? 1.0F : 0.0F;
        });
    Json animation = {{"name", "growth"}};
    animation["samplers"] = Json::array({{{"input", times}, {"output", weights}}});
    animation["channels"] =
        Json::array({{{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}}});
    const auto scale_of = [&](std::size_t k) { return k < count ? growth.moments[k].scale : 1; };
    if (std::ranges::any_of(growth.moments,
                            [](const GlbMoment& each) { return each.scale != 1; })) {
        const std::size_t scales =
            file.add_numbers<float>(0, "VEC3", count + 1, [&](std::size_t k, std::size_t) {
                return static_cast<float>(scale_of(k));
            });
        animation["samplers"].push_back({{"input", times}, {"output", scales}});
        animation["channels"].push_back(
            {{"sampler", 1}, {"target", {{"node", node}, {"path", "scale"}}}});
    }
    file.add("animations", std::move(animation));
}

}  // namespace

std::size_t add_model(const SurfaceMesh& mesh, const GlbLook& look, GlbFile& file,
                      const GlbGrowth& growth) {
    CHECK(look.colours.empty() || look.colours.size() == mesh.points.size(),
          "there is a colour for each point");
    CHECK((look.colour_map.empty() && look.normal_map.empty() && look.surface_map.empty() &&
           look.emission_map.empty()) ||
              !mesh.texture.empty(),
          "pictures lie over models with texture coordinates");
    return ModelParts(mesh, look, growth, file).add();
}

Result<std::string> encode_glb(const SurfaceMesh& mesh, const GlbLook& look) {
    const GlbLevel only{mesh, look};
    return encode_glb(std::span(&only, 1));
}

Result<std::string> encode_growing_glb(const SurfaceMesh& mesh, const GlbLook& look,
                                       const GlbGrowth& growth) {
    Result<GlbFile> file = file_for(mesh);
    if (!file) return tl::unexpected(file.error());
    const std::size_t node = file->add_node({{"mesh", add_model(mesh, look, *file, growth)}});
    if (!growth.moments.empty()) animate(node, growth, *file);
    return file->pack();
}

Result<std::string> encode_glb(std::span<const GlbLevel> levels) {
    const SurfaceMesh& finest = levels.front().mesh;
    Result<GlbFile> made = file_for(finest);
    if (!made) return tl::unexpected(made.error());
    GlbFile& file = *made;
    Json node = {{"mesh", add_model(finest, levels.front().look, file)}};
    if (levels.size() > 1) {
        Json coarser = Json::array(), coverages = Json::array();
        double coverage = 1;
        for (const GlbLevel& level : levels.subspan(1)) {
            coarser.push_back(
                file.add_node({{"mesh", add_model(level.mesh, level.look, file)}}, false));
            coverages.push_back(coverage /= coverage_factor);
        }
        coverages.push_back(0.0);
        file.use("MSFT_lod");
        node["extensions"]["MSFT_lod"]["ids"] = std::move(coarser);
        node["extras"]["MSFT_screencoverage"] = std::move(coverages);
    }
    file.add_node(std::move(node));
    return file.pack();
}

}  // namespace cascade
