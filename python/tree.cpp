// SPDX-License-Identifier: MIT
#include "python/tree.h"

#include "library/device.h"

namespace bvhbench::python {
namespace {

template <class T>
cl::Buffer over(const OpenDevice& on, std::span<const T> values)
{
    try {
        return {on.queue.getInfo<CL_QUEUE_CONTEXT>(), CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR,
                values.size_bytes(), const_cast<T*>(values.data())};
    } catch (...) {
        oibvh::rethrow_as_error();
    }
}

/// Waits at its end for the kernels, if they read arrays.
struct Finishing {
    const OpenDevice& on;
    ~Finishing()
    {
        if (on.shares_host_memory)
            clFinish(on.queue());
    }
};

}  // namespace

BoundTree::BoundTree(std::shared_ptr<OpenDevice> on, oibvh::Options options)
    : on_(std::move(on))
    , tree_(without_gil([&] { return oibvh::Tree(on_->device, std::move(options)); }))
{}

oibvh::Input BoundTree::input(const Floats& points, const Numbers& faces)
{
    const auto corners = values_of<oibvh::Point>(points);
    const auto triangles = values_of<oibvh::Face>(faces);
    if (!on_->shares_host_memory || corners.empty() || triangles.empty())
        return oibvh::HostTriangles{corners, triangles};
    points_buffer_ = over(*on_, corners);
    faces_buffer_ = over(*on_, triangles);
    return oibvh::DeviceTriangles{points_buffer_(), corners.size(), faces_buffer_(),
                                  triangles.size()};
}

/// Runs `work` on the arrays, and holds these from then on; without `faces`, the faces that it holds. Arrays that were held before leave
/// in the arguments, to be dropped with the GIL.
void BoundTree::take(Floats points, Numbers* faces,
                     const std::function<void(const oibvh::Input&)>& work)
{
    without_gil([&] {
        const std::scoped_lock lock(mutex_);
        const Finishing finishing{*on_};
        work(input(points, faces != nullptr ? *faces : faces_));
        std::swap(points_, points);
        if (faces != nullptr)
            std::swap(faces_, *faces);
    });
}

void BoundTree::build(Floats points, Numbers faces, const Numbers& sizes)
{
    const std::span<const std::uint32_t> given = values_of<std::uint32_t>(sizes);
    take(std::move(points), &faces, [&](const oibvh::Input& input) { tree_.build(input, given); });
}

void BoundTree::refit(Floats points)
{
    take(std::move(points), nullptr, [&](const oibvh::Input& input) { tree_.refit(input); });
}

void BoundTree::update(Floats points, const Numbers& moved)
{
    std::vector<oibvh::Update> updates;
    for (const std::uint32_t has_moved : values_of<std::uint32_t>(moved))
        updates.push_back(has_moved != 0 ? oibvh::Update::rebuild : oibvh::Update::keep);
    take(std::move(points), nullptr,
         [&](const oibvh::Input& input) { tree_.update(input, updates); });
}

Numbers BoundTree::ask(const Query& query)
{
    const py::gil_scoped_release
        released;  // before the lock, which another thread may hold and want the GIL
    const std::scoped_lock lock(mutex_);
    const py::gil_scoped_acquire acquired;
    return python::ask(*on_, tree_, query);
}

Numbers BoundTree::pairs_with(BoundTree& other)
{
    const py::gil_scoped_release released;
    std::unique_lock first(mutex_, std::defer_lock), second(other.mutex_, std::defer_lock);
    if (this == &other)
        first.lock();
    else
        std::lock(first, second);
    const oibvh::Pairs found = tree_.find_pairs(other.tree_);
    const py::gil_scoped_acquire acquired;
    return array_of(*on_, found);
}

}  // namespace bvhbench::python
