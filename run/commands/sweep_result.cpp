// The key of a run is a hash of its tokens, files and overrides, so comments and blanks do not
// change the key. The picture is stored as averages over squares of cells.
#include "run/commands/sweep_result.h"

#include "core/file.h"
#include "core/hash.h"
#include "core/version.h"
#include "lang/program/stage_kinds.h"
#include "lang/syntax/token.h"
#include "picture/npy.h"
#include "run/script/embedded_script.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {

namespace {

constexpr std::uint64_t largest_result = 1 << 28;

std::uint64_t add_line(std::uint64_t hash, std::string_view text) {
    return fnv1a("\n", fnv1a(text, hash));
}

std::uint64_t add_words(std::uint64_t hash, const Script& script) {
    for (SourceId source = 0; source < script.sources.size(); ++source) {
        Diagnostics already_reported;
        for (const Token& token : lex(source, script.sources, already_reported)) {
            const std::string_view text =
                token.kind == TokenKind::newline ? std::string_view("\n") : token.text;
            hash = fnv1a("\x1f", fnv1a(text, hash));
        }
    }
    return hash;
}

/// Adds the contents of all files named in the program.
std::uint64_t add_files(std::uint64_t hash, const Script& script) {
    constexpr std::uint64_t largest_file = std::uint64_t{1} << 30;
    const auto add = [&](const Result<std::string>& bytes) {
        if (bytes) hash = add_line(hash, *bytes);
    };
    const GrantedFiles files(script.folder, script.overrides.reads);
    const Literals& literals = *script.program->literals;
    for (const TextId name : literals.text_ids())
        add(files.read(literals.text(name), largest_file));
    const auto& model = script.program->domain.model;
    if (!model || model->shape != ModelShape::file) return hash;
    add(script.overrides.model_is_asked_for ? read_linked_file(model->path, largest_file)
                                            : files.read(model->path, largest_file));
    return hash;
}

nlohmann::json json_of(const SweepResult& result) {
    nlohmann::json json = {{"cascade", version()},  {"planes", result.tile.fields.size()},
                           {"steps", result.steps}, {"remark", result.remark},
                           {"features", nullptr},   {"cells", nullptr}};
    if (!result.log.empty()) json["log"] = result.log;
    if (result.failed()) return json;
    if (const auto& cells = result.cells) {
        json["cells"] = {cells->count, cells->births, cells->deaths};
    }
    json["features"] = nlohmann::json::object();
    const auto values = measure::to_array(*result.features);
    for (std::size_t k = 0; k < values.size(); ++k) {
        auto& feature = json["features"][std::string(measure::feature_names()[k])];
        feature = std::isfinite(values[k]) ? nlohmann::json(values[k]) : nlohmann::json(nullptr);
    }
    return json;
}

measure::Features features_of(const nlohmann::json& json) {
    std::array<double, measure::feature_count> values{};
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto& value = json.at(std::string(measure::feature_names()[k]));
        values[k] =
            value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    }
    return measure::from_array(values);
}

Grid flat_grid(std::int64_t width, std::int64_t height) {
    Grid grid;
    grid.width = width;
    grid.height = height;
    return grid;
}

/// Puts all planes of a canvas into one field, one below the other.
Field stacked(const Canvas& canvas) {
    const PlaneLayout& layout = canvas.fields[0].layout();
    const auto count = static_cast<std::int64_t>(canvas.fields.size());
    Field all{PlaneLayout(flat_grid(layout.width, layout.height * count))};
    for (std::int64_t p = 0; p < count; ++p) {
        const Field& field = canvas.fields[static_cast<std::size_t>(p)];
        for (std::int64_t j = 0; j < layout.height; ++j) {
            std::copy_n(field.row(j), layout.width, all.row(p * layout.height + j));
        }
    }
    return all;
}

std::optional<Canvas> unstacked(const Result<NpyArray>& array, std::size_t planes) {
    const auto count = static_cast<std::int64_t>(planes);
    if (!array || (count != 1 && count != 3) || array->rows % count != 0) return std::nullopt;
    const Field all = to_field(*array);
    Canvas canvas;
    const std::int64_t height = array->rows / count;
    for (std::int64_t p = 0; p < count; ++p) {
        Field field{PlaneLayout(flat_grid(array->columns, height))};
        for (std::int64_t j = 0; j < height; ++j) {
            std::copy_n(all.row(p * height + j), array->columns, field.row(j));
        }
        canvas.fields.push_back(std::move(field));
    }
    return canvas;
}

