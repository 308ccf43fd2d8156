// Writes baked maps to files.
#include "core/parallel.h"
#include "core/write_encoded.h"
#include "export/bake.h"
#include "export/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

namespace cascade {

namespace {

struct Maps {
    std::string colour, relief, normals;  ///< PNG files.
    std::string normals_of_model;         ///< In 8 bits, which all viewers of GLB files support.
};

/// Encodes the maps side by side, those of most bytes first.
Result<Maps> encode_maps(const Bake& bake, const PngTexts& texts) {
    Maps maps;
    struct Map {
        const Image& image;
        PngDepth depth;
        PngMeaning meaning;
        std::string& bytes;
        Result<void> done = {};
    };
    PngTexts all = texts;
    if (!bake.relief.pixels.empty()) {
        all["Cascade heights"] = fmt::format("{:.9g} {:.9g}", bake.heights.low, bake.heights.high);
    }
    std::array<Map, 4> list = {
        {{bake.normals, PngDepth::sixteen, PngMeaning::numbers, maps.normals},
         {bake.normals, PngDepth::eight, PngMeaning::numbers, maps.normals_of_model},
         {bake.colour, PngDepth::eight, PngMeaning::colours, maps.colour},
         {bake.relief, PngDepth::sixteen, PngMeaning::numbers, maps.relief}}};
    std::atomic<std::size_t> next = 0;
    Team(std::min<int>(hardware_threads(), list.size())).run([&](int) {
        for (std::size_t k = next++; k < list.size(); k = next++) {
            Map& map = list[k];
            if (map.image.pixels.empty()) continue;
            Result<std::string> encoded = encode_png(map.image, map.depth, all, map.meaning);
            if (encoded) map.bytes = std::move(*encoded);
            else map.done = tl::unexpected(encoded.error());
        }
    });
    for (const Map& map : list) {
        if (!map.done) return tl::unexpected(map.done.error());
    }
    return maps;
}

}  // namespace

std::vector<std::filesystem::path> baked_paths(const std::filesystem::path& glb, bool has_heights) {
    std::vector<std::filesystem::path> paths = {glb};
    const auto add = [&](std::string_view map) {
        std::filesystem::path name = glb.stem();
        name += map;
        paths.push_back(glb.parent_path() / name);
    };
    add("_color.png");
    if (has_heights) {
        add("_height.png");
        add("_normal.png");
    }
    return paths;
}

Result<void> write_baked(const std::filesystem::path& glb, const SurfaceMesh& mesh,
                         const Bake& bake, const PngTexts& texts) {
    Maps maps;
    Result<void> done = write_encoded(glb, [&]() -> Result<std::string> {
        Result<Maps> encoded = encode_maps(bake, texts);
        if (!encoded) return tl::unexpected(encoded.error());
        maps = *std::move(encoded);
        GlbLook look;
        look.colour_map = maps.colour;
        look.normal_map = maps.normals_of_model;
        return encode_glb(mesh, look);
    });
    const auto paths = baked_paths(glb, !maps.relief.empty());
    const std::array<const std::string*, 3> files = {&maps.colour, &maps.relief, &maps.normals};
    for (std::size_t k = 1; k < paths.size() && done; ++k) {
        done = write_file(paths[k], *files[k - 1]);
    }
    return done;
}

}  // namespace cascade
