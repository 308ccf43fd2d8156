// A picture of a surface: smooth shading, soft shadows, a ground to stand on.
#pragma once

#include "core/parallel.h"
#include "picture/image.h"
#include "render/camera.h"
#include "render/ray_caster.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// The colour (sRGB) of the surface where a ray met it. Called from several threads at once.
using SurfaceColour = std::function<Colour(const Hit&)>;

struct DrawOptions {
    std::int64_t width = 800, height = 600;  ///< Pixels, at least 1.
    int samples = 4;                         ///< Rays through each pixel: samples × samples.
    View view;
    bool ground = true;
};

/// Traces rays. The same picture on any number of threads and on every processor. Both sides of a
/// surface are drawn. Throws std::bad_alloc.
Image draw(const TriangleMesh& mesh, const SurfaceColour& colour,
                   const DrawOptions& options, Team& team);

}  // namespace cascade
