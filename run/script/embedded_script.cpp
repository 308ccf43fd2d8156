// Stores overrides as JSON in PNG text chunks. Everything that is read is checked, because a file
// may come from anywhere.
#include "run/script/embedded_script.h"

#include "core/file.h"
#include "core/json_size.h"
#include "core/version.h"
#include "run/script/json_fields.h"
#include "run/script/script_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace cascade {

namespace {

constexpr const char* key_name = "Cascade name";
constexpr const char* key_script = "Cascade script";
constexpr const char* key_overrides = "Cascade overrides";
constexpr const char* key_seed = "Cascade seed";
constexpr const char* key_picture = "Cascade picture";
constexpr const char* key_sweep = "Cascade sweep";

/// Reads the strings in the chunk of a sweep's sheet. Returns no strings if the chunk is not a list
/// of strings.
std::vector<std::string> texts_of(const std::string& text) {
    if (!is_small_json(text)) return {};
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_array()) return {};
    std::vector<std::string> texts;
    for (const auto& each : json) {
        if (!each.is_string()) return {};
        texts.push_back(each.get<std::string>());
    }
    return texts;
}

template <typename T>
nlohmann::json stored_override(const T& value) {
    if constexpr (requires { name_of(value); }) return name_of(value);
    else return value;
}

template <typename T>
void read_override(JsonFields& fields, const char* key, std::optional<T>& value) {
    fields.read(key, value);
}
void read_override(JsonFields& fields, const char* key, std::optional<Precision>& value) {
    fields.read(key, value, precision_of_name);
}
void read_override(JsonFields& fields, const char* key, std::optional<Axis>& value) {
    fields.read(key, value, axis_of_name);
}
void read_override(JsonFields& fields, const char* key, std::optional<Heading>& value) {
    fields.read(key, value, heading_of_name);
}

}  // namespace

std::string overrides_to_json(const Overrides& overrides) {
    nlohmann::json json = nlohmann::json::object();
    if (!overrides.sets.empty()) json["set"] = overrides.sets;
    if (overrides.grid) {
        json["grid"] = {overrides.grid->width, overrides.grid->height};
        if (overrides.grid->depth > 1) json["grid"].push_back(overrides.grid->depth);
    }
#define CASCADE_OVERRIDE(type, member, ...) \
    if (overrides.member) json[#member] = stored_override(*overrides.member);
#include "run/script/override_options.def"
    if (!overrides.used.empty()) json["used"] = overrides.used;
    if (overrides.fast) json["fast"] = true;
    if (overrides.model) json["mesh"] = portable_path(*overrides.model);
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<Overrides> overrides_from_json(const std::string& text) {
    const Failure unreadable{"the stored overrides cannot be read", ""};
    if (!is_small_json(text)) return tl::unexpected(unreadable);
    const auto json = nlohmann::json::parse(text, nullptr, false);
    JsonFields fields(json);
    Overrides overrides;
    std::vector<std::int64_t> grid;
    fields.read("set", overrides.sets);
    fields.read("grid", grid);
#define CASCADE_OVERRIDE(type, member, ...) read_override(fields, #member, overrides.member);
#include "run/script/override_options.def"
    fields.read("used", overrides.used);
    fields.read("fast", overrides.fast);
    fields.read("mesh", overrides.model);
    if (!fields.is_sound() || grid.size() == 1 || grid.size() > 3) {
        return tl::unexpected(unreadable);
    }
    if (!grid.empty()) overrides.grid = {grid[0], grid[1], grid.size() > 2 ? grid[2] : 1};
    return overrides;
}

namespace {

/// If `changes` replace the model, discards the orientation of the old model.
void leave_stance(Overrides& base, const Overrides& changes) {
    base.up = changes.up;
    base.facing = changes.facing;
}

}  // namespace

Overrides merge(Overrides base, const Overrides& changes) {
    base.sets.insert(base.sets.end(), changes.sets.begin(), changes.sets.end());
    if (changes.grid) base.grid = changes.grid;
    base.grid_is_one_number = changes.grid_is_one_number;
    base.fast = base.fast || changes.fast;
#define CASCADE_OVERRIDE(type, member, ...) \
    if (changes.member) base.member = changes.member;
#include "run/script/override_options.def"
    if (changes.model) {
        // A picture stores only the name of its model's file, without the folder, but the user
        // gives the present path. So only the names of files are compared.
        const bool is_same_model =
            base.model && std::filesystem::path(*base.model).filename() ==
                              std::filesystem::path(*changes.model).filename();
        base.model = changes.model;
        base.model_is_asked_for = changes.model_is_asked_for;
        base.grid.reset();
        if (!is_same_model) leave_stance(base, changes);
    } else if (changes.grid) {
        base.model.reset();
        base.cells.reset();
        leave_stance(base, changes);
    }
    base.reads = changes.reads;
    return base;
}

PngTexts embed_script(const Script& script, const PictureRequest& picture) {
    return {
        {"Software", fmt::format("Cascade {}", version())},
        {key_name, portable_path(script.name)},
        {key_script, script.text},
        {key_overrides, overrides_to_json(script.overrides)},
        {key_seed, fmt::format("{}", script.program->domain.seed)},
        {key_picture, to_json(picture)},
    };
}

PngTexts embed_sweep(const Script& script, const PictureRequest& picture,
                     const std::vector<std::string>& varied) {
    PngTexts texts = embed_script(script, picture);
    texts[key_sweep] =
        nlohmann::json(varied).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return texts;
}

Result<EmbeddedScript> parse_embedded_script(std::string_view bytes, const std::string& file) {
    auto texts = parse_png_texts(bytes);
    if (!texts) {
        return failure(fmt::format("cannot read '{}': {}", file, texts.error().message),
                       texts.error().hint);
    }
    const auto script = texts->find(key_script);
    if (script == texts->end()) {
        return failure(fmt::format("{}: this picture carries no Cascade script", file),
                       "only pictures that 'cascade run' wrote can be run again");
    }
    auto overrides = overrides_from_json(texts->contains(key_overrides) ? texts->at(key_overrides)
                                                                        : std::string("{}"));
    if (!overrides) {
        return failure(fmt::format("{}: {}", file, overrides.error().message));
    }
    EmbeddedScript embedded;
    embedded.name = texts->contains(key_name) ? texts->at(key_name) : file;
    embedded.text = script->second;
    embedded.overrides = std::move(*overrides);
    if (texts->contains(key_picture)) embedded.picture_options = texts->at(key_picture);
    if (texts->contains(key_sweep)) embedded.varied = texts_of(texts->at(key_sweep));
    if (texts->contains(key_session)) embedded.session = texts->at(key_session);
    if (!embedded.picture_options.empty()) {
        const auto picture = picture_request_from_json(embedded.picture_options);
        if (!picture) {
            return failure(fmt::format("{}: {}", file, picture.error().message));
        }
    }
    return embedded;
}

Result<EmbeddedScript> read_embedded_script(const std::filesystem::path& path) {
    constexpr std::uint64_t largest_picture = std::uint64_t{1} << 30;
    const auto bytes = read_plain_file(path, largest_picture);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_embedded_script(*bytes, path.string());
}

}  // namespace cascade
