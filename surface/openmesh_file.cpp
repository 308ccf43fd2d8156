// OBJ and STL files, read by OpenMesh. Only its readers are used, not its meshes: those
// silently double points where faces do not fit together, while a reader hands over what it finds
// to any importer.
#include "surface/model_file.h"

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/STLReader.hh>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace cascade {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using OpenMesh::EdgeHandle;

/// Takes down what a reader finds. Most of what it could be told has no meaning for a soup.
class SoupImporter : public OpenMesh::IO::BaseImporter {
public:
    /// What was read, or why it cannot be used.
    Result<PolygonSoup> finished(std::string_view format) && {
        if (bad_corner_) {
            return failure(fmt::format("face {} of the {} file names a point that is not there",
                                       *bad_corner_, format));
        }
        if (soup_.points.empty()) return failure(fmt::format("the {} file has no points", format));
        if (soup_.texture.size() != soup_.corners.size()) soup_.texture.clear();
        for (PointAttribute& colour : colours_) {
            if (colour.values.empty()) continue;
            colour.values.resize(soup_.points.size());
            soup_.attributes.push_back(std::move(colour));
        }
        return std::move(soup_);
    }

    VertexHandle add_vertex(const OpenMesh::Vec3f& p) override {
        return add_vertex(OpenMesh::Vec3d(p[0], p[1], p[2]));
    }
    VertexHandle add_vertex(const OpenMesh::Vec3d& p) override {
        soup_.points.push_back({p[0], p[1], p[2]});
        return VertexHandle(static_cast<int>(soup_.points.size()) - 1);
    }
    VertexHandle add_vertex() override { return add_vertex(OpenMesh::Vec3d(0, 0, 0)); }
    void set_point(VertexHandle v, const OpenMesh::Vec3f& p) override {
        soup_.points.at(static_cast<std::size_t>(v.idx())) = {p[0], p[1], p[2]};
    }

    FaceHandle add_face(const VHandles& corners) override {
        for (const VertexHandle corner : corners) {
            if (!is_point(corner) && !bad_corner_) bad_corner_ = soup_.ends.size() + 1;
            soup_.corners.push_back(static_cast<std::uint32_t>(corner.idx()));
        }
        soup_.ends.push_back(soup_.corners.size());
        return FaceHandle(static_cast<int>(soup_.ends.size()) - 1);
    }
    FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }

    /// Comes right after the face; `first` is the corner of the first place.
    void add_face_texcoords(FaceHandle face, VertexHandle first,
                            const std::vector<OpenMesh::Vec2f>& places) override {
        if (!face.is_valid() || soup_.ends.empty()) return;
        const auto corners = soup_.polygon(soup_.ends.size() - 1);
        if (places.size() != corners.size()) return;
        const std::size_t begin = soup_.first_corner(soup_.ends.size() - 1);
        std::size_t shift = 0;
        while (shift + 1 < corners.size() &&
               corners[shift] != static_cast<std::uint32_t>(first.idx())) {
            ++shift;
        }
        soup_.texture.resize(begin + corners.size());
        for (std::size_t k = 0; k < places.size(); ++k) {
            soup_.texture[begin + (k + shift) % corners.size()] = {places[k][0], places[k][1]};
        }
    }

    void set_color(VertexHandle v, const OpenMesh::Vec3uc& c) override {
        set_colour(v, {c[0] / 255.0F, c[1] / 255.0F, c[2] / 255.0F});
    }
    void set_color(VertexHandle v, const OpenMesh::Vec4uc& c) override {
        set_colour(v, {c[0] / 255.0F, c[1] / 255.0F, c[2] / 255.0F});
    }
    void set_color(VertexHandle v, const OpenMesh::Vec3f& c) override {
        set_colour(v, {c[0], c[1], c[2]});
    }
    void set_color(VertexHandle v, const OpenMesh::Vec4f& c) override {
        set_colour(v, {c[0], c[1], c[2]});
    }

    std::size_t n_vertices() const override { return soup_.points.size(); }
    std::size_t n_faces() const override { return soup_.ends.size(); }
    std::size_t n_edges() const override { return 0; }

    // What a soup does not keep.
    HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
    void add_face_texcoords(FaceHandle, VertexHandle,
                            const std::vector<OpenMesh::Vec3f>&) override {}
    void set_face_texindex(FaceHandle, int) override {}
    void set_halfedge(VertexHandle, HalfedgeHandle) override {}
    void set_normal(VertexHandle, const OpenMesh::Vec3f&) override {}
    void set_normal(VertexHandle, const OpenMesh::Vec3d&) override {}
    void set_texcoord(VertexHandle, const OpenMesh::Vec2f&) override {}
    void set_status(VertexHandle, const OpenMesh::Attributes::StatusInfo&) override {}
    void set_next(HalfedgeHandle, HalfedgeHandle) override {}
    void set_face(HalfedgeHandle, FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void set_texcoord(HalfedgeHandle, const OpenMesh::Vec2f&) override {}
    void set_texcoord(VertexHandle, const OpenMesh::Vec3f&) override {}
    void set_texcoord(HalfedgeHandle, const OpenMesh::Vec3f&) override {}
    void set_status(HalfedgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}
    void set_color(EdgeHandle, const OpenMesh::Vec3uc&) override {}
    void set_color(EdgeHandle, const OpenMesh::Vec4uc&) override {}
    void set_color(EdgeHandle, const OpenMesh::Vec3f&) override {}
    void set_color(EdgeHandle, const OpenMesh::Vec4f&) override {}
    void set_status(EdgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}
    void set_normal(FaceHandle, const OpenMesh::Vec3f&) override {}
    void set_normal(FaceHandle, const OpenMesh::Vec3d&) override {}
    void set_color(FaceHandle, const OpenMesh::Vec3uc&) override {}
    void set_color(FaceHandle, const OpenMesh::Vec4uc&) override {}
    void set_color(FaceHandle, const OpenMesh::Vec3f&) override {}
    void set_color(FaceHandle, const OpenMesh::Vec4f&) override {}
    void set_status(FaceHandle, const OpenMesh::Attributes::StatusInfo&) override {}
    void add_texture_information(int, std::string) override {}

private:
    bool is_point(VertexHandle v) const {
        return v.is_valid() && static_cast<std::size_t>(v.idx()) < soup_.points.size();
    }

    void set_colour(VertexHandle v, std::array<float, 3> colour) {
        if (!is_point(v)) return;
        for (std::size_t k = 0; k < 3; ++k) {
            std::vector<float>& values = colours_[k].values;
            if (values.size() < soup_.points.size()) values.resize(soup_.points.size());
            values[static_cast<std::size_t>(v.idx())] = colour[k];
        }
    }

    PolygonSoup soup_;
    std::array<PointAttribute, 3> colours_{PointAttribute{"red", {}}, PointAttribute{"green", {}},
                                           PointAttribute{"blue", {}}};
    std::optional<std::size_t> bad_corner_;
};

/// Without its `mtllib` lines: OpenMesh would open whatever files they name.
std::string without_materials(std::string_view text) {
    std::string kept;
    kept.reserve(text.size());
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        const std::string_view line = text.substr(0, end);
        const std::size_t word = std::min(line.find_first_not_of(" \t"), line.size());
        if (!line.substr(word).starts_with("mtllib")) kept += line;
        text.remove_prefix(end);
    }
    return kept;
}

}  // namespace

Result<PolygonSoup> read_by_openmesh(std::string_view bytes, std::string_view ending) {
    using namespace OpenMesh::IO;
    omlog().disable();  // It writes to the terminal.
    omerr().disable();
    Options options;
    options += Options::FaceTexCoord;
    options += Options::VertexColor;
    SoupImporter importer;
    bool is_read = false;
    if (ending == "obj") {
        std::istringstream text(without_materials(bytes));
        is_read = OBJReader().read(text, importer, options);
    } else {
        std::istringstream text{std::string(bytes)};
        is_read = STLReader().read(text, importer, options);
    }
    const std::string format = ending == "obj" ? "OBJ" : "STL";
    if (!is_read) return failure(fmt::format("this is no {} file that can be read", format));
    return std::move(importer).finished(format);
}

}  // namespace cascade
