// The options of a picture.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "picture/slice.h"
#include "render/camera.h"
#include "render/lighting.h"
#include "render/quality.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

struct PictureSize {
    std::int64_t width = 0, height = 0;  ///< In pixels.
    bool operator==(const PictureSize&) const = default;
};

/// The default size of pictures that are drawn from a viewpoint in space.
inline constexpr PictureSize usual_size{800, 600};

/// The numbers of copies that a picture of a periodic plane shows side by side.
struct PictureCopies {
    int across = 1, down = 1;
    bool operator==(const PictureCopies&) const = default;
};
inline constexpr int most_copies = 16;  ///< The largest number of copies along each axis.

/// Each cell may be divided into at most this number of smaller cells along each axis.
inline constexpr int most_detail = 8;

/// The options of `cascade run` that determine the appearance of a picture. They are stored in the
/// picture.
struct PictureRequest {
#define CASCADE_PICTURE_OPTION(type, member, initial, ...) type member = initial;
#include "run/script/picture_options.def"

    PngDepth png_depth() const { return depth == 16 ? PngDepth::sixteen : PngDepth::eight; }
};

/// Whether the values of an option are within their limits.
bool makes_sense(const View& view);
bool makes_sense(const ValueRange& range);
bool makes_sense(const PictureSize& size);
bool makes_sense(const PictureCopies& copies);
bool makes_sense(const Slice& slice);

/// Whether two values of an option differ. Two views are compared only by their directions.
template <typename T>
bool differ(const T& a, const T& b) {
    return a != b;
}
inline bool differ(const View& a, const View& b) {
    return a.azimuth != b.azimuth || a.elevation != b.elevation;
}

/// Makes a request for the default picture of an expression. If `expression` is empty, makes a
/// request for the picture of the script.
inline PictureRequest picture_of(std::string expression) {
    PictureRequest request;
    request.show = std::move(expression);
    return request;
}

/// Returns the background with this name, such as "none" or "#204060". Fails if the name is
/// unknown.
Result<std::optional<Colour>> background_named(std::string_view name);
std::string name_of(const std::optional<Colour>& background);

std::string to_json(const PictureRequest& request);
Result<PictureRequest> picture_request_from_json(const std::string& json);

}  // namespace cascade
