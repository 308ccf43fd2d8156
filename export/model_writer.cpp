// Selects the encoder by the extension of the file's name.
#include "export/model_writer.h"

#include "core/check.h"
#include "core/file_format.h"
#include "core/write_encoded.h"
#include "export/glb.h"

#include <fmt/format.h>

#include <array>

namespace cascade {

namespace {

struct ModelRow {
    FileFormat format;
    Result<std::string> (*encode)(const SurfaceMesh& mesh, const PointResults& results,
                                  Vector3d origin);
};

template <auto encode>
Result<std::string> with_results(const SurfaceMesh& mesh, const PointResults& results, Vector3d) {
    return encode(mesh, results);
}

Result<std::string> glb(const SurfaceMesh& mesh, const PointResults& results, Vector3d) {
    GlbLook look;
    look.colours = results.colours;
    return encode_glb(mesh, look);
}

Result<std::string> stl(const SurfaceMesh& mesh, const PointResults&, Vector3d origin) {
    return encode_stl(mesh, origin);
}

Result<std::string> vtp(const SurfaceMesh& mesh, const PointResults& results, Vector3d) {
    return encode_vtp(mesh, results);
}

constexpr std::array model_writers = {
    ModelRow{FileFormat::ply, with_results<encode_ply>},
    ModelRow{FileFormat::obj, with_results<encode_obj>},
    ModelRow{FileFormat::glb, glb},
    ModelRow{FileFormat::vtp, vtp},
    ModelRow{FileFormat::stl, stl},
};
static_assert(has_all_of(model_writers, FormatKind::model));

}  // namespace

Vector3d origin_of_file(const std::filesystem::path& path, const SurfaceMesh& mesh) {
    return is_of_format(path, FileFormat::stl) ? stl_origin(mesh) : Vector3d{};
}

std::vector<std::string> remarks_of_origin(const std::filesystem::path& path, Vector3d origin) {
    if (origin == Vector3d{}) return {};
    return {
        fmt::format("in '{}' the model is moved by {}, {}, {}, to the origin: far from it, the "
                    "32-bit numbers of STL files would blur the triangles",
                    path.filename().string(), -origin.x, -origin.y, -origin.z)};
}

Result<void> write_model(const std::filesystem::path& path, const SurfaceMesh& mesh,
                         const PointResults& results, std::optional<Vector3d> origin) {
    CHECK(results.colours.empty() || results.colours.size() == mesh.points.size(),
          "there is a colour for each point");
    for (const Channel& channel : results.channels) {
        CHECK(channel.values.size() == mesh.points.size(), "a channel has a number for each point");
    }
    const FormatRow* const format = find_format(path);
    const ModelRow* const writer = format ? row_of(model_writers, format->format) : nullptr;
    if (!writer) {
        return failure(fmt::format("cannot write '{}': a model's name ends in {}", path.string(),
                                   endings_of(FormatKind::model, "or")));
    }
    const Vector3d begin = origin ? *origin : origin_of_file(path, mesh);
    return write_encoded(path, [&] { return writer->encode(mesh, results, begin); });
}

}  // namespace cascade
