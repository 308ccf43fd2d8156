// Encodes maps side by side and writes them.
#include "export/material_maps.h"

#include "core/parallel.h"
#include "core/write_encoded.h"
#include "export/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <deque>
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
    add(which.normals, "_normal.png", {&maps.normals, sixteen, numbers});
    add(which.occlusion, "_occlusion.png", {&maps.surface, eight, numbers, 0});
    add(which.roughness, "_roughness.png", {&maps.surface, eight, numbers, 1});
    add(which.metalness, "_metalness.png", {&maps.surface, eight, numbers, 2});
    add(which.emission, "_emission.png", {&maps.emission, eight, colours});
    add(which.opacity, "_opacity.png", {&maps.opacity, eight, numbers});
    return beside;
}

/// The maps of one level inside of a GLB file, which have 8 bits there: all viewers of GLB files
/// know these.
class MapsInside {
public:
    MapsInside(const MaterialMaps& maps, const PngTexts& texts) : maps_(maps), texts_(texts) {}

    /// `plain_colours` is the encoded map of colours, if it is known.
    Result<void> encode(std::string_view plain_colours) {
        const MapSet& has = maps_.maps;
        constexpr auto eight = PngDepth::eight;
        constexpr auto colours = PngMeaning::colours, numbers = PngMeaning::numbers;
        add(has.normals, look_.normal_map, {&maps_.normals, eight, numbers});
        add(has.has_surface(), look_.surface_map, {&maps_.surface, eight, numbers});
        add(has.emission, look_.emission_map, {&maps_.emission, eight, colours});
        look_.colour_map = plain_colours;
        add(has.opacity || plain_colours.empty(), look_.colour_map,
            {&maps_.colour, eight, colours, {}, has.opacity ? &maps_.opacity : nullptr});
        if (auto done = cascade::encode(files_, texts_); !done) return done;
        for (std::size_t k = 0; k < files_.size(); ++k) *into_[k] = files_[k].bytes;
        look_.has = has;
        look_.is_cut = maps_.is_cut;
        look_.repeats = maps_.repeats;
        return {};
    }

    const GlbLook& look() const { return look_; }

private:
    void add(bool is_there, std::string_view& map, MapFile file) {
        if (!is_there) return;
        files_.push_back(std::move(file));
        into_.push_back(&map);
    }

    const MaterialMaps& maps_;
    const PngTexts& texts_;
    GlbLook look_;
    std::vector<MapFile> files_;
    std::vector<std::string_view*> into_;
};

Result<std::string> encode_models(std::span<const MappedModel> levels, const PngTexts& texts,
                                  const std::string& plain_colours) {
    std::deque<MapsInside> inside;  // Looks refer to the bytes in it.
    std::vector<GlbLevel> models;
    for (const MappedModel& level : levels) {
        MapsInside& maps = inside.emplace_back(level.maps, texts);
        if (auto done = maps.encode(models.empty() ? plain_colours : std::string_view()); !done) {
            return tl::unexpected(done.error());
        }
        models.push_back({level.mesh, maps.look()});
    }
    return encode_glb(models);
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

Result<void> write_maps(const std::filesystem::path& glb, std::span<const MappedModel> levels,
                        const PngTexts& texts) {
    const MaterialMaps& maps = levels.front().maps;
    PngTexts all = texts;
    if (maps.maps.heights) {
        all["Cascade heights"] = fmt::format("{:.9g} {:.9g}", maps.heights.low, maps.heights.high);
    }
    SideFiles beside = side_files(maps, maps.maps);
    Result<void> done = write_encoded(glb, [&]() -> Result<std::string> {
        if (auto encoded = encode(beside.files, all); !encoded) {
            return tl::unexpected(encoded.error());
        }
        return encode_models(levels, all, beside.files[0].bytes);
    });
    const auto paths = map_paths(glb, maps.maps);
    for (std::size_t k = 1; k < paths.size() && done; ++k) {
        done = write_file(paths[k], beside.files[k - 1].bytes);
    }
    return done;
}

Result<void> write_maps(const std::filesystem::path& glb, const SurfaceMesh& mesh,
                        const MaterialMaps& maps, const PngTexts& texts) {
    const MappedModel only{mesh, maps};
    return write_maps(glb, std::span(&only, 1), texts);
}

}  // namespace cascade
