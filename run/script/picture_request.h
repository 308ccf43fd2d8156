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

/// Of pictures that are drawn from a place in space, if nothing else is asked for.
inline constexpr PictureSize usual_size{800, 600};

/// Copies of a plane's picture side by side.
struct PictureCopies {
    int across = 1, down = 1;
    bool operator==(const PictureCopies&) const = default;
};
inline constexpr int most_copies = 16;  ///< Along each axis.

/// The most parts of a cell along each axis.
inline constexpr int most_detail = 8;

/// The options of `cascade run` that determine a picture's look. They are stored in the picture.
struct PictureRequest {
    std::string show;  ///< An expression; empty for the picture block or the default.
    std::string palette = "grey";
    std::optional<ValueRange> range;  ///< Empty: from the values.
    int scale = 1;                    ///< Pixels per cell.
    int depth = 8;                    ///< Bits: 8 or 16.
    int detail = 1;                   ///< The end is carried to cells this many times as short.
    bool space_time = false;          ///< 1-D grids: a row of pixels per interval.
    Slice slice;                      ///< 3-D grids: the slice to show.
    bool flat = false;                ///< Of a surface: only the texture.
    View view;                        ///< Of a surface: the direction it is seen from.
    /// In pixels that `scale` multiplies. Of a plane: the picture is smooth, and as large as fits
    /// in; empty: a pixel for each cell. Of a surface; empty: the usual one.
    std::optional<PictureSize> size;
    PictureCopies copies;               ///< Of a plane that is periodic there.
    Quality quality = Quality::normal;  ///< Of a surface.
    Lighting lighting = Lighting::sun;  ///< Of a surface.
    /// Of a surface: the field of view along the shorter side of the picture, in degrees.
    std::optional<float> fov;
    bool ground = true;  ///< Of a surface: a plane below it that receives shadows.
    /// The background of pictures of surfaces; empty: transparent.
    std::optional<Colour> background = pure_white;
    /// Of a model: height of the largest number above the smallest one, in sides of the model, −1 …
    /// 1.
    float bump = 0;
    bool displace = false;  ///< Of a model: heights move the surface, in files, too.

    /// True if the view is not the default one.
    bool is_turned() const;
    PngDepth png_depth() const { return depth == 16 ? PngDepth::sixteen : PngDepth::eight; }
};

/// The default picture of an expression, or, if that is empty, of the script.
inline PictureRequest picture_of(std::string expression) {
    PictureRequest request;
    request.show = std::move(expression);
    return request;
}

/// A background by its name, "none" or "#204060"; fails for other names.
Result<std::optional<Colour>> background_named(std::string_view name);
std::string name_of(const std::optional<Colour>& background);

std::string to_json(const PictureRequest& request);
Result<PictureRequest> picture_request_from_json(const std::string& json);

}  // namespace cascade
