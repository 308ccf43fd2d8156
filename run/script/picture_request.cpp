// Conversion to and from JSON. Options of some domains only are written only if used, so that
// pictures of planes keep their bytes.
#include "run/script/picture_request.h"

#include "core/json_size.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace cascade {

namespace {

bool makes_sense(const PictureRequest& request) {
    if (request.scale < 1 || request.scale > 64) return false;
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
    if (!(request.slice.place >= 0 && request.slice.place <= 1)) return false;
    return find_palette(request.palette) != nullptr;
}

}  // namespace

bool PictureRequest::is_turned() const {
    const View usual;
    return view.azimuth != usual.azimuth || view.elevation != usual.elevation;
}

std::string to_json(const PictureRequest& request) {
    nlohmann::json json = {{"palette", request.palette},
                           {"scale", request.scale},
                           {"depth", request.depth},
                           {"space_time", request.space_time}};
    if (request.flat) json["flat"] = true;
    if (request.is_turned()) json["view"] = {request.view.azimuth, request.view.elevation};
    if (request.view.is_turning) json["turning"] = true;
    if (request.bump != 0) json["bump"] = request.bump;
    if (!request.show.empty()) json["show"] = request.show;
    if (request.slice != Slice{}) {
        json["slice"] = {name_of(request.slice.axis), request.slice.place};
    }
    if (request.range) json["range"] = {request.range->low, request.range->high};
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<PictureRequest> picture_request_from_json(const std::string& text) {
    if (!is_small_json(text)) return failure("the stored picture options cannot be read");
    // The JSON library throws; no exception leaves this function.
    try {
        const auto json = nlohmann::json::parse(text);
        PictureRequest request;
        request.palette = json.value("palette", request.palette);
        request.scale = json.value("scale", request.scale);
        request.depth = json.value("depth", request.depth);
        request.space_time = json.value("space_time", request.space_time);
        request.show = json.value("show", request.show);
        if (json.contains("slice")) {
            const auto axis = axis_of_name(json.at("slice").at(0).get<std::string>());
            if (!axis) return failure("the stored picture options make no sense");
            request.slice = {*axis, json.at("slice").at(1).get<double>()};
        }
        request.flat = json.value("flat", request.flat);
        if (json.contains("view")) {
            request.view.azimuth = json.at("view").at(0).get<float>();
            request.view.elevation = json.at("view").at(1).get<float>();
        }
        request.view.is_turning = json.value("turning", false);
        request.bump = json.value("bump", request.bump);
        if (json.contains("range")) {
            request.range = ValueRange{json.at("range").at(0).get<float>(),
                                       json.at("range").at(1).get<float>()};
        }
        if (!makes_sense(request)) return failure("the stored picture options make no sense");
        return request;
    } catch (const nlohmann::json::exception&) {
        return failure("the stored picture options cannot be read");
    }
}

}  // namespace cascade
