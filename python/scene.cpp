// SPDX-License-Identifier: MIT
#include "python/scene.h"

#include <algorithm>

namespace bvhbench::python {

BoundScene::BoundScene(std::shared_ptr<OpenDevice> on, oibvh::Options options)
    : on_(std::move(on))
    , scene_(without_gil([&] { return oibvh::Scene(on_->device, std::move(options)); }))
{}

template <class Work>
auto BoundScene::in_turn(Work&& work)
{
    return without_gil([&] {
        const std::scoped_lock lock(mutex_);
        return work();
    });
}

std::uint32_t BoundScene::add(const Floats& points, const Numbers& faces)
{
    const oibvh::HostTriangles object = {values_of<oibvh::Point>(points),
                                         values_of<oibvh::Face>(faces)};
    return in_turn([&] { return scene_.add(object); });
}

void BoundScene::place(std::uint32_t object, const Floats& pose)
{
    oibvh::Pose rows;
    std::copy_n(pose.data(), 4, rows.x);
    std::copy_n(pose.data() + 4, 4, rows.y);
    std::copy_n(pose.data() + 8, 4, rows.z);
    in_turn([&] { scene_.place(object, rows); });
}

void BoundScene::move(std::uint32_t object, const Floats& points)
{
    const auto corners = values_of<oibvh::Point>(points);
    in_turn([&] { scene_.move(object, corners); });
}

Numbers BoundScene::ask(const Query& query)
{
    return in_turn([&] {
        oibvh::Tree& tree = scene_.tree();
        const py::gil_scoped_acquire acquired;
        return python::ask(*on_, tree, query);
    });
}

std::size_t BoundScene::memory()
{
    return in_turn([&] { return scene_.memory(); });
}

}  // namespace bvhbench::python
