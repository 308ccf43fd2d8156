// Scales the mesh of the file along its axes. Normals are multiplied by the inverse factors.
#include "run/pictures/file_shape.h"

#include "mesh/make_mesh.h"
#include "mesh/model_file.h"
#include "run/domain/creased_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

/// A side that is shorter than this is a rounding error and counts as 0. The longest side is 1.
constexpr float least_side = 1e-6F;

/// Multiplies each component by its factor.
Vector3 times(Vector3 a, Vector3 factors) {
    return {a.x * factors.x, a.y * factors.y, a.z * factors.z};
}

}  // namespace

Result<FileShape> read_shape(const Script& script, const std::string& path) {
    auto soup = read_model(GrantedFiles(script.folder, script.overrides.reads), path);
    if (!soup) return tl::unexpected(soup.error());
    auto made = make_mesh(*std::move(soup));
    if (!made) {
        return failure(fmt::format("'{}': {}", path, made.error().message), made.error().hint);
    }
    FileShape shape;
    shape.mesh = creased_mesh(made->mesh).mesh;
    Box box;
    for (std::size_t k = 0; k < shape.mesh.positions.size(); ++k) {
        if (k == 0) box = {shape.mesh.positions[0], shape.mesh.positions[0]};
        box.add(shape.mesh.positions[k]);
    }
    const Vector3 sides = box.high - box.low;
    const auto factor = [](float side, float wanted) {
        return wanted / (side > least_side ? side : 1);
    };
    const Vector3 factors{factor(sides.x, 2), factor(sides.y, 1), factor(sides.z, 2)};
    const Vector3 base{(box.low.x + box.high.x) / 2, box.low.y, (box.low.z + box.high.z) / 2};
    for (Vector3& p : shape.mesh.positions) p = times(p - base, factors);
    const Vector3 inverse{1 / factors.x, 1 / factors.y, 1 / factors.z};
    for (Vector3& normal : shape.mesh.normals) normal = unit(times(normal, inverse));
    const auto side = [](float length) {
        return static_cast<double>(std::max(length, least_side));
    };
    shape.length = side(sides.z) / side(sides.x);
    shape.height = side(sides.y) / side(sides.x);
    return shape;
}

}  // namespace cascade
