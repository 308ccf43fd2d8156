// Embree with one instruction set and one building thread, so that all machines draw the same
// picture.
//
// The root of the scene contains the body, and an instance for each copy. An instance refers to the
// tree of its mesh and has a transformation. So a mesh is stored once, however many copies there
// are.
#include "render/ray_caster.h"

#include "core/late_library.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// Embree's functions, named as in Embree but without the prefix `rtc`.
struct Embree {
    LateLibrary library{CASCADE_EMBREE_LIBRARY};
    decltype(&rtcAttachGeometryByID) attach_geometry = library["rtcAttachGeometryByID"];
    decltype(&rtcCommitGeometry) commit_geometry = library["rtcCommitGeometry"];
    decltype(&rtcCommitScene) commit_scene = library["rtcCommitScene"];
    decltype(&rtcGetDeviceError) get_device_error = library["rtcGetDeviceError"];
    decltype(&rtcGetSceneBounds) get_scene_bounds = library["rtcGetSceneBounds"];
    decltype(&rtcIntersect1) intersect = library["rtcIntersect1"];
    decltype(&rtcNewDevice) new_device = library["rtcNewDevice"];
    decltype(&rtcNewGeometry) new_geometry = library["rtcNewGeometry"];
    decltype(&rtcNewScene) new_scene = library["rtcNewScene"];
    decltype(&rtcOccluded1) occluded = library["rtcOccluded1"];
    decltype(&rtcReleaseGeometry) release_geometry = library["rtcReleaseGeometry"];
    decltype(&rtcReleaseScene) release_scene = library["rtcReleaseScene"];
    decltype(&rtcSetGeometryInstancedScene) set_instanced_scene =
        library["rtcSetGeometryInstancedScene"];
    decltype(&rtcSetGeometryTransform) set_transform = library["rtcSetGeometryTransform"];
    decltype(&rtcSetNewGeometryBuffer) set_new_geometry_buffer = library["rtcSetNewGeometryBuffer"];
    decltype(&rtcSetSceneFlags) set_scene_flags = library["rtcSetSceneFlags"];
};

const Embree& embree() {
    static const Embree functions;
    return functions;
}

}  // namespace

namespace {

/// The process's only device, which is never released. When the last device is released, the
/// library that schedules Embree's tasks starts threads, and aborts if the system denies them.
RTCDevice the_device() {
    // One instruction set for all processors, and one thread for building, so that trees are always
    // the same.
    static const RTCDevice device = [] {
        const RTCDevice made = embree().new_device("isa=sse2,threads=1,set_affinity=0");
        // Creating a device can only fail for lack of memory or threads.
        if (!made) throw std::bad_alloc();
        return made;
    }();
    return device;
}

struct Release {
    void operator()(RTCScene tree) const { embree().release_scene(tree); }
    void operator()(RTCGeometry geometry) const { embree().release_geometry(geometry); }
};
using TreePointer = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;
using GeometryPointer = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release>;

TreePointer new_tree() {
    TreePointer tree(embree().new_scene(the_device()));
    if (!tree) throw std::bad_alloc();
    embree().set_scene_flags(tree.get(), RTC_SCENE_FLAG_ROBUST);
    return tree;
}

GeometryPointer new_geometry(RTCGeometryType type) {
    GeometryPointer geometry(embree().new_geometry(the_device(), type));
    if (!geometry) throw std::bad_alloc();
    return geometry;
}

/// Attaches a geometry to a tree, which then shares its ownership.
void attach(const GeometryPointer& geometry, const TreePointer& tree, std::size_t number) {
    embree().commit_geometry(geometry.get());
    embree().attach_geometry(tree.get(), geometry.get(), static_cast<unsigned>(number));
}

void attach_mesh(const TriangleMesh& mesh, const TreePointer& tree, std::size_t number) {
    const GeometryPointer geometry = new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(embree().set_new_geometry_buffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
        mesh.positions.size()));
    auto* triangles = static_cast<unsigned*>(
        embree().set_new_geometry_buffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                         3 * sizeof(unsigned), mesh.triangles.size()));
    if (!positions || !triangles) throw std::bad_alloc();
    for (const Vector3& p : mesh.positions) {
        *positions++ = p.x;
        *positions++ = p.y;
        *positions++ = p.z;
    }
    for (const auto& corners : mesh.triangles) {
        for (const std::uint32_t corner : corners) *triangles++ = corner;
    }
    attach(geometry, tree, number);
}

