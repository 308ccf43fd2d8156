// Conversion to and from JSON. Options of some domains only are written only if used, so that
// pictures of planes keep their bytes.
#include "run/script/picture_request.h"

#include "core/json_size.h"
#include "run/script/json_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace cascade {

namespace {

bool makes_sense(const PictureRequest& request) {
    if (request.scale < 1 || request.scale > 64) return false;
    if (request.detail < 1 || request.detail > most_detail) return false;
    if (request.depth != 8 && request.depth != 16) return false;
    if (!(std::abs(request.view.azimuth) <= 360 && std::abs(request.view.elevation) <= 89)) {
        return false;
    }
    // A range that runs downwards reverses the palette.
    if (request.range &&
        (!std::isfinite(request.range->low) || !std::isfinite(request.range->high) ||
         request.range->low == request.range->high)) {
        return false;
    }
    if (!(std::abs(request.bump) <= 1)) return false;
    if (request.fov && !(*request.fov >= 1 && *request.fov <= 120)) return false;
    const auto is_side = [](std::int64_t side) {
        return side >= 1 && side <= std::numeric_limits<std::int32_t>::max();
    };
    if (request.size && !(is_side(request.size->width) && is_side(request.size->height))) {
        return false;
    }
    const auto is_count = [](int count) { return count >= 1 && count <= most_copies; };
    if (!is_count(request.copies.across) || !is_count(request.copies.down)) return false;
    if (!(request.slice.place >= 0 && request.slice.place <= 1)) return false;
    return find_palette(request.palette) != nullptr;
}

}  // namespace

bool PictureRequest::is_turned() const {
    const View usual;
    return view.azimuth != usual.azimuth || view.elevation != usual.elevation;
}

Result<std::optional<Colour>> background_named(std::string_view name) {
    if (name == "none") return std::nullopt;
    if (const auto colour = find_colour(name)) return colour;
    return failure(fmt::format("'{}' is not a background", name),
                   "write none or a colour in quotes, as in --background '#204060'");
}

std::string name_of(const std::optional<Colour>& background) {
    return background ? hexadecimal(*background) : "none";
}

std::string to_json(const PictureRequest& request) {
    nlohmann::json json = {{"palette", request.palette},
                           {"scale", request.scale},
                           {"depth", request.depth},
                           {"space_time", request.space_time}};
    if (request.detail > 1) json["detail"] = request.detail;
    if (request.flat) json["flat"] = true;
    if (request.is_turned()) json["view"] = {request.view.azimuth, request.view.elevation};
    if (request.size) json["size"] = {request.size->width, request.size->height};
    if (request.copies != PictureCopies{}) {
        json["copies"] = {request.copies.across, request.copies.down};
    }
    if (request.quality != Quality::normal) json["quality"] = name_of(request.quality);
    if (request.lighting != Lighting::sun) json["light"] = name_of(request.lighting);
    if (request.fov) json["fov"] = *request.fov;
    if (!request.ground) json["ground"] = false;
    if (request.background != pure_white) json["background"] = name_of(request.background);
    if (request.view.is_turning) json["turning"] = true;
    if (request.displace) json["displace"] = true;
    if (request.bump != 0) json["bump"] = request.bump;
    if (!request.show.empty()) json["show"] = request.show;
    if (request.slice != Slice{}) {
        json["slice"] = {name_of(request.slice.axis), request.slice.place};
    }
    if (request.range) json["range"] = {request.range->low, request.range->high};
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<PictureRequest> picture_request_from_json(const std::string& text) {
    const Failure unreadable{"the stored picture options cannot be read", ""};
    const Failure senseless{"the stored picture options make no sense", ""};
    if (!is_small_json(text)) return tl::unexpected(unreadable);
    const auto json = nlohmann::json::parse(text, nullptr, false);
    JsonFields fields(json);
    PictureRequest request;
    std::vector<float> view, range;
    std::vector<std::int64_t> size;
    std::vector<int> copies;
    std::string quality(name_of(Quality::normal)), light(name_of(Lighting::sun));
    std::string background = name_of(request.background);
    fields.read("palette", request.palette);
    fields.read("scale", request.scale);
    fields.read("depth", request.depth);
    fields.read("space_time", request.space_time);
    fields.read("detail", request.detail);
    fields.read("show", request.show);
    fields.read("flat", request.flat);
    fields.read("view", view);
    fields.read("size", size);
    fields.read("copies", copies);
    fields.read("quality", quality);
    fields.read("light", light);
    if (json.contains("fov")) fields.read("fov", request.fov.emplace());
    fields.read("ground", request.ground);
    fields.read("background", background);
    fields.read("turning", request.view.is_turning);
    fields.read("bump", request.bump);
    fields.read("displace", request.displace);
    fields.read("range", range);
    const auto is_none_or_two = [](std::size_t count) { return count == 0 || count == 2; };
    if (!fields.is_sound() || !is_none_or_two(view.size()) || !is_none_or_two(range.size()) ||
        !is_none_or_two(size.size()) || !is_none_or_two(copies.size())) {
        return tl::unexpected(unreadable);
    }
    if (json.contains("slice")) {
        const nlohmann::json& slice = json["slice"];
        std::string axis;
        if (!slice.is_array() || slice.size() != 2 || !from_json_value(slice[0], axis) ||
            !from_json_value(slice[1], request.slice.place)) {
            return tl::unexpected(unreadable);
        }
        const auto found = axis_of_name(axis);
        if (!found) return tl::unexpected(senseless);
        request.slice.axis = *found;
    }
    if (!view.empty()) {
        request.view.azimuth = view[0];
        request.view.elevation = view[1];
    }
    if (!size.empty()) request.size = {size[0], size[1]};
    if (!copies.empty()) request.copies = {copies[0], copies[1]};
    const auto named = quality_named(quality);
    const auto lighting = lighting_named(light);
    if (!named || !lighting) return tl::unexpected(senseless);
    request.quality = *named;
    request.lighting = *lighting;
    const auto known_background = background_named(background);
    if (!known_background) return tl::unexpected(senseless);
    request.background = *known_background;
    if (!range.empty()) request.range = ValueRange{range[0], range[1]};
    if (!makes_sense(request)) return tl::unexpected(senseless);
    return request;
}

}  // namespace cascade
