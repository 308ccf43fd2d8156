// The table of the options of files. The options of pictures are in run/script/picture_options.def.
#include "library/file_options.h"

#include "core/json_size.h"
#include "film/film.h"
#include "run/script/json_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <string_view>
#include <vector>

namespace cascade {
namespace {

using Json = nlohmann::json;

/// The name of an option, and a function that reads its value and returns false if the value is
/// wrong.
struct FileOption {
    std::string_view name;
    bool (*read)(const Json& json, RunRequest& request);
};

template <typename T>
bool read_within(const Json& json, T& value, T low, T high) {
    return from_json_value(json, value) && value >= low && value <= high;
}

constexpr FileOption file_options[] = {
    {"bake",
     [](const Json& json, RunRequest& to) {
         return read_within<std::int64_t>(json, to.model_files.bake, 1,
                                          ModelFileOptions::most_texels);
     }},
    {"texels_per_cell",
     [](const Json& json, RunRequest& to) {
         return read_within(json, to.model_files.texels_per_cell, 0.01, 1000.0);
     }},
    {"lods",
     [](const Json& json, RunRequest& to) {
         return read_within(json, to.model_files.levels, 2, ModelFileOptions::most_levels);
     }},
    {"retile",
     [](const Json& json, RunRequest& to) { return from_json_value(json, to.model_files.retile); }},
    {"unwrap",
     [](const Json& json, RunRequest& to) { return from_json_value(json, to.model_files.unwrap); }},
    {"merge",
     [](const Json& json, RunRequest& to) { return from_json_value(json, to.model_files.merge); }},
    {"exr",
     [](const Json& json, RunRequest& to) {
         bool is_exr = false;
         if (!from_json_value(json, is_exr)) return false;
         if (is_exr) to.model_files.map_format = MapFormat::exr;
         return true;
     }},
    {"panel", [](const Json& json, RunRequest& to) { return from_json_value(json, to.panels); }},
    {"turntable",
     [](const Json& json, RunRequest& to) { return read_within(json, to.turntable, 1, 9999); }},
    {"slices",
     [](const Json& json, RunRequest& to) { return read_within(json, to.slices, 1, 100000); }},
    {"fps",
     [](const Json& json, RunRequest& to) {
         return read_within(json, to.film.frames_per_second, slowest_film, fastest_film);
     }},
    {"seconds", [](const Json& json,
                   RunRequest& to) { return read_within(json, to.film.seconds, 0.1, 86400.0); }},
};

constexpr std::string_view picture_options[] = {
#define CASCADE_PICTURE_OPTION(type, member, initial, key, ...) key,
#include "run/script/picture_options.def"
};

/// Adds an option to the request, or to `picture`, the options of the picture.
Result<void> read_option(const std::string& name, const Json& value, RunRequest& request,
                         Json& picture) {
    const auto wrong = [&] {
        return failure(fmt::format("'{}' cannot be {}", name, value.dump()),
                       "'cascade run --help' says which values it has");
    };
    for (const FileOption& option : file_options) {
        if (option.name != name) continue;
        return option.read(value, request) ? Result<void>() : wrong();
    }
    std::vector<std::string_view> known;
    for (const std::string_view key : picture_options) {
        known.push_back(key);
        if (key != name) continue;
        picture[name] = value;
        return picture_request_from_json(Json{{name, value}}.dump()) ? Result<void>() : wrong();
    }
    for (const FileOption& option : file_options) known.push_back(option.name);
    return failure(fmt::format("files have no option '{}'", name),
                   fmt::format("their options are {}", fmt::join(known, ", ")));
}

}  // namespace

Result<RunRequest> file_request(const std::string& options) {
    Json json;
    if (is_small_json(options)) json = Json::parse(options, nullptr, false);
    if (!json.is_object()) return failure("the options are not a JSON object", "{} has none");
    RunRequest request;
    Json picture = Json::object();
    for (const auto& [name, value] : json.items()) {
        if (auto read = read_option(name, value, request, picture); !read) {
            return tl::unexpected(read.error());
        }
    }
    auto read = picture_request_from_json(picture.dump());
    if (!read) return tl::unexpected(read.error());
    request.picture = *std::move(read);
    return request;
}

}  // namespace cascade
