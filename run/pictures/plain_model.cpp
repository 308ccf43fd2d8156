// The attributes red, green and blue become the colour, and all other attributes become numbers.
// Normals are not copied from the attributes but computed again.
#include "run/pictures/plain_model.h"

#include "core/enough_memory.h"
#include "core/file_format.h"
#include "export/model_writer.h"
#include "picture/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace cascade {

namespace {

const PointAttribute* attribute_called(const SurfaceMesh& mesh, std::string_view name) {
    const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                    [&](const auto& each) { return each.name == name; });
    return found == mesh.attributes.end() ? nullptr : &*found;
}

/// The attributes of the points of a mesh, in the form in which files store them.
struct PlainResults {
    std::vector<Colour> colours;
    std::vector<Channel> channels;

    explicit PlainResults(const SurfaceMesh& mesh) {
        const std::array parts = {attribute_called(mesh, "red"), attribute_called(mesh, "green"),
                                  attribute_called(mesh, "blue")};
        const bool has_colours = parts[0] && parts[1] && parts[2];
        for (std::size_t k = 0; has_colours && k < mesh.points.size(); ++k) {
            Colour colour;
            for (std::size_t c = 0; c < 3; ++c) {
                const float part = parts[c]->values[k] / parts[c]->full;
                colour[c] = parts[c]->is_light ? stored_of(part) : part;
            }
            colours.push_back(colour);
        }
        for (const PointAttribute& attribute : mesh.attributes) {
            const bool is_colour =
                has_colours && std::find(parts.begin(), parts.end(), &attribute) != parts.end();
            const bool is_normal =
                attribute.name == "nx" || attribute.name == "ny" || attribute.name == "nz";
            if (!is_colour && !is_normal) channels.push_back(attribute);
        }
    }

    std::string names() const {
        std::string all;
        for (const Channel& channel : channels) all += (all.empty() ? "" : ", ") + channel.name;
        return all;
    }
};

std::vector<std::string> left_out(const std::filesystem::path& path, const SurfaceMesh& mesh,
                                  const PlainResults& results) {
    std::vector<std::string> sentences;
    const auto say = [&](const std::string& what) {
        sentences.push_back(
            fmt::format("without {}, which {} files cannot hold", what, lower_ending(path)));
    };
    if (!results.colours.empty() && !can_hold(path, FormatTrait::colours)) say("its colours");
    if (!results.channels.empty() && !can_hold(path, FormatTrait::numbers)) {
        say(results.names());
    }
    if (!mesh.texture.empty() && !can_hold(path, FormatTrait::texture)) {
        say("its texture coordinates");
    }
    return sentences;
}

Result<std::vector<std::string>> write_with_results(const std::filesystem::path& path,
                                                    const SurfaceMesh& mesh) {
    const PlainResults results(mesh);
    const Vector3d origin = origin_of_file(path, mesh);
    const auto done = write_model(path, mesh, {results.colours, results.channels}, origin);
    if (!done) return tl::unexpected(done.error());
    std::vector<std::string> sentences = left_out(path, mesh, results);
    for (std::string& remark : remarks_of_origin(path, origin)) {
        sentences.push_back(std::move(remark));
    }
    return sentences;
}

}  // namespace

Result<std::vector<std::string>> write_plain_model(const std::filesystem::path& path,
                                                   const SurfaceMesh& mesh) {
    return enough_memory_for([&] { return write_with_results(path, mesh); },
                             "cannot write '" + path.string() + "': there is not enough memory");
}

}  // namespace cascade
