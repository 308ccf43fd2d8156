// A fuzzer of the readers of models: the first byte chooses the format, the others are the file. What
// is read is made into a surface, whose links are followed. Found is what crashes, hangs, leaks, or
// makes a surface that does not fit together. Built with clang, libFuzzer and sanitizers; the
// commands are in README.md here.
#include "core/check.h"
#include "surface/make_mesh.h"
#include "surface/model_file.h"
#include "tests/support/small_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>

namespace cascade {

namespace {

constexpr std::array endings = {"ply", "obj", "off", "stl", "gltf", "glb"};

/// Begins a folder of inputs with a small valid file of each kind.
void write_seeds(const std::filesystem::path& folder) {
    for (const test::SmallModel& model : test::small_models()) {
        const auto format = std::find(endings.begin(), endings.end(), model.ending);
        std::ofstream(folder / model.name, std::ios::binary)
            << static_cast<char>(format - endings.begin()) << model.bytes;
    }
}

void check_soup(const PolygonSoup& soup) {
    for (const std::uint32_t corner : soup.corners) {
        CHECK(corner < soup.points.size(), "every corner is a point");
    }
    CHECK(soup.ends.empty() ? soup.corners.empty() : soup.ends.back() == soup.corners.size(),
          "polygons have all corners");
    CHECK(soup.texture.empty() || soup.texture.size() == soup.corners.size(),
          "every corner has a place in the texture, or none has");
    for (const PointAttribute& attribute : soup.attributes) {
        CHECK(attribute.values.size() == soup.points.size(), "attributes are of every point");
    }
}

void check_mesh(const SurfaceMesh& mesh) {
    CHECK(mesh.across.size() == mesh.triangles.size(), "every triangle has neighbours");
    CHECK(mesh.texture.empty() || mesh.texture.size() == mesh.triangles.size(),
          "every triangle has a place in the texture, or none has");
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            CHECK(mesh.triangles[t][k] < mesh.points.size(), "every corner is a point");
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists()) continue;
            CHECK((mesh.across[other.triangle][other.edge] == TriangleEdge{t, k}),
                  "links lead back");
            CHECK(mesh.triangles[other.triangle][other.edge] == mesh.triangles[t][(k + 1) % 3],
                  "neighbours turn the same way round");
        }
    }
    const MeshFacts facts = facts_of(mesh);
    CHECK(std::isfinite(facts.area) && facts.area > 0, "a surface has an area");
}

}  // namespace

}  // namespace cascade

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    for (int k = 1; k < *count; ++k) {
        const std::filesystem::path path = (*arguments)[k];
        if (!std::filesystem::is_directory(path)) continue;
        cascade::write_seeds(path);
        break;
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using cascade::endings;
    if (size == 0) return -1;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    auto soup = cascade::read_model_bytes(bytes, endings[data[0] % endings.size()], "/nowhere");
    if (!soup) {
        CHECK(!soup.error().message.empty(), "a file that is refused has a message");
        return 0;
    }
    cascade::check_soup(*soup);
    const auto made = cascade::make_mesh(*std::move(soup));
    if (made) cascade::check_mesh(made->mesh);
    return 0;
}
