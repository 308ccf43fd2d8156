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

/// A surface met by a ray.
struct Sight {
    Hit hit;
    Vector3 direction;  ///< Of the ray, of length 1.
    float width = 0;  ///< Side of the square, across the ray, that stands for its part of a pixel.
};

/// What the surface looks like there.
struct Look {
    Colour light{};  ///< What part of red, green and blue light comes back, 0 … 1 (light_of).
    Vector3 tilt;    ///< Added to the normal, which points outwards and has length 1.
};

/// Called from several threads at once.
using SurfaceLook = std::function<Look(const Sight&)>;

struct DrawOptions {
    std::int64_t width = 800, height = 600;  ///< Pixels, at least 1.
    int samples = 4;                         ///< Rays through each pixel: samples × samples.
    View view;
    bool ground = true;
    bool round_shadows = false;  ///< Shadows are those of a round surface, for large facets.
};

/// Traces rays. The same picture on any number of threads and on every processor. Both sides of a
/// surface are drawn. Throws std::bad_alloc.
Image draw(const TriangleMesh& mesh, const SurfaceColour& colour, const DrawOptions& options,
           Team& team);

/// The same with all that a look can be. `caster` is that of the mesh.
Image draw(const TriangleMesh& mesh, const RayCaster& caster, const SurfaceLook& look,
           const DrawOptions& options, Team& team);

}  // namespace cascade