/// Averages over squares of `factor` × `factor` cells. In the last columns and rows, the squares
/// may have fewer cells. Cells outside the domain (NaN) are ignored.
Field average(const Field& field, std::int64_t factor) {
    const PlaneLayout& from = field.layout();
    Field small{PlaneLayout(
        flat_grid((from.width + factor - 1) / factor, (from.height + factor - 1) / factor))};
    for (std::int64_t j = 0; j < small.layout().height; ++j) {
        for (std::int64_t i = 0; i < small.layout().width; ++i) {
            const std::int64_t right = std::min((i + 1) * factor, from.width);
            const std::int64_t bottom = std::min((j + 1) * factor, from.height);
            double sum = 0, inside = 0;
            for (std::int64_t y = j * factor; y < bottom; ++y) {
                for (std::int64_t x = i * factor; x < right; ++x) {
                    const float value = field.at(x, y);
                    if (!std::isfinite(value)) continue;
                    sum += value;
                    inside += 1;
                }
            }
            small.at(i, j) = inside > 0 ? static_cast<float>(sum / inside)
                                        : std::numeric_limits<float>::quiet_NaN();
        }
    }
    return small;
}

std::string json_text_of(const SweepResult& result) {
    return json_of(result).dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Reads a result from the text that json_text_of() has written. `tile_of` reads the array of the
/// result, if there is one.
template <typename TileOf>
std::optional<SweepResult> result_in(std::string_view text, const TileOf& tile_of) {
    // The JSON library throws exceptions. None of them may leave this function.
    try {
        const auto json = nlohmann::json::parse(text);
        SweepResult result;
        result.steps = json.at("steps").get<std::int64_t>();
        result.remark = json.at("remark").get<std::string>();
        result.log = json.value("log", "");
        if (json.at("features").is_null()) return result;
        result.features = features_of(json.at("features"));
        if (const auto& cells = json.at("cells"); !cells.is_null()) {
            result.cells = {cells.at(0).get<std::int64_t>(), cells.at(1).get<std::int64_t>(),
                            cells.at(2).get<std::int64_t>()};
        }
        auto tile = unstacked(tile_of(), json.at("planes").get<std::size_t>());
        if (!tile) return std::nullopt;
        result.tile = std::move(*tile);
        return result;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

}  // namespace

std::string key_of_run(const Script& script, const PictureRequest& picture, int tile_side,
                       const std::string& logged) {
    std::uint64_t hash = add_line(fnv1a("sweep 2"), version());
    hash = add_files(add_words(hash, script), script);
    hash = add_line(hash, overrides_to_json(script.overrides));
    // Colours and their range are chosen when the sheet is drawn, so they are not part of the key.
    PictureRequest shown;
    shown.show = picture.show;
    shown.slice = picture.slice;
    if (script.program->domain.model || has_stage_of_cells(*script.program)) {
        shown = picture;  // The tile is a picture, so the colours are part of the key.
    }
    hash = add_line(add_line(hash, to_json(shown)), fmt::format("{}", tile_side));
    if (!logged.empty()) hash = add_line(add_line(hash, logged), to_json(picture));
    return fmt::format("{:016x}", hash);
}

Result<void> write_result(const std::filesystem::path& folder, const std::string& key,
                          const SweepResult& result) {
    if (!result.tile.fields.empty()) {
        auto done = write_npy(folder / (key + ".npy"), stacked(result.tile));
        if (!done) return done;
    }
    return write_file(folder / (key + ".json"), json_text_of(result) + "\n");
}

std::optional<SweepResult> read_result(const std::filesystem::path& folder,
                                       const std::string& key) {
    const auto text = read_file(folder / (key + ".json"), largest_result);
    if (!text) return std::nullopt;
    return result_in(*text, [&] { return read_npy(folder / (key + ".npy")); });
}

std::string pack_result(const SweepResult& result) {
    std::string bytes = json_text_of(result) + '\0';
    if (!result.tile.fields.empty()) bytes += encode_npy(stacked(result.tile));
    return bytes;
}

std::optional<SweepResult> unpack_result(std::string_view bytes) {
    const std::size_t end = bytes.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    return result_in(bytes.substr(0, end), [&] { return parse_npy(bytes.substr(end + 1)); });
}

Canvas canvas_of(const Image& image) {
    Canvas canvas;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        Field field{PlaneLayout(flat_grid(image.width, image.height))};
        for (std::int64_t j = 0; j < image.height; ++j) {
            for (std::int64_t i = 0; i < image.width; ++i) {
                field.at(i, j) = image.at(i, j)[channel];
            }
        }
        canvas.fields.push_back(std::move(field));
    }
    return canvas;
}

Canvas shrink(const Canvas& canvas, int side) {
    const PlaneLayout& layout = canvas.fields[0].layout();
    const std::int64_t factor = (std::max(layout.width, layout.height) + side - 1) / side;
    Canvas small;
    for (const Field& field : canvas.fields) small.fields.push_back(average(field, factor));
    return small;
}

}  // namespace cascade
