// Encodes maps side by side and writes them.
#include "export/material_maps.h"

#include "core/parallel.h"
#include "core/write_encoded.h"
#include "export/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <string_view>
#include <utility>

namespace cascade {

namespace {

/// A PNG file to be made, inside of the GLB file or beside it.
struct MapFile {
    const Image* image = nullptr;
    PngDepth depth = PngDepth::eight;
    PngMeaning meaning = PngMeaning::colours;
    /// Grey, of this channel of the image alone.
    std::optional<std::size_t> channel = {};
    /// The alpha channel.
    const Image* opacity = nullptr;
    std::string bytes = {};
    Result<void> done = {};

    void encode(const PngTexts& texts) {
        Result<std::string> encoded = [&] {
            if (!channel && opacity == nullptr) return encode_png(*image, depth, texts, meaning);
            Image own = *image;
            for (std::size_t k = 0; k < own.pixels.size(); ++k) {
                Colour& pixel = own.pixels[k];
                if (channel) pixel.fill(pixel[*channel]);
                if (opacity != nullptr) own.alpha.push_back(opacity->pixels[k][0]);
            }
            return encode_png(own, depth, texts, meaning);
        }();
        if (encoded) bytes = std::move(*encoded);
        else done = tl::unexpected(encoded.error());
    }
};

/// Encodes files side by side; those of most bytes come first.
Result<void> encode(std::span<MapFile> files, const PngTexts& texts) {
    if (files.empty()) return {};
    std::atomic<std::size_t> next = 0;
    Team(std::min(hardware_threads(), static_cast<int>(files.size()))).run([&](int) {
        for (std::size_t k = next++; k < files.size(); k = next++) files[k].encode(texts);
    });
    for (const MapFile& file : files) {
        if (!file.done) return tl::unexpected(file.done.error());
    }
    return {};
}

/// The files beside a model.
struct SideFiles {
    std::vector<std::string_view> endings;
    std::vector<MapFile> files;
};

SideFiles side_files(const MaterialMaps& maps, const MapSet& which) {
    SideFiles beside;
    const auto add = [&](bool is_there, std::string_view ending, MapFile file) {
        if (!is_there) return;
        beside.endings.push_back(ending);
        beside.files.push_back(std::move(file));
    };
    constexpr auto eight = PngDepth::eight, sixteen = PngDepth::sixteen;
    constexpr auto colours = PngMeaning::colours, numbers = PngMeaning::numbers;
    add(true, "_color.png", {&maps.colour, eight, colours});
    add(which.heights, "_height.png", {&maps.relief, sixteen, numbers});
    add(which.heights, "_normal.png", {&maps.normals, sixteen, numbers});
    add(which.occlusion, "_occlusion.png", {&maps.surface, eight, numbers, 0});
    add(which.roughness, "_roughness.png", {&maps.surface, eight, numbers, 1});
    add(which.metalness, "_metalness.png", {&maps.surface, eight, numbers, 2});
    add(which.emission, "_emission.png", {&maps.emission, eight, colours});
    add(which.opacity, "_opacity.png", {&maps.opacity, eight, numbers});
    return beside;
}

/// The model with its maps, which have 8 bits there: all viewers of GLB files know these.
Result<std::string> encode_model(const SurfaceMesh& mesh, const MaterialMaps& maps,
                                 const PngTexts& texts, const std::string& plain_colours) {
    GlbLook look;
    look.has = maps.maps;
    look.is_cut = maps.is_cut;
    look.repeats = maps.repeats;
    std::vector<MapFile> inside;
    std::vector<std::string_view*> into;
    const auto add = [&](bool is_there, std::string_view& map, MapFile file) {
        if (!is_there) return;
        inside.push_back(std::move(file));
        into.push_back(&map);
    };
    constexpr auto eight = PngDepth::eight;
    add(maps.maps.heights, look.normal_map, {&maps.normals, eight, PngMeaning::numbers});
    add(maps.maps.has_surface(), look.surface_map, {&maps.surface, eight, PngMeaning::numbers});
    add(maps.maps.emission, look.emission_map, {&maps.emission, eight, PngMeaning::colours});
    add(maps.maps.opacity, look.colour_map,
        {&maps.colour, eight, PngMeaning::colours, {}, &maps.opacity});
    if (auto done = encode(inside, texts); !done) return tl::unexpected(done.error());
    for (std::size_t k = 0; k < inside.size(); ++k) *into[k] = inside[k].bytes;
    if (!maps.maps.opacity) look.colour_map = plain_colours;
    return encode_glb(mesh, look);
}

}  // namespace

std::vector<std::filesystem::path> map_paths(const std::filesystem::path& glb, const MapSet& maps) {
    std::vector<std::filesystem::path> paths = {glb};
    for (const std::string_view ending : side_files({}, maps).endings) {
        std::filesystem::path name = glb.stem();
        name += ending;
        paths.push_back(glb.parent_path() / name);
    }
    return paths;
}

Result<void> write_maps(const std::filesystem::path& glb, const SurfaceMesh& mesh,
                        const MaterialMaps& maps, const PngTexts& texts) {
    PngTexts all = texts;
    if (maps.maps.heights) {
        all["Cascade heights"] = fmt::format("{:.9g} {:.9g}", maps.heights.low, maps.heights.high);
    }
    SideFiles beside = side_files(maps, maps.maps);
    Result<void> done = write_encoded(glb, [&]() -> Result<std::string> {
        if (auto encoded = encode(beside.files, all); !encoded) {
            return tl::unexpected(encoded.error());
        }
        return encode_model(mesh, maps, all, beside.files[0].bytes);
    });
    const auto paths = map_paths(glb, maps.maps);
    for (std::size_t k = 1; k < paths.size() && done; ++k) {
        done = write_file(paths[k], beside.files[k - 1].bytes);
    }
    return done;
}

}  // namespace cascade
