// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "geometry/error.h"
#include "library/tree.h"

namespace bvhbench::oibvh {
namespace {

Options trusting(Options options)
{
    options.check_input = false;  // `add`, `place` and `move` check what they are given
    return options;
}

float largest(std::span<const Point> points)
{
    float most = 0;
    for (const Point at : points)
        most = std::max({most, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    return most;
}

void check_points(std::span<const Point> points)
{
    const auto bad = std::ranges::find_if(points, [](Point at) {
        return !is_finite({at.x, at.y, at.z});
    });
    if (bad != points.end())
        throw BadUsage("point " + std::to_string(bad - points.begin()) +
                       " is not finite: " + text_of({bad->x, bad->y, bad->z}));
}

void check_faces(std::span<const Face> faces, std::size_t points)
{
    for (std::size_t k = 0; k < faces.size(); ++k)
        for (const std::uint32_t index : {faces[k].a, faces[k].b, faces[k].c})
            if (index >= points)
                throw BadUsage("triangle " + std::to_string(k) + " names point " +
                               std::to_string(index) + ", and there are " + std::to_string(points));
}

/// Throws BadUsage unless the points, all within `most` of 0 on each axis, are finite in the pose.
void check_pose(const Pose& pose, float most)
{
    for (const float* const row : {pose.x, pose.y, pose.z}) {
        double reach = std::abs(double{row[3]});
        for (int k = 0; k < 3; ++k)
            reach += std::abs(double{row[k]}) * most;
        if (!(reach < std::numeric_limits<float>::max() / 2))  // far above what rounding adds
            throw BadUsage("a pose puts points where floats are not finite");
    }
}

cl_float4 row_of(const float (&row)[4]) { return {{row[0], row[1], row[2], row[3]}}; }

}  // namespace

struct Scene::Impl {
    Impl(const Device& on, Options options)
        : device(on.impl_), tree(on, trusting(std::move(options)))
    {}

    struct Object {
        std::uint32_t first_point, points, first_face, faces;
        float most;  ///< absolute value of a coordinate of the points that it was given
        Pose pose = {};
    };

    Object& object(std::uint32_t number)
    {
        if (number >= objects.size())
            throw BadUsage("there is no object " + std::to_string(number) + ", and there are " +
                           std::to_string(objects.size()));
        return objects[number];
    }

    /// Begins a call that enqueues, as Tree::Impl::begin.
    void begin()
    {
        device->queue.forget();
        device->queue.join();
    }

    /// Runs `change`, which changes an object on the device, if the scene is there. If it throws, the next `tree` copies all anew.
    template <class Change>
    void renew(std::uint32_t number, Update as, Change&& change)
    {
        if (updates.empty())
            return;
        std::vector<Update> since = std::exchange(updates, {});  // restored on success
        begin();
        change();
        if (since[number] != Update::rebuild)
            since[number] = as;
        updates = std::move(since);
    }

    void place(const Object& of);
    void upload();

    std::shared_ptr<Device::Impl> device;  ///< declared first, so that it is destroyed last
    std::vector<Object> objects;
    std::vector<Point> given;     ///< of all objects, as they were added or moved
    std::vector<Face> faces;      ///< of all objects, with the numbers of the points of all
    std::vector<Update> updates;  ///< since the last `tree`; empty before the first and after `add`
    std::optional<Arena> arena;
    Buffer<bvhbench::Point> device_given, device_points;
    Buffer<bvhbench::Face> device_faces;
    cl::Kernel place_kernel;
    Tree tree;
};

/// Enqueues the points of an object in its pose.
void Scene::Impl::place(const Object& of)
{
    if (place_kernel() == nullptr)
        place_kernel = device->programs.kernel("library/place.cl", "place_points");
    set_arguments(place_kernel, device_given, device_points, of.first_point, of.points,
                  row_of(of.pose.x), row_of(of.pose.y), row_of(of.pose.z));
    device->queue.begin("input");
    device->launch(place_kernel, of.points);
}

/// Copies all objects to the device.
void Scene::Impl::upload()
{
    static_assert(sizeof(Point) == sizeof(bvhbench::Point) &&
                  sizeof(Face) == sizeof(bvhbench::Face));
    require_count(faces.size(), "triangles");
    begin();
    const cl::CommandQueue& queue = device->queue.cl();
    arena.reset();  // freed before more is taken
    device_given = device_points = {};
    device_faces = {};
    const auto plan = [&](Arena& from) {
        device_given = from.take<bvhbench::Point>(given.size(), Use::scratch);
        device_points = from.take<bvhbench::Point>(given.size(), Use::scratch);
        device_faces = from.take<bvhbench::Face>(faces.size(), Use::scratch);
    };
    Arena measuring = Arena::measuring(device->device);
    plan(measuring);
    arena = Arena::reserved(device->device, measuring.used());
    plan(*arena);
    queue.enqueueWriteBuffer(device_given.cl(), CL_TRUE, 0, device_given.bytes(), given.data());
    queue.enqueueWriteBuffer(device_faces.cl(), CL_TRUE, 0, device_faces.bytes(), faces.data());
    for (const Object& object : objects)
        place(object);
}

Scene::Scene(Device device, Options options)
    : impl_(std::make_unique<Impl>(device, std::move(options)))
{}
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(Scene&& other) noexcept
{
    std::swap(impl_, other.impl_);
    return *this;
}
Scene::~Scene()
{
    if (impl_ == nullptr)
        return;
    const std::shared_ptr<Device::Impl> device = impl_->device;
    {
        const std::scoped_lock lock(device->mutex);
        impl_->arena.reset();
    }
    impl_.reset();
}

std::uint32_t Scene::add(const HostTriangles& object)
{
    return as_call(*impl_->device, [&, &own = *impl_] {
        require_count(object.faces.size(), "triangles");
        require_count(object.points.size(), "points");
        require_count(own.faces.size() + object.faces.size(), "triangles");
        require_count(own.given.size() + object.points.size(), "points");
        check_points(object.points);
        check_faces(object.faces, object.points.size());
        const auto shift = static_cast<std::uint32_t>(own.given.size());
        own.objects.push_back({shift, static_cast<std::uint32_t>(object.points.size()),
                               static_cast<std::uint32_t>(own.faces.size()),
                               static_cast<std::uint32_t>(object.faces.size()),
                               largest(object.points)});
        own.given.insert(own.given.end(), object.points.begin(), object.points.end());
        for (const Face face : object.faces)
            own.faces.push_back({face.a + shift, face.b + shift, face.c + shift});
        own.updates.clear();
        return static_cast<std::uint32_t>(own.objects.size() - 1);
    });
}

void Scene::place(std::uint32_t object, const Pose& pose)
{
    as_call(*impl_->device, [&, &own = *impl_] {
        Impl::Object& of = own.object(object);
        check_pose(pose, of.most);
        of.pose = pose;
        own.renew(object, Update::refit, [&] { own.place(of); });
    });
}

void Scene::move(std::uint32_t object, std::span<const Point> points)
{
    as_call(*impl_->device, [&, &own = *impl_] {
        Impl::Object& of = own.object(object);
        if (points.size() != of.points)
            throw BadUsage("object " + std::to_string(object) + " has " +
                           std::to_string(of.points) + " points, and " +
                           std::to_string(points.size()) + " are given");
        check_points(points);
        const float most = largest(points);
        check_pose(of.pose, most);
        of.most = most;
        std::ranges::copy(points, own.given.begin() + of.first_point);
        own.renew(object, Update::rebuild, [&] {
            own.device->queue.cl().enqueueWriteBuffer(own.device_given.cl(), CL_TRUE,
                                                      of.first_point * sizeof(Point),
                                                      points.size_bytes(), points.data());
            own.place(of);
        });
    });
}

Tree& Scene::tree()
{
    Impl& own = *impl_;
    const bool is_new = own.updates.empty();
    if (is_new)
        as_call(*own.device, [&] { own.upload(); });
    const DeviceTriangles triangles = {own.device_points.cl()(), own.given.size(),
                                       own.device_faces.cl()(), own.faces.size()};
    if (is_new || !own.tree.is_built()) {  // added to, or an update failed
        std::vector<std::uint32_t> sizes;
        for (const Impl::Object& object : own.objects)
            sizes.push_back(object.faces);
        own.tree.build(triangles, sizes);
    } else if (std::ranges::any_of(own.updates, [](Update one) { return one != Update::keep; })) {
        own.tree.update(triangles, own.updates);
    }
    own.updates.assign(own.objects.size(), Update::keep);
    return own.tree;
}

ObjectTriangle Scene::origin(std::uint32_t triangle) const
{
    return as_call(*impl_->device, [&, &own = *impl_]() -> ObjectTriangle {
        if (triangle >= own.faces.size())
            throw BadUsage("there is no triangle " + std::to_string(triangle) + ", and there are " +
                           std::to_string(own.faces.size()));
        const auto after =
            std::ranges::upper_bound(own.objects, triangle, {}, &Impl::Object::first_face);
        return {static_cast<std::uint32_t>(after - own.objects.begin() - 1),
                triangle - std::prev(after)->first_face};
    });
}

std::size_t Scene::memory() const
{
    const std::size_t of_tree = impl_->tree.memory();
    return as_call(*impl_->device, [&, &own = *impl_] {
        return of_tree + (own.arena ? own.arena->used().total() : 0);
    });
}

}  // namespace bvhbench::oibvh
