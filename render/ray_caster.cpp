// Embree with one instruction set and one building thread, so that all machines draw the same.
#include "render/ray_caster.h"

#include "core/check.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <new>

namespace cascade {

struct RayCaster::Scene {
    RTCScene scene = nullptr;
    ~Scene() {
        if (scene) rtcReleaseScene(scene);
    }
};

namespace {

/// The process's only device, which is never released: on releasing the last device, the library
/// that schedules Embree's tasks starts threads, and aborts if the system denies them.
RTCDevice the_device() {
    // One instruction set for all processors; building on one thread gives one tree.
    static const RTCDevice device = rtcNewDevice("isa=sse2,threads=1,set_affinity=0");
    CHECK(device, "the ray tracer starts");
    return device;
}

}  // namespace

RayCaster::RayCaster(const TriangleMesh& mesh) : scene_(std::make_unique<Scene>()) {
    CHECK(!mesh.triangles.empty(), "something is there to be drawn");
    Scene& self = *scene_;
    const RTCDevice device = the_device();
    self.scene = rtcNewScene(device);
    rtcSetSceneFlags(self.scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.positions.size()));
    auto* triangles = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    if (!positions || !triangles) {
        rtcReleaseGeometry(geometry);
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
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(self.scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(self.scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

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
    rtcIntersect1(scene_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

bool RayCaster::is_blocked(const Ray& ray, float reach) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = ray_of(ray, reach);
    rtcOccluded1(scene_->scene, &context, &query);
    return query.tfar < 0;  // Embree marks blocked rays this way.
}

}  // namespace cascade
