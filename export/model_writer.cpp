// Selects the encoder by the extension of the file's name.
#include "export/model_writer.h"

#include "core/check.h"
#include "core/file_ending.h"
#include "core/write_encoded.h"
#include "export/glb.h"

#include <fmt/format.h>

#include <array>

namespace cascade {

namespace {

Result<std::string> encode(const std::string& ending, const SurfaceMesh& mesh,
                           const PointResults& results, Vector3d origin) {
    if (ending == ".ply") return encode_ply(mesh, results);
    if (ending == ".obj") return encode_obj(mesh, results);
    if (ending == ".vtp") return encode_vtp(mesh, results);
    if (ending == ".stl") return encode_stl(mesh, origin);
    GlbLook look;
    look.colours = results.colours;
    return encode_glb(mesh, look);
}

}  // namespace

bool is_model_ending(const std::filesystem::path& path) {
    const std::string ending = lower_ending(path);
    return ending == ".ply" || ending == ".obj" || ending == ".glb" || ending == ".vtp" ||
           ending == ".stl";
}

Vector3d origin_of_file(const std::filesystem::path& path, const SurfaceMesh& mesh) {
    return lower_ending(path) == ".stl" ? stl_origin(mesh) : Vector3d{};
}

std::vector<std::string> remarks_of_origin(const std::filesystem::path& path, Vector3d origin) {
    if (origin == Vector3d{}) return {};
    return {
        fmt::format("'{}' has the model moved by {}, {}, {}, to the origin: STL files hold "
                    "binary32 numbers, which would blur its triangles where they are",
                    path.filename().string(), -origin.x, -origin.y, -origin.z)};
}

Result<void> write_model(const std::filesystem::path& path, const SurfaceMesh& mesh,
                         const PointResults& results, std::optional<Vector3d> origin) {
    CHECK(results.colours.empty() || results.colours.size() == mesh.points.size(),
          "there is a colour for each point");
    for (const Channel& channel : results.channels) {
        CHECK(channel.values.size() == mesh.points.size(), "a channel has a number for each point");
    }
    if (!is_model_ending(path)) {
        return failure(
            fmt::format("cannot write '{}': a model's name ends in .ply, .obj, .glb, "
                        ".vtp or .stl",
                        path.string()));
    }
    const Vector3d begin = origin ? *origin : origin_of_file(path, mesh);
    return write_encoded(path, [&] { return encode(lower_ending(path), mesh, results, begin); });
}

}  // namespace cascade
