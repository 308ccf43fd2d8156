// Frames the scene: moves the eye back and sideways until every vertex is inside the picture.
#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade {

namespace {

constexpr float margin = 1.12F;  ///< Free space around the scene.

/// Cosine and sine of an angle in degrees, computed in binary64 for equal bits on every processor.
struct Turn {
    float cosine, sine;
    explicit Turn(float degrees) {
        const double angle = static_cast<double>(degrees) * std::numbers::pi / 180;
        cosine = static_cast<float>(std::cos(angle));
        sine = static_cast<float>(std::sin(angle));
    }
};

/// The range of the scene along one axis of the picture. Seen from the eye, every vertex must be
/// between the slopes −half and half. So each vertex gives a lower bound of the eye's distance,
/// which is larger for vertices farther from the middle or nearer to the eye.
struct Extent {
    float low = -INFINITY, high = -INFINITY;
    void add(float offset, float backward, float half) {
        low = std::max(low, -offset + half * backward);
        high = std::max(high, offset + half * backward);
    }
    /// Adds all points of a circle. Its centre is at `offset` along the axis and at the depth
    /// `backward`. The points differ from the centre by the sine of an angle times `offset_sine`
    /// and `backward_sine`.
    void add_circle(float offset, float backward, float offset_sine, float backward_sine,
                    float half) {
        low =
            std::max(low, -offset + half * backward + std::abs(half * backward_sine - offset_sine));
        high =
            std::max(high, offset + half * backward + std::abs(half * backward_sine + offset_sine));
    }
    /// The eye's offset and distance at which the scene touches both edges of the picture.
    float offset() const { return (high - low) / 2; }
    float distance(float half) const { return (low + high) / (2 * half); }
};

}  // namespace

Camera::Camera(const Scene& scene, const View& view, std::int64_t width, std::int64_t height) {
    const Turn around(view.azimuth);
    const Turn above(view.elevation);
    // The axis towards a viewer at azimuth 0, and the axis to this viewer's right.
    const Vector3 front = view.up.z != 0   ? Vector3{0, -1, 0}
                          : view.up.y != 0 ? Vector3{0, 0, 1}
                                           : Vector3{0, 1, 0};
    const Vector3 side = cross(view.up, front);
    const Vector3 level = front * around.cosine + side * around.sine;
    backward_ = unit(level * above.cosine + view.up * above.sine);
    right_ = unit(cross(view.up, backward_));
    up_ = cross(backward_, right_);

    const auto pixels_wide = static_cast<float>(width);
    const auto pixels_high = static_cast<float>(height);
    const float smaller = std::min(pixels_wide, pixels_high);
    const float half_field = view.half_field;
    const float half_x = half_field * pixels_wide / smaller / margin;
    const float half_y = half_field * pixels_high / smaller / margin;
    Extent x, y;
    Vector3 middle;
    if (view.is_turning) {
        middle = bounds(scene).centre();
        scene.visit([&](const Vector3& p) {
            // When the scene rotates, each of its points describes a circle around the axis.
            const float rise = dot(p - middle, view.up);
            const float radius = length(p - middle - view.up * rise);
            const float back = rise * above.sine;
            // Along this axis, the terms with the cosine and the sine of the angle combine into one
            // sine.
            const float slope = half_x * above.cosine;
            const float swing = radius * std::sqrt(1 + slope * slope);
            x.add(swing, back, half_x);
            x.add(-swing, back, half_x);
            y.add_circle(rise * above.cosine, back, -radius * above.sine, radius * above.cosine,
                         half_y);
        });
    } else {
        scene.visit([&](const Vector3& p) {
            x.add(dot(p, right_), dot(p, backward_), half_x);
            y.add(dot(p, up_), dot(p, backward_), half_y);
        });
    }
    const float distance = std::max(x.distance(half_x), y.distance(half_y));
    eye_ = middle + right_ * x.offset() + up_ * y.offset() + backward_ * distance;
    pixel_ = 2 * half_field / smaller / view.zoom;
    centre_x_ = pixels_wide / 2;
    centre_y_ = pixels_high / 2;
}

Ray Camera::ray(float x, float y) const {
    const Vector3 direction =
        right_ * ((x - centre_x_) * pixel_) + up_ * ((centre_y_ - y) * pixel_) - backward_;
    return {eye_, unit(direction)};
}

}  // namespace cascade
