// Replaces functions that need OpenMesh, tinygltf or Embree, which exist only as native code. A
// page with a model also carries the model's cells, so these functions would be needed only for
// another model.
#include "core/check.h"
#include "mesh/coarse_copy.h"
#include "mesh/flat_triangles.h"
#include "mesh/isotropic_remesh.h"
#include "mesh/model_file.h"
#include "render/ray_caster.h"

#include <fmt/format.h>

#include <string_view>

namespace cascade {
namespace {

tl::unexpected<Failure> needs_program(std::string_view what) {
    return failure(fmt::format("a page that runs without the program cannot make {}", what),
                   "use 'cascade view'");
}

constexpr std::string_view cells = "the cells of this model";

}  // namespace

Result<CoarseCopy> coarse_copy(const SurfaceMesh&, double) { return needs_program(cells); }
Result<FlatTriangles> remove_flat_triangles(SurfaceMesh&) { return needs_program(cells); }
Result<void> isotropic_remesh(SurfaceMesh&, double, const BringBack&, const std::atomic<bool>&) {
    return needs_program("this surface");
}
Result<PolygonSoup> read_gltf(std::string_view, const GrantedFiles&) {
    return needs_program(cells);
}

// Without Embree, pictures are not ray traced.
struct RayCaster::Tree {};
RayCaster::RayCaster(const Scene& scene) : scene_(scene) {
    CHECK(is_available(), "pictures of surfaces are refused before they are drawn");
}
RayCaster::~RayCaster() = default;
bool RayCaster::is_available() { return false; }
std::optional<Hit> RayCaster::nearest(const Ray&, float) const { return std::nullopt; }
bool RayCaster::is_blocked(const Ray&, float) const { return false; }

}  // namespace cascade
