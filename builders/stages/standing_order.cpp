// SPDX-License-Identifier: MIT
#include "builders/stages/standing_order.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto path = "builders/stages/standing_order.cl";
constexpr uint group_size = 256;

std::int64_t bytes(std::size_t words) { return static_cast<std::int64_t>(words * sizeof(uint)); }

}  // namespace

StandingOrder::StandingOrder(Programs& programs, unsigned code_bits, KernelForm form)
    : form_(chosen_form(programs.device(), form))
    , words_(code_words(code_bits))
    , chunks_(chunk_count(programs.device()))
{
    const auto kernel = [&](const char* name) {
        return programs.kernel(path, name, {{"CODE_WORDS", words_}});
    };
    take_ = kernel("take_order");
    put_ = kernel("put_order");
    try_ = kernel(form_ == KernelForm::groups ? "try_order_groups" : "try_order_chunks");
    order_ = kernel("order_codes");
    copy_ = kernel("copy_codes");
}

void StandingOrder::plan(Arena& arena, std::size_t size)
{
    standing_ = arena.take<uint>(size, Use::scratch);
    unsorted_ = arena.take<uint>(1, Use::scratch);
}

void StandingOrder::prepare(const cl::CommandQueue& queue)
{
    build_ = 0;
    unsorted_.upload(queue, std::vector<uint>{0});
}

void StandingOrder::take(const cl::CommandQueue& queue, const Buffer<uint>& ids, uint count)
{
    count_ = count;
    queue.enqueueCopyBuffer(ids.cl(), standing_.cl(), 0, 0, count * sizeof(uint));
    queue.finish();
}

void StandingOrder::take(const cl::CommandQueue& queue, const Buffer<uint>& ids,
                         const ObjectRuns& runs)
{
    count_ = runs.lined_up_triangles();
    queue.enqueueNDRangeKernel(set_arguments(take_, ids, runs.runs(), standing_), cl::NullRange,
                               cl::NDRange(runs.lined_up_count() * runs.group()),
                               cl::NDRange(runs.group()));
    queue.finish();
}

SortUnlessIdle StandingOrder::enqueue_try(const Buffer<uint>& codes, Queue& queue)
{
    assert(count_ > 0);
    queue.begin("sort");
    ++build_;
    set_arguments(try_, codes, standing_, unsorted_, count_, build_);
    const std::int64_t moved = bytes((1 + words_) * std::size_t{count_});
    if (form_ == KernelForm::groups)
        launch(try_, moved, queue);
    else
        queue.launch(try_, std::min<std::size_t>(count_, chunks_), 1, moved);
    return {unsorted_, build_};
}

void StandingOrder::enqueue_codes(const Buffer<uint>& codes, const Buffer<uint>& ordered,
                                  const Buffer<uint>& between, Queue& queue)
{
    const bool in_place = codes.cl()() == ordered.cl()();
    const std::size_t words = words_ * std::size_t{count_};
    set_arguments(order_, codes, standing_, in_place ? between : ordered, unsorted_, count_,
                  build_);
    launch(order_, bytes(2 * words + count_), queue);
    if (!in_place)
        return;
    set_arguments(copy_, between, ordered, unsorted_, count_, build_);
    launch(copy_, bytes(2 * words), queue);
}

void StandingOrder::enqueue_put(const Buffer<uint>& sorted, const Buffer<uint>& ids,
                                const ObjectRuns& runs, const SortUnlessIdle& unless, Queue& queue)
{
    set_arguments(put_, sorted, runs.runs(), ids, unless.unsorted, unless.build);
    queue.launch(put_, runs.lined_up_count() * runs.group(), runs.group(),
                 bytes(2 * std::size_t{runs.lined_up_triangles()}));
}

bool StandingOrder::held(const cl::CommandQueue& queue) const
{
    return unsorted_.download(queue).at(0) != build_;
}

void StandingOrder::launch(cl::Kernel& kernel, std::int64_t moved_bytes, Queue& queue) const
{
    queue.launch(kernel, std::size_t{divided_up(count_, group_size)} * group_size, group_size,
                 moved_bytes);
}

}  // namespace bvhbench
