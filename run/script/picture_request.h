// What a picture is asked to show.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "picture/slice.h"
#include "render/camera.h"

#include <optional>
#include <string>

namespace cascade {

/// Options of `cascade run` that decide a picture's looks. They travel inside the picture.
struct PictureRequest {
    std::string show;  ///< An expression; "" is the picture block or the default.
    std::string palette = "grey";
    std::optional<ValueRange> range;  ///< Empty: from the values.
    int scale = 1;                    ///< Pixels per cell.
    int depth = 8;                    ///< Bits: 8 or 16.
    bool space_time = false;          ///< 1-D grids: a row of pixels per interval.
    Slice slice;                      ///< 3-D grids: what a picture shows of them.
    bool flat = false;                ///< Of a surface: the texture alone.
    View view;                        ///< Of a surface: from where it is seen.
    /// Of a model: how far the largest number stands out before the smallest one, in sides of the
    /// model, −1 … 1.
    float bump = 0;

    /// Is the surface seen from another place than usual?
    bool is_turned() const;
    PngDepth png_depth() const { return depth == 16 ? PngDepth::sixteen : PngDepth::eight; }
};

std::string to_json(const PictureRequest& request);
Result<PictureRequest> picture_request_from_json(const std::string& json);

}  // namespace cascade
