// The XML header and the raw block are built together, array by array.
#include "export/vtp.h"

#include "export/model_writer.h"
#include "mesh/normals.h"
#include "picture/float_bytes.h"
#include "picture/srgb.h"
#include "picture/xml_text.h"

#include <fmt/format.h>

#include <string_view>

namespace cascade {

namespace {

/// Builds the header and the block of arrays that follows it.
class VtpFile {
public:
    explicit VtpFile(const VtpPoints& points) : points_(points) {}

    std::string encode() {
        const std::size_t count = points_.places.size(), triangles = points_.triangles.size();
        head_ = fmt::format(
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n"
            "  <PolyData>\n"
            "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
            count, triangles == 0 ? count : 0, triangles);
        add_point_data();
        head_ += "      <Points>\n";
        if (are_single(points_.places)) add_vectors<float>("Points", points_.places);
        else add_vectors<double>("Points", points_.places);
        head_ += "      </Points>\n";
        if (triangles == 0) add_vertices();
        else add_triangles();
        return head_ + "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_" +
               block_ + "\n  </AppendedData>\n</VTKFile>\n";
    }

private:
    template <typename Number>
    static std::string type_of() {
        const char* kind = std::is_floating_point_v<Number> ? "Float"
                           : std::is_signed_v<Number>       ? "Int"
                                                            : "UInt";
        return fmt::format("{}{}", kind, 8 * sizeof(Number));
    }

    /// Adds an array of `count` × `components` numbers, each taken from `number(k)`.
    template <typename Number, typename Take>
    void add(std::string_view name, std::size_t count, std::size_t components, const Take& take) {
        head_ += fmt::format(
            "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
            "format=\"appended\" offset=\"{}\"/>\n",
            type_of<Number>(), xml_escaped(name), components, block_.size());
        append_number(block_, std::uint64_t{count * components * sizeof(Number)});
        for (std::size_t k = 0; k < count * components; ++k) {
            append_number(block_, static_cast<Number>(take(k)));
        }
    }

    template <typename Number>
    void add_vectors(std::string_view name, std::span<const Vector3d> vectors) {
        add<Number>(name, vectors.size(), 3, [&](std::size_t k) {
            const Vector3d& v = vectors[k / 3];
            return k % 3 == 0 ? v.x : k % 3 == 1 ? v.y : v.z;
        });
    }

    void add_point_data() {
        const std::vector<std::string> names =
            points_.frames.empty()
                ? distinct_names(points_.channels, {"Normals", "color", "area", "Points"})
                : distinct_names(points_.channels,
                                 {"Normals", "color", "radius", "frame", "Points"});
        head_ += "      <PointData Normals=\"Normals\"";
        if (!names.empty()) head_ += fmt::format(" Scalars=\"{}\"", xml_escaped(names[0]));
        head_ += ">\n";
        const std::size_t count = points_.places.size();
        for (std::size_t c = 0; c < names.size(); ++c) {
            const std::vector<float>& values = points_.channels[c].values;
            add<float>(names[c], count, 1, [&](std::size_t k) { return values[k]; });
        }
        add_vectors<float>("Normals", points_.normals);
        if (!points_.areas.empty()) {
            add<double>("area", count, 1, [&](std::size_t k) { return points_.areas[k]; });
        }
        if (!points_.radii.empty()) {
            add<double>("radius", count, 1, [&](std::size_t k) { return points_.radii[k]; });
        }
        if (!points_.frames.empty()) {
            add<double>("frame", count, 4, [&](std::size_t k) {
                const Quaternion& q = points_.frames[k / 4];
                return std::array{q.w, q.x, q.y, q.z}[k % 4];
            });
        }
        if (!points_.colours.empty()) {
            add<std::uint8_t>("color", count, 3, [&](std::size_t k) {
                return level_of(shown(points_.colours[k / 3])[k % 3], 255);
            });
        }
        head_ += "      </PointData>\n";
    }

    void add_vertices() {
        const std::size_t count = points_.places.size();
        head_ += "      <Verts>\n";
        add<std::int64_t>("connectivity", count, 1, [](std::size_t k) { return k; });
        add<std::int64_t>("offsets", count, 1, [](std::size_t k) { return k + 1; });
        head_ += "      </Verts>\n";
    }

    void add_triangles() {
        const std::size_t count = points_.triangles.size();
        head_ += "      <Polys>\n";
        add<std::int64_t>("connectivity", 3 * count, 1,
                          [&](std::size_t k) { return points_.triangles[k / 3][k % 3]; });
        add<std::int64_t>("offsets", count, 1, [](std::size_t k) { return 3 * (k + 1); });
        head_ += "      </Polys>\n";
    }

    const VtpPoints& points_;
    std::string head_, block_;
};

}  // namespace

std::string encode_vtp(const VtpPoints& points) { return VtpFile(points).encode(); }

std::string encode_vtp(const SurfaceMesh& mesh, const PointResults& results) {
    VtpPoints points;
    const std::vector<Vector3d> normals = point_normals(mesh);
    points.places = mesh.points;
    points.normals = normals;
    points.colours = results.colours;
    points.channels = results.channels;
    points.triangles = mesh.triangles;
    return encode_vtp(points);
}

}  // namespace cascade
