// A camera that frames a scene automatically.
#pragma once

#include "render/scene.h"

#include <cstdint>

namespace cascade {

/// The direction from which a picture is taken.
struct View {
    float azimuth = 30;    ///< Degrees around the up axis, from the front to the right.
    float elevation = 25;  ///< Degrees above the horizon, −89 … 89.
    Vector3 up{0, 0, 1};   ///< One of the axes x, y, z.
    /// Whether the scene must fit into the picture at every azimuth. The camera then rotates around
    /// the centre of the scene's box, and the scene has the same position and size in a series of
    /// pictures from all sides.
    bool is_turning = false;
    /// The tangent of half the field of view, along the shorter side of the picture.
    float half_field = 0.22F;
    /// The size of the scene in the picture. 1 fills the picture.
    float zoom = 1;
};

struct Ray {
    Vector3 origin;
    Vector3 direction;  ///< Has length 1.
};

class Camera {
public:
    /// Places the camera so that the scene fills a picture of width × height pixels, with a margin.
    Camera(const Scene& scene, const View& view, std::int64_t width, std::int64_t height);

    /// The ray through a point of the picture, in pixels from its upper left corner.
    Ray ray(float x, float y) const;

    /// The width of a pixel at distance 1 from the eye.
    float pixel() const { return pixel_; }
    Vector3 eye() const { return eye_; }
    Vector3 right() const { return right_; }
    Vector3 up() const { return up_; }
    Vector3 backward() const { return backward_; }

private:
    Vector3 right_, up_, backward_, eye_;
    float pixel_ = 0;
    float centre_x_ = 0, centre_y_ = 0;
};

}  // namespace cascade
