// SPDX-License-Identifier: MIT
//
// rtcCollide as its tutorial calls it: boxes as they are, low quality on geometry and scene alike, what it tells taken
// at its word.
#include "baselines/embree/device.h"
#include "baselines/embree/thread_pairs.h"
#include "baselines/plain_libraries.h"

namespace bvhbench {
namespace {

struct Object {
    std::span<const Point> points;
    std::span<const Face> faces;
    uint first = 0;
    EmbreeHandle<RTCGeometry> geometry = {};
    EmbreeHandle<RTCScene> scene = {};
};

struct Meeting {
    const Object* a;
    const Object* b;
    ThreadPairs* found;
};

void tell_box(const RTCBoundsFunctionArguments* asked)
{
    const auto& object = *static_cast<const Object*>(asked->geometryUserPtr);
    const Aabb box = face_box(object.points, object.faces[asked->primID]);
    *asked->bounds_o = {box.min_x, box.min_y, box.min_z, 0, box.max_x, box.max_y, box.max_z, 0};
}

void add(void* data, RTCCollision* collisions, unsigned count)
{
    const auto& [a, b, found] = *static_cast<const Meeting*>(data);
    for (const RTCCollision* one = collisions; one != collisions + count; ++one) {
        const Pair pair = {a->first + one->primID0, b->first + one->primID1};
        if (a != b || pair.a < pair.b)  // of an object with itself both ways are told
            found->mine().push_back(pair);
    }
}

void build(const EmbreeHandle<RTCDevice>& device, Object& object)
{
    object.geometry.reset(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(object.geometry.get(),
                                     static_cast<unsigned>(object.faces.size()));
    rtcSetGeometryUserData(object.geometry.get(), &object);
    rtcSetGeometryBoundsFunction(object.geometry.get(), tell_box, nullptr);
    rtcSetGeometryBuildQuality(object.geometry.get(), RTC_BUILD_QUALITY_LOW);
    rtcCommitGeometry(object.geometry.get());
    object.scene.reset(rtcNewScene(device.get()));
    rtcSetSceneBuildQuality(object.scene.get(), RTC_BUILD_QUALITY_LOW);
    rtcAttachGeometry(object.scene.get(), object.geometry.get());
    rtcCommitScene(object.scene.get());
}

}  // namespace

std::vector<Pair> plain_embree(std::span<const Point> points, std::span<const Face> faces,
                               std::span<const FaceRange> objects)
{
    const EmbreeHandle<RTCDevice> device = start_embree();
    std::vector<Object> made;
    made.reserve(objects.size());
    for (const FaceRange& range : objects) {
        made.push_back({points, faces.subspan(range.first, range.count), range.first});
        build(device, made.back());
    }
    ThreadPairs by_thread;
    Meeting meeting = {&made.front(), &made.back(), &by_thread};
    rtcCollide(meeting.a->scene.get(), meeting.b->scene.get(), add, &meeting);
    std::vector<Pair> found;
    by_thread.append_to(found);
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
        throw Unavailable("Embree's error " + std::to_string(error));
    return found;
}

}  // namespace bvhbench
