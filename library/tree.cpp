// SPDX-License-Identifier: MIT
#include "library/tree.h"

#include <algorithm>

#include "collide/best_pipeline.h"
#include "geometry/error.h"
#include "oibvh/oibvh.h"

namespace bvhbench::oibvh {
namespace {

constexpr Named<MakeBuilder> builders[] = {{"oibvh-single", make_oibvh_single},
                                           {"oibvh-multi", make_oibvh_multi}};

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

std::unique_ptr<Builder> make_builder(Device::Impl& device, const Options& options)
{
    const std::string_view name =
        options.builder.empty() ? best_pipeline(device.device).builder : options.builder;
    return find_called(builders, name, "builder of the library")
        .make(device.programs, {.order = options.order, .sorted_leaves = options.sorted_leaves});
}

Tree::Impl::Impl(const std::shared_ptr<Device::Impl>& on, Options asked)
    : device(on)
    , options(std::move(asked))
    , taker(*device, options.check_input)
    , builder(make_builder(*device, options))
    , collider(collider_for(device->device, options.collider))
    , joined(*device, collider.make)
    , padded(*device, options)
{}

void Tree::Impl::begin()
{
    device->queue.forget();
    device->queue.join();
}

void Tree::Impl::renew(const Input& input, const std::function<void(const bvhbench::Input&)>& make)
{
    begin();
    const ImplicitTree* const standing = std::exchange(tree, nullptr);
    last_pairs.reset();
    const std::vector<uint> same = std::exchange(sizes, {});  // restored on success
    make(taker.take(input, same));
    sizes = same;
    tree = standing;
}

const ImplicitTree& Tree::Impl::standing(const char* what) const
{
    if (tree == nullptr)
        throw BadUsage(std::string(what) +
                       " needs a tree, and none was built, or its build failed");
    return *tree;
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

/// Holds the Device's mutex, because freeing memory changes the Device's memory account, which other trees share.
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
    as_call(*impl_->device, [&, &own = *impl_] {
        own.begin();
        own.tree = nullptr;
        own.last_pairs.reset();
        const bvhbench::Input& taken = own.taker.take(input, objects);
        const std::vector<uint> wanted = object_sizes(taken);
        if (std::exchange(own.sizes, {}) != wanted) {
            for (Impl::Query& query : own.queries)  // freed before more is allocated
                query = {};
            own.padded.free();
            own.narrow.reset();
            own.builder->reserve_objects(wanted);
        }
        own.tree = &dynamic_cast<const ImplicitTree&>(own.builder->build(taken, own.device->queue));
        own.sizes = wanted;
    });
}

void Tree::refit(const Input& input)
{
    as_call(*impl_->device, [&, &own = *impl_] {
        own.standing("a refit");
        own.renew(input, [&](const bvhbench::Input& taken) {
            own.builder->refit(taken, own.device->queue);
        });
    });
}

void Tree::update(const Input& input, std::span<const Update> updates)
{
    as_call(*impl_->device, [&, &own = *impl_] {
        const std::size_t objects = own.standing("an update").objects.size();
        if (updates.size() != objects)
            throw BadUsage("there are " + std::to_string(updates.size()) + " updates, and " +
                           std::to_string(objects) + " objects");
        std::vector<TreeUpdate> wanted(updates.size());
        std::transform(updates.begin(), updates.end(), wanted.begin(),
                       [](Update update) { return internal(update); });
        own.renew(input, [&](const bvhbench::Input& taken) {
            own.builder->plan_update(wanted, own.device->queue);
            own.builder->update(taken, own.device->queue);
        });
    });
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
    return as_call(*impl_->device, [&own = *impl_] {
        std::size_t bytes = own.builder->reserved().total() + own.taker.memory() +
                            own.joined.memory() + own.padded.memory() +
                            (own.narrow ? own.narrow->reserved().total() : 0);
        for (const Impl::Query& query : own.queries)
            if (query.collider)
                bytes += query.collider->reserved().total();
        return bytes;
    });
}

std::string Tree::kernel_text() const
{
    return as_call(*impl_->device, [&own = *impl_] {
        return std::string("#define SORTED_LEAVES ") + (own.options.sorted_leaves ? "1\n" : "0\n") +
               own.device->device.sources.flatten({"oibvh/access.clh"});
    });
}

std::string_view Tree::builder() const { return impl_->builder->card().name; }
std::string_view Tree::collider() const { return impl_->collider.name; }

}  // namespace bvhbench::oibvh
