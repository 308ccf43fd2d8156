// Renders a scene with smooth shading, soft shadows and a ground plane.
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

/// Gives the colour (sRGB) of the surface at a hit. Several threads call it at once.
using SurfaceColour = std::function<Colour(const Hit&)>;

struct Sight {
    Hit hit;
    Vector3 direction;  ///< Direction of the ray, of length 1.
    /// The width of the area that the ray samples, at the hit and perpendicular to the ray.
    float width = 0;
};

/// The appearance of the body at a point. It does not apply to copies, which have colours of their
/// own.
struct Look {
    Colour light{};  ///< Reflected fractions of red, green and blue light, 0 … 1 (light_of).
    Vector3 tilt;    ///< Added to the outward normal, which has length 1.
    Colour glow{};   ///< Emitted light, 0 … 1.
    Gloss gloss = {};
};

using SurfaceLook = std::function<Look(const Sight&)>;

struct DrawOptions {
    std::int64_t width = 800, height = 600;  ///< In pixels, at least 1.
    Quality quality = Quality::normal;
    View view;
    Lighting lighting = Lighting::sun;
    /// The colour of the background. If nullopt, the picture has a transparent background and an
    /// alpha channel.
    std::optional<Colour> background = pure_white;
    bool ground = true;
    bool round_shadows =
        false;  ///< Whether to make shadows on large facets look as if the surface were smooth.
    /// The opacity of the body at a hit, 0 … 1. If empty, the body is opaque. If the opacity is
    /// below 1, light passes, and surfaces behind the body are visible. Several threads call it at
    /// once.
    std::function<float(const Hit&)> opacity = {};
    /// Called now and then, in the calling thread, with the fraction of the picture that is done, 0
    /// … 1. May be empty. If the function returns false, drawing stops, and the returned picture is
    /// incomplete.
    std::function<bool(double)> report = {};
};

/// Renders by ray tracing. The picture is the same with any number of threads and on every
/// processor. Both sides of a surface are drawn. `look` gives the appearance of the body, and may
/// be empty if there is no body. Without a background, the opacity of a pixel is the fraction that
/// surfaces cover, and the shadow on the ground is black and partly transparent. If such a picture
/// is put over white, its shadow is as dark as in a picture with a white background. Throws
/// std::bad_alloc.
Image draw(const RayCaster& caster, const SurfaceLook& look, const DrawOptions& options,
           Team& team);

/// The picture of an empty scene.
inline Image empty_picture(const DrawOptions& options) {
    return Image(options.width, options.height, options.background.value_or(transparent));
}

/// Renders a body that has no other properties than its colour.
Image draw(const TriangleMesh& mesh, const SurfaceColour& colour, const DrawOptions& options,
           Team& team);

}  // namespace cascade
