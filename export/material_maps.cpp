// Encodes maps in parallel and writes them.
#include "export/material_maps.h"

#include "core/parallel.h"
#include "core/write_encoded.h"
#include "export/glb.h"
#include "picture/exr.h"
#include "picture/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace cascade {

namespace {

/// A file with one map, inside the GLB file or next to it.
struct MapFile {
    const Image* image = nullptr;
    PngDepth depth = PngDepth::eight;
    PngMeaning meaning = PngMeaning::colours;
    /// If set, the file is grey and has only this channel of the image.
    std::optional<std::size_t> channel = {};
    /// If set, the image whose grey is stored as the alpha channel.
    const Image* opacity = nullptr;
    /// For heights: the range whose ends are stored as black and white.
    std::optional<ValueRange> range = {};
    std::string bytes = {};
    Result<void> done = {};

    void encode(MapFormat format, const PngTexts& texts) {
        auto encoded = format == MapFormat::png ? encode_as_png(texts) : encode_as_exr();
        if (encoded) bytes = std::move(*encoded);
        else done = tl::unexpected(encoded.error());
    }

private:
    Result<std::string> encode_as_png(const PngTexts& texts) const {
        if (!channel && opacity == nullptr) return encode_png(*image, depth, texts, meaning);
        Image own = *image;
        for (std::size_t k = 0; k < own.pixels.size(); ++k) {
            Colour& pixel = own.pixels[k];
            if (channel) pixel.fill(pixel[*channel]);
            if (opacity != nullptr) own.alpha.push_back(opacity->pixels[k][0]);
        }
        return encode_png(own, depth, texts, meaning);
    }

    /// Stores colours as linear light, and heights as lengths.
    Result<std::string> encode_as_exr() const {
        if (channel || range) {
            std::vector<float> numbers;
            for (const Colour& pixel : image->pixels) {
                const float number = pixel[channel.value_or(0)];
                numbers.push_back(range ? range->low + number * (range->high - range->low)
                                        : number);
            }
            const ExrChannel only{"Y", numbers.data(), 1, !range};
            return encode_exr(image->width, image->height, {&only, 1});
        }
        std::vector<Colour> pixels = image->pixels;
        if (meaning == PngMeaning::colours) {
            for (Colour& pixel : pixels) pixel = light_of(pixel);
        }
        const ExrChannel channels[] = {{"R", pixels[0].data(), 3, true},
                                       {"G", pixels[0].data() + 1, 3, true},
                                       {"B", pixels[0].data() + 2, 3, true}};
        return encode_exr(image->width, image->height, channels);
    }
};

/// Encodes files in parallel, the largest first.
Result<void> encode(std::span<MapFile> files, MapFormat format, const PngTexts& texts) {
    if (files.empty()) return {};
    std::atomic<std::size_t> next = 0;
    Team(std::min(hardware_threads(), static_cast<int>(files.size()))).run([&](int) {
        for (std::size_t k = next++; k < files.size(); k = next++) files[k].encode(format, texts);
    });
    for (const MapFile& file : files) {
        if (!file.done) return tl::unexpected(file.done.error());
    }
    return {};
}

/// The files next to a model.
struct SideFiles {
    std::vector<std::string_view> names;  ///< The endings of their names, after the model's name.
    std::vector<MapFile> files;
};

SideFiles side_files(const MaterialMaps& maps, const MapSet& which) {
    SideFiles beside;
    const auto add = [&](bool is_there, std::string_view name, MapFile file) {
        if (!is_there) return;
        beside.names.push_back(name);
        beside.files.push_back(std::move(file));
    };
    constexpr auto eight = PngDepth::eight, sixteen = PngDepth::sixteen;
    constexpr auto colours = PngMeaning::colours, numbers = PngMeaning::numbers;
    add(true, "_color", {&maps.colour, eight, colours});
    add(which.heights, "_height", {&maps.relief, sixteen, numbers, {}, nullptr, maps.heights});
    add(which.normals, "_normal", {&maps.normals, sixteen, numbers});
    add(which.occlusion, "_occlusion", {&maps.surface, eight, numbers, 0});
    add(which.roughness, "_roughness", {&maps.surface, eight, numbers, 1});
    add(which.metalness, "_metalness", {&maps.surface, eight, numbers, 2});
    add(which.emission, "_emission", {&maps.emission, eight, colours});
    add(which.opacity, "_opacity", {&maps.opacity, eight, numbers, 0});
    return beside;
}

/// The maps of one level inside a GLB file. They have 8 bits per channel, which all viewers of GLB
/// files support.
class MapsInside {
public:
    MapsInside(const MaterialMaps& maps, const PngTexts& texts) : maps_(maps), texts_(texts) {}

    /// `plain_colours` is the encoded map of colours, if it exists already.
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
        if (auto done = cascade::encode(files_, MapFormat::png, texts_); !done) return done;
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
    // The maps of each level, to whose bytes the level's GlbLook refers.
    std::deque<MapsInside> inside;
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

std::vector<std::filesystem::path> map_paths(const std::filesystem::path& glb, const MapSet& maps,
                                             MapFormat format) {
    std::vector<std::filesystem::path> paths = {glb};
    for (const std::string_view name : side_files({}, maps).names) {
        std::filesystem::path file = glb.stem();
        file += name;
        file += format == MapFormat::png ? ".png" : ".exr";
        paths.push_back(glb.parent_path() / file);
    }
    return paths;
}

Result<void> write_maps(const std::filesystem::path& glb, std::span<const MappedModel> levels,
                        const PngTexts& texts, MapFormat format) {
    const MaterialMaps& maps = levels.front().maps;
    PngTexts all = texts;
    if (maps.maps.heights) {
        all["Cascade heights"] = fmt::format("{:.9g} {:.9g}", maps.heights.low, maps.heights.high);
    }
    SideFiles beside = side_files(maps, maps.maps);
    Result<void> done = write_encoded(glb, [&]() -> Result<std::string> {
        if (auto encoded = encode(beside.files, format, all); !encoded) {
            return tl::unexpected(encoded.error());
        }
        return encode_models(levels, all,
                             format == MapFormat::png ? beside.files[0].bytes : std::string());
    });
    const auto paths = map_paths(glb, maps.maps, format);
    for (std::size_t k = 1; k < paths.size() && done; ++k) {
        done = write_file(paths[k], beside.files[k - 1].bytes);
    }
    return done;
}

Result<void> write_maps(const std::filesystem::path& glb, const SurfaceMesh& mesh,
                        const MaterialMaps& maps, const PngTexts& texts, MapFormat format) {
    const MappedModel only{mesh, maps};
    return write_maps(glb, std::span(&only, 1), texts, format);
}

}  // namespace cascade