void attach_copy(const Placement& placement, const TreePointer& of_mesh, const TreePointer& tree,
                 std::size_t number) {
    const GeometryPointer geometry = new_geometry(RTC_GEOMETRY_TYPE_INSTANCE);
    embree().set_instanced_scene(geometry.get(), of_mesh.get());
    const PlacementMap map(placement);
    const std::array<Vector3, 4> columns = {map.x(), map.y(), map.z(), map.place()};
    embree().set_transform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    attach(geometry, tree, number);
}

void finish(const TreePointer& tree) {
    embree().commit_scene(tree.get());
    if (embree().get_device_error(the_device()) != RTC_ERROR_NONE) throw std::bad_alloc();
}

}  // namespace

struct RayCaster::Tree {
    TreePointer root = new_tree();
    std::vector<TreePointer> of_meshes;

    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    /// Embree ends the program when it releases a tree for which memory ran out, so such trees are
    /// not released.
    ~Tree() {
        if (is_built) return;
        (void)root.release();
        for (TreePointer& tree : of_meshes) (void)tree.release();
    }
    bool is_built = false;
};

RayCaster::RayCaster(const Scene& scene) : scene_(scene), tree_(std::make_unique<Tree>()) {
    const Instances& copies = scene.copies();
    for (const TriangleMesh& mesh : copies.meshes) {
        tree_->of_meshes.push_back(new_tree());
        attach_mesh(mesh, tree_->of_meshes.back(), 0);
        finish(tree_->of_meshes.back());
    }
    // The number of a copy is the index of its placement.
    const std::size_t count = copies.placements.size();
    for (std::size_t k = 0; k < count; ++k) {
        const Placement& placement = copies.placements[k];
        attach_copy(placement, tree_->of_meshes[placement.mesh], tree_->root, k);
    }
    if (scene.body()) attach_mesh(*scene.body(), tree_->root, count);
    finish(tree_->root);
    tree_->is_built = true;
    RTCBounds box;
    embree().get_scene_bounds(tree_->root.get(), &box);
    around_ = {{box.lower_x, box.lower_y, box.lower_z}, {box.upper_x, box.upper_y, box.upper_z}};
    const float more = 1e-3F * length(around_.high - around_.low);
    around_ = {around_.low - Vector3{more, more, more}, around_.high + Vector3{more, more, more}};
}

bool RayCaster::is_available() { return true; }

RayCaster::~RayCaster() = default;

namespace {

RTCRay ray_of(const Ray& ray, float reach) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tfar = reach;
    result.mask = 0xffffffff;
    return result;
}

}  // namespace

/// Whether a ray misses the scene's box, or ends before reaching it. Most rays from the ground do,
/// and this test takes far less time than a search by Embree.
bool RayCaster::misses_all(const Ray& ray, float reach) const {
    float enters = 0, leaves = reach;
    for (float Vector3::*axis : {&Vector3::x, &Vector3::y, &Vector3::z}) {
        const float inverse = 1 / ray.direction.*axis;
        const float low = (around_.low.*axis - ray.origin.*axis) * inverse;
        const float high = (around_.high.*axis - ray.origin.*axis) * inverse;
        enters = std::max(enters, std::min(low, high));
        leaves = std::min(leaves, std::max(low, high));
    }
    return enters > leaves;
}

std::optional<Hit> RayCaster::nearest(const Ray& ray, float beyond) const {
    if (misses_all(ray, INFINITY)) return std::nullopt;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = ray_of(ray, INFINITY);
    query.ray.tnear = beyond;
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree().intersect(tree_->root.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    static_assert(Hit::body == RTC_INVALID_GEOMETRY_ID);
    return Hit{query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar, query.hit.instID[0]};
}

bool RayCaster::is_blocked(const Ray& ray, float reach) const {
    if (misses_all(ray, reach)) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = ray_of(ray, reach);
    embree().occluded(tree_->root.get(), &context, &query);
    return query.tfar < 0;  // Embree sets the end of a blocked ray to a negative value.
}

}  // namespace cascade
