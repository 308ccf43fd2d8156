// Embree with one instruction set and one building thread, so that all machines draw the same.
#include "render/ray_caster.h"

#include "core/check.h"
#include "core/late_library.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <new>

namespace cascade {

namespace {

/// Its functions, by the names that Embree gives them without `rtc`.
struct Embree {
    LateLibrary library{CASCADE_EMBREE_LIBRARY};
    decltype(&rtcAttachGeometry) attach_geometry = library["rtcAttachGeometry"];
    decltype(&rtcCommitGeometry) commit_geometry = library["rtcCommitGeometry"];
    decltype(&rtcCommitScene) commit_scene = library["rtcCommitScene"];
    decltype(&rtcGetDeviceError) get_device_error = library["rtcGetDeviceError"];
    decltype(&rtcIntersect1) intersect = library["rtcIntersect1"];
    decltype(&rtcNewDevice) new_device = library["rtcNewDevice"];
    decltype(&rtcNewGeometry) new_geometry = library["rtcNewGeometry"];
    decltype(&rtcNewScene) new_scene = library["rtcNewScene"];
    decltype(&rtcOccluded1) occluded = library["rtcOccluded1"];
    decltype(&rtcReleaseGeometry) release_geometry = library["rtcReleaseGeometry"];
    decltype(&rtcReleaseScene) release_scene = library["rtcReleaseScene"];
    decltype(&rtcSetNewGeometryBuffer) set_new_geometry_buffer = library["rtcSetNewGeometryBuffer"];
    decltype(&rtcSetSceneFlags) set_scene_flags = library["rtcSetSceneFlags"];
};

const Embree& embree() {
    static const Embree functions;
    return functions;
}

}  // namespace

struct RayCaster::Scene {
    RTCScene scene = nullptr;
    ~Scene() {
        if (scene) embree().release_scene(scene);
    }
};

namespace {

/// The process's only device, which is never released: on releasing the last device, the library
/// that schedules Embree's tasks starts threads, and aborts if the system denies them.
RTCDevice the_device() {
    // One instruction set for all processors; building on one thread gives one tree.
    static const RTCDevice device = embree().new_device("isa=sse2,threads=1,set_affinity=0");
    CHECK(device, "the ray tracer starts");
    return device;
}

}  // namespace

RayCaster::RayCaster(const TriangleMesh& mesh) : scene_(std::make_unique<Scene>()) {
    CHECK(!mesh.triangles.empty(), "something is there to be drawn");
    Scene& self = *scene_;
    const RTCDevice device = the_device();
    self.scene = embree().new_scene(device);
    embree().set_scene_flags(self.scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = embree().new_geometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(
        embree().set_new_geometry_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         3 * sizeof(float), mesh.positions.size()));
    auto* triangles = static_cast<unsigned*>(
        embree().set_new_geometry_buffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                         3 * sizeof(unsigned), mesh.triangles.size()));
    if (!positions || !triangles) {
        embree().release_geometry(geometry);
        throw std::bad_alloc();
    }
    for (const Vector3& p : mesh.positions) {
        *positions++ = p.x;
        *positions++ = p.y;
        *positions++ = p.z;
    }
    for (const auto& corners : mesh.triangles) {
        for (const std::uint32_t corner : corners) *triangles++ = corner;
    }
    embree().commit_geometry(geometry);
    embree().attach_geometry(self.scene, geometry);
    embree().release_geometry(geometry);
    embree().commit_scene(self.scene);
    if (embree().get_device_error(device) != RTC_ERROR_NONE) throw std::bad_alloc();
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

std::optional<Hit> RayCaster::nearest(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = ray_of(ray, INFINITY);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree().intersect(scene_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

bool RayCaster::is_blocked(const Ray& ray, float reach) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = ray_of(ray, reach);
    embree().occluded(scene_->scene, &context, &query);
    return query.tfar < 0;  // Embree marks blocked rays this way.
}

}  // namespace cascade
