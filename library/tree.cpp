// SPDX-License-Identifier: MIT
#include "library/tree.h"

#include <algorithm>

#include "geometry/error.h"
#include "oibvh/oibvh.h"

namespace bvhbench::oibvh {
namespace {

constexpr std::pair<std::string_view, MakeBuilder> builder_names[] = {
    {"oibvh-single", make_oibvh_single}, {"oibvh-multi", make_oibvh_multi}};

/// Single where groups meet inside a launch and there are many of them: an H200 takes 0.8 of the time then.
std::string_view builder_for(const bvhbench::Device& device)
{
    return device.lets_groups_meet() && !device.is_cpu() ? "oibvh-single" : "oibvh-multi";
}

std::unique_ptr<Builder> make_builder(Device::Impl& device, const Options& options)
{
    const std::string_view name =
        options.builder.empty() ? builder_for(device.device) : options.builder;
    for (const auto& [known, make] : builder_names)
        if (known == name)
            return make(device.programs,
                        {.order = options.order, .sorted_leaves = options.sorted_leaves});
    throw BadUsage("no builder of the library is called '" + std::string(name) +
                   "'; there are: oibvh-single, oibvh-multi");
}

TreeUpdate internal(Update update)
{
    switch (update) {
        case Update::rebuild:
            return TreeUpdate::rebuild;
        case Update::refit:
            return TreeUpdate::refit;
        case Update::keep:
            return TreeUpdate::keep;
    }
    throw BadUsage("an update is rebuild, refit or keep, not " +
                   std::to_string(static_cast<int>(update)));
}

template <class T, class U>
std::vector<T> downloaded(const cl::CommandQueue& queue, const Buffer<U>& buffer)
{
    std::vector<T> values(buffer.bytes() / sizeof(T));
    if (!values.empty())
        queue.enqueueReadBuffer(buffer.cl(), CL_TRUE, 0, buffer.bytes(), values.data());
    return values;
}

}  // namespace

Tree::Impl::Impl(const std::shared_ptr<Device::Impl>& on, Options asked)
    : device(on)
    , options(std::move(asked))
    , taker(*device, options.check_input)
    , builder(make_builder(*device, options))
    , collider_name(collider_for(device->device, options.collider))
    , joined(*device)
{}

void Tree::Impl::begin()
{
    device->queue.forget();
    device->queue.join();
}

void Tree::Impl::build(const Input& input, std::span<const std::uint32_t> objects)
{
    begin();
    tree = nullptr;
    last_query = nullptr;
    const bvhbench::Input& taken = taker.take(input, objects);
    const std::vector<uint> wanted = object_sizes(taken);
    if (std::exchange(sizes, {}) != wanted) {
        for (Query& query : queries)  // their memory goes before more comes
            query = {};
        builder->reserve_objects(wanted);
    }
    tree = &dynamic_cast<const ImplicitTree&>(builder->build(taken, device->queue));
    sizes = wanted;
}

void Tree::Impl::renew(const Input& input, const std::function<void(const bvhbench::Input&)>& make)
{
    begin();
    const ImplicitTree* const standing = std::exchange(tree, nullptr);
    last_query = nullptr;
    const std::vector<uint> same = std::exchange(sizes, {});  // until all has gone well
    make(taker.take(input, same));
    sizes = same;
    tree = standing;
}

void Tree::Impl::refit(const Input& input)
{
    standing("a refit");
    renew(input, [&](const bvhbench::Input& taken) { builder->refit(taken, device->queue); });
}

void Tree::Impl::update(const Input& input, std::span<const Update> updates)
{
    if (const std::size_t objects = standing("an update").objects.size(); updates.size() != objects)
        throw BadUsage("there are " + std::to_string(updates.size()) + " updates, and " +
                       std::to_string(objects) + " objects");
    std::vector<TreeUpdate> wanted(updates.size());
    std::transform(updates.begin(), updates.end(), wanted.begin(), internal);
    renew(input, [&](const bvhbench::Input& taken) {
        builder->plan_update(wanted, device->queue);
        builder->update(taken, device->queue);
    });
}

const ImplicitTree& Tree::Impl::standing(const char* what) const
{
    if (tree == nullptr)
        throw BadUsage(std::string(what) +
                       " needs a tree, and none was built, or its build failed");
    return *tree;
}

std::size_t Tree::Impl::memory() const
{
    std::size_t bytes = builder->reserved().total() + taker.memory() + joined.memory();
    for (const Query& query : queries)
        if (query.collider)
            bytes += query.collider->reserved().total();
    return bytes;
}

Tree::Tree(Device device, Options options)
    : impl_(as_call(*device.impl_,
                    [&] { return std::make_unique<Impl>(device.impl_, std::move(options)); }))
{}
Tree::Tree(cl_command_queue queue, Options options) : Tree(Device(queue), std::move(options)) {}
Tree::Tree(Tree&& other) noexcept = default;
Tree& Tree::operator=(Tree&& other) noexcept
{
    std::swap(impl_, other.impl_);
    return *this;
}

/// The account of memory is the Device's, so that trees of other threads wait.
Tree::~Tree()
{
    if (impl_ == nullptr)
        return;
    const std::shared_ptr<Device::Impl> device = impl_->device;
    const std::scoped_lock lock(device->mutex);
    impl_.reset();
}

void Tree::build(const Input& input, std::span<const std::uint32_t> objects)
{
    as_call(*impl_->device, [&] { impl_->build(input, objects); });
}

void Tree::refit(const Input& input)
{
    as_call(*impl_->device, [&] { impl_->refit(input); });
}

void Tree::update(const Input& input, std::span<const Update> updates)
{
    as_call(*impl_->device, [&] { impl_->update(input, updates); });
}

bool Tree::is_built() const { return impl_->tree != nullptr; }

Buffers Tree::buffers() const
{
    return as_call(*impl_->device, [&]() -> Buffers {
        const ImplicitTree& tree = impl_->standing("buffers");
        return {.nodes = tree.nodes.cl()(),
                .node_count = tree.slot_count,
                .leaf_boxes = tree.leaf_boxes.cl()(),
                .ids = tree.ids.cl()(),
                .leaf_count = tree.leaves,
                .objects = tree.device_objects.cl()(),
                .object_count = static_cast<std::uint32_t>(tree.objects.size())};
    });
}

std::vector<Level> Tree::levels(std::uint32_t object) const
{
    return as_call(*impl_->device, [&] {
        const ImplicitTree& tree = impl_->standing("levels");
        if (object >= tree.objects.size())
            throw BadUsage("there is no object " + std::to_string(object) + ", and there are " +
                           std::to_string(tree.objects.size()));
        const uint leaves = tree.objects[object].leaves;
        std::vector<Level> levels;
        for (uint level = 0; level <= implicit_leaf_level(leaves); ++level)
            levels.push_back(
                {tree.layout.first_slot(leaves, level), tree.layout.stored_on(leaves, level)});
        return levels;
    });
}

HostTree Tree::read() const
{
    static_assert(sizeof(Object) == sizeof(ForestObject));
    return as_call(*impl_->device, [&]() -> HostTree {
        const ImplicitTree& tree = impl_->standing("reading");
        const cl::CommandQueue& queue = impl_->device->queue.cl();
        impl_->device->queue.join();
        return {downloaded<Box>(queue, tree.nodes), downloaded<Box>(queue, tree.leaf_boxes),
                downloaded<std::uint32_t>(queue, tree.ids),
                downloaded<Object>(queue, tree.device_objects)};
    });
}

std::size_t Tree::memory() const
{
    return as_call(*impl_->device, [&] { return impl_->memory(); });
}

std::string_view Tree::builder() const { return impl_->builder->card().name; }
std::string_view Tree::collider() const { return impl_->collider_name; }

}  // namespace bvhbench::oibvh
