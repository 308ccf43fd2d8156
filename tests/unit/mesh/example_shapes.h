// Meshes of a ball and of thorns.
#pragma once

#include "mesh/swept_shape.h"

#include <cmath>
#include <numbers>

namespace cascade::test {

inline TriangleMesh mesh_of_surface(const SweptSurface& surface, const SweptDetail& detail) {
    return *swept_shape(surface, *facets_for(surface, detail));
}

/// A ball of radius 1, centred at the origin.
inline TriangleMesh ball(const SweptDetail& detail) {
    using std::numbers::pi;
    return mesh_of_surface(surface_of({[](double t, double) { return std::sin(pi * t); },
                                       [](double t) {
                                           return Vector3d{0, -std::cos(pi * t), 0};
                                       }}),
                           detail);
}

/// A thorn with a pole at its tip and a cap at its root, which leans towards z.
inline TriangleMesh thorn(double height, double lean, const SweptDetail& detail) {
    return mesh_of_surface(surface_of({[](double t, double) { return 1 - t; },
                                       [=](double t) {
                                           return Vector3d{0, height * t, lean * t * t};
                                       }}),
                           detail);
}

}  // namespace cascade::test
