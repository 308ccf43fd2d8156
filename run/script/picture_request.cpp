// Converts requests for pictures to and from JSON.
#include "run/script/picture_request.h"

#include "core/json_size.h"
#include "run/script/json_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string_view>

namespace cascade {

bool makes_sense(const View& view) {
    return std::abs(view.azimuth) <= 360 && std::abs(view.elevation) <= 89;
}

bool makes_sense(const ValueRange& range) {
    return std::isfinite(range.low) && std::isfinite(range.high) && range.low != range.high;
}

bool makes_sense(const PictureSize& size) {
    constexpr std::int64_t largest = std::numeric_limits<std::int32_t>::max();
    return size.width >= 1 && size.width <= largest && size.height >= 1 && size.height <= largest;
}

bool makes_sense(const PictureCopies& copies) {
    return copies.across >= 1 && copies.across <= most_copies && copies.down >= 1 &&
           copies.down <= most_copies;
}

bool makes_sense(const Slice& slice) { return slice.place >= 0 && slice.place <= 1; }

Result<std::optional<Colour>> background_named(std::string_view name) {
    if (name == "none") return std::nullopt;
    if (const auto colour = find_colour(name)) return colour;
    return failure(fmt::format("'{}' is not a background", name),
                   "write none or a colour in quotes, as in --background '#204060'");
}

std::string name_of(const std::optional<Colour>& background) {
    return background ? hexadecimal(*background) : "none";
}

namespace {

/// Functions for the kinds of values in picture_options.def. They say how JSON stores a value, and
/// which values are valid.
namespace stored_values {

using Json = nlohmann::json;

template <typename T>
T& filled(T& value) {
    return value;
}
template <typename T>
T& filled(std::optional<T>& value) {
    return value ? *value : value.emplace();
}

/// Two functions, which write and read a value. `read` returns false if the JSON or the value is
/// invalid.
template <typename Write, typename Read>
struct Stored {
    Write write;
    Read read;
};

/// Stores a value as a value of JSON. `is_sensible` tells whether a value that was read is valid.
template <typename IsSensible>
auto plain(IsSensible is_sensible) {
    return Stored{[](auto value) -> Json { return filled(value); },
                  [=](const Json& json, auto& value) {
                      return from_json_value(json, filled(value)) && is_sensible(filled(value));
                  }};
}
auto whole(int low, int high) {
    return plain([=](int value) { return value >= low && value <= high; });
}
auto either(int one, int other) {
    return plain([=](int value) { return value == one || value == other; });
}
auto degrees(float low, float high) {
    return plain([=](float value) { return value >= low && value <= high; });
}
auto part_of_model(float low, float high) { return degrees(low, high); }
auto palette() {
    return plain([](const std::string& name) { return find_palette(name) != nullptr; });
}
auto text() {
    return plain([](const std::string&) { return true; });
}
auto flag() {
    return plain([](bool) { return true; });
}
auto yes_or_no() { return flag(); }

/// Stores two members of a value as a pair.
template <typename T, typename First, typename Second>
auto both(First T::*first, Second T::*second) {
    return Stored{[=](auto value) -> Json {
                      return {filled(value).*first, filled(value).*second};
                  },
                  [=](const Json& json, auto& value) {
                      std::pair<First, Second> read;
                      if (!from_json_value(json, read)) return false;
                      filled(value).*first = read.first;
                      filled(value).*second = read.second;
                      return makes_sense(filled(value));
                  }};
}
auto view() { return both(&View::azimuth, &View::elevation); }
auto range() { return both(&ValueRange::low, &ValueRange::high); }
auto size() { return both(&PictureSize::width, &PictureSize::height); }
auto copies() { return both(&PictureCopies::across, &PictureCopies::down); }

auto slice() {
    return Stored{[](const Slice& slice) -> Json {
                      return {name_of(slice.axis), slice.place};
                  },
                  [](const Json& json, Slice& slice) {
                      std::pair<std::string, double> read;
                      if (!from_json_value(json, read)) return false;
                      const auto axis = axis_of_name(read.first);
                      slice = {axis.value_or(Axis::z), read.second};
                      return axis && makes_sense(slice);
                  }};
}

/// Stores a value by its name. `named` converts a name to an optional or a Result.
template <typename Named>
auto by_name(Named named) {
    return Stored{[](const auto& value) -> Json { return name_of(value); },
                  [=](const Json& json, auto& value) {
                      std::string name;
                      if (!from_json_value(json, name)) return false;
                      const auto found = named(name);
                      if (found) value = *found;
                      return found.has_value();
                  }};
}
auto quality() { return by_name(quality_named); }
auto lighting() { return by_name(lighting_named); }
auto background() { return by_name(background_named); }

}  // namespace stored_values

}  // namespace

std::string to_json(const PictureRequest& request) {
    constexpr bool always = true, if_changed = false;
    const PictureRequest usual;
    nlohmann::json json;
#define CASCADE_PICTURE_OPTION(type, member, initial, key, stored, values, ...) \
    if (stored || differ(request.member, usual.member)) {                       \
        json[key] = stored_values::values.write(request.member);                \
    }
#include "run/script/picture_options.def"
    if (request.view.is_turning) json["turning"] = true;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<PictureRequest> picture_request_from_json(const std::string& written) {
    nlohmann::json json;
    if (is_small_json(written)) json = nlohmann::json::parse(written, nullptr, false);
    PictureRequest request;
    bool is_sound = json.is_object();
    const auto read = [&](const char* key, const auto& values, auto& value) {
        if (is_sound && json.contains(key)) is_sound = values.read(json[key], value);
    };
#define CASCADE_PICTURE_OPTION(type, member, initial, key, stored, values, ...) \
    read(key, stored_values::values, request.member);
#include "run/script/picture_options.def"
    read("turning", stored_values::flag(), request.view.is_turning);
    if (is_sound) return request;
    return failure("the stored picture options cannot be read");
}

}  // namespace cascade
