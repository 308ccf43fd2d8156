// Rendering of a scene with smooth shading, soft shadows and a ground plane.
#pragma once

#include "core/parallel.h"
#include "picture/image.h"
#include "render/camera.h"
#include "render/gloss.h"
#include "render/lighting.h"
#include "render/quality.h"
#include "render/ray_caster.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace cascade {

/// The colour (sRGB) of the surface at a hit. Several threads call it at once.
using SurfaceColour = std::function<Colour(const Hit&)>;

struct Sight {
    Hit hit;
    Vector3 direction;  ///< Direction of the ray, of length 1.
    float width = 0;    ///< Width of the ray's part of the pixel at the hit, across the ray.
};

/// The appearance of the body at a point. Copies have their own colours.
struct Look {
    Colour light{};  ///< Reflected fractions of red, green and blue light, 0 … 1 (light_of).
    Vector3 tilt;    ///< Added to the outward unit normal.
    Colour glow{};   ///< Emitted light, 0 … 1.
    Gloss gloss = {};
};

using SurfaceLook = std::function<Look(const Sight&)>;

struct DrawOptions {
    std::int64_t width = 800, height = 600;  ///< Pixels, at least 1.
    Quality quality = Quality::normal;
    View view;
    Lighting lighting = Lighting::sun;
    /// The background of the scene. If nullopt, the picture has `alpha`.
    std::optional<Colour> background = pure_white;
    bool ground = true;
    bool round_shadows = false;  ///< Smooths shadows on large facets.
    /// The opacity of the body at a hit, 0 … 1; empty: opaque. The background shows through, and
    /// light passes. Several threads call it at once.
    std::function<float(const Hit&)> opacity = {};
    /// Called now and then, in the calling thread, with the fraction done, 0 … 1. May be empty. If
    /// it returns false, drawing stops, and the picture is useless.
    std::function<bool(double)> report = {};
};

/// Renders by ray tracing. The picture is the same on any number of threads and on every processor.
/// Both sides of a surface are drawn. `look` is the body's, and may be empty if there is none.
/// Without a background, a surface is as opaque as the fraction of the pixel that it covers, and
/// the shadow on the ground is black: over white it is as dark as on a white background. Throws
/// std::bad_alloc.
Image draw(const RayCaster& caster, const SurfaceLook& look, const DrawOptions& options,
           Team& team);

/// The picture of an empty scene.
inline Image empty_picture(const DrawOptions& options) {
    return Image(options.width, options.height, options.background.value_or(transparent));
}

/// The same as draw() for a body with colours.
Image draw(const TriangleMesh& mesh, const SurfaceColour& colour, const DrawOptions& options,
           Team& team);

}  // namespace cascade
