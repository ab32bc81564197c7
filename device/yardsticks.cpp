// SPDX-License-Identifier: MIT
#include "device/yardsticks.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace bvhbench {
namespace {

constexpr const char* kernels = "device/limits.cl";

/// Steps of a head start of about four cycles each: 40 to 60 µs on a GPU of 1 to 2 GHz.
constexpr cl_uint busy_rounds = 20'000;

// With these sizes a calibration takes 100 to 200 µs on two cores and 30 µs on a large GPU, little beside the samples.
constexpr std::size_t cpu_vectors = 1u << 15;
constexpr std::size_t gpu_vectors = 1u << 22;
constexpr cl_uint calibration_rounds = 8;
constexpr std::size_t calibration_launches = 3;

template <class T>
T median(std::vector<T> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::size_t compute_units(const Device& device)
{
    return device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
}

/// Returns the number of vectors that fill `times` the device's reported cache size, but at least 64 MiB, since some devices
/// report too little and most last-level caches are smaller, and at most `most` bytes.
std::size_t vectors_past_caches(const Device& device, std::size_t times, std::size_t most)
{
    const std::size_t cache = device.cl.getInfo<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>();
    return std::min(std::max(times * cache, std::size_t{64} << 20), most) / sizeof(cl_uint4);
}

Arena scratch_of(const Device& device, std::size_t bytes)
{
    return Arena::reserved(device, {.tree_bytes = 0, .scratch_bytes = bytes});
}

/// Copies one buffer to another by a kernel.
class Copy {
public:
    /// Writes the source, since memory never written may not be backed by pages yet.
    Copy(Programs& programs, Queue& queue, std::size_t count)
        : global_(count)
        , local_(256)
        , arena_(scratch_of(programs.device(), 2 * count * sizeof(cl_uint4)))
        , from_(arena_.take<cl_uint4>(count, Use::scratch))
        , to_(arena_.take<cl_uint4>(count, Use::scratch))
    {
        const bool is_cpu = programs.device().is_cpu();
        if (is_cpu) {
            global_ = 4 * compute_units(programs.device());
            local_ = 1;
        }
        kernel_ = programs.kernel(kernels, is_cpu ? "copy_runs" : "copy_strided");
        set_arguments(kernel_, from_, to_, static_cast<cl_uint>(count));
        queue.begin("clear");
        queue.clear(from_.cl(), from_.bytes());
    }

    void launch(Queue& queue) const
    {
        queue.launch(kernel_, global_, local_, static_cast<std::int64_t>(2 * bytes()));
    }

    std::size_t bytes() const { return from_.bytes(); }

private:
    std::size_t global_, local_;
    Arena arena_;
    Buffer<cl_uint4> from_, to_;
    cl::Kernel kernel_;
};

}  // namespace

CopyRate measure_copy_rate(Programs& programs, Queue& queue, std::size_t most_bytes)
{
    const Device& device = programs.device();
    constexpr std::size_t most_samples = 9, fewest_samples = 3;
    constexpr std::int64_t enough_ns = 100'000'000;
    // 1 GiB on a GPU. On a CPU as large as the cache, so that both buffers are twice as large, and at most 512 MiB, since even a
    // run of one small build waits for this measurement.
    const std::size_t enough = device.is_cpu()
                                   ? vectors_past_caches(device, 1, std::size_t{512} << 20)
                                   : (std::size_t{1} << 30) / sizeof(cl_uint4);
    const Copy copy(programs, queue, std::min(enough, most_bytes / sizeof(cl_uint4)));
    const auto copied_ns = [&] {
        queue.begin("copy");
        copy.launch(queue);
        return queue.finish().back().busy_ns;
    };
    copied_ns();  // a warm-up, and the first to touch `to`
    std::vector<std::int64_t> times;
    for (std::int64_t all = 0;
         times.size() < fewest_samples || (times.size() < most_samples && all < enough_ns);)
        all += times.emplace_back(copied_ns());
    const auto ns = static_cast<double>(median(times));
    return {ns > 0 ? static_cast<double>(2 * copy.bytes()) / (ns * 1e-9) : 0, copy.bytes(),
            static_cast<int>(times.size())};
}

void check_clocks(Programs& programs, Queue& queue)
{
    constexpr std::int64_t longest_ns = 1'000'000'000;  // enough beside what a busy host adds
    constexpr std::int64_t least_share = 4;
    const Copy copy(programs, queue, cpu_vectors);
    constexpr int most_late = 5;  // a busy host may stop this process for a second now and then
    for (int launches = 1, late = 0;;) {
        queue.begin("copy");
        for (int k = 0; k < launches; ++k)
            copy.launch(queue);
        const std::int64_t device_ns = queue.finish().back().span_ns;
        queue.check_times();
        if (least_share * device_ns >= queue.wall_ns())
            return;
        if (queue.wall_ns() < longest_ns)
            launches *= 2;
        else if (++late == most_late)
            throw BadClock(true, "on the device's clock copies took " + std::to_string(device_ns) +
                                     " ns, and " + std::to_string(queue.wall_ns()) +
                                     " ns on the host's");
    }
}

LaunchCost measure_launch_cost(Programs& programs, Queue& queue)
{
    const Device& device = programs.device();
    constexpr int samples = 31;
    constexpr int launches = 16;  // about as many as a whole build has
    const std::size_t local = device.is_cpu() ? 1 : 64;

    Arena arena = scratch_of(device, sizeof(cl_uint));
    const Buffer<cl_uint> word = arena.take<cl_uint>(1, Use::scratch);
    cl::Kernel empty = programs.kernel(kernels, "launch_empty");
    set_arguments(empty, word);

    HeadStart head_start(programs, queue);
    std::vector<double> costs;
    queue.begin("clear");
    queue.clear(word.cl(), word.bytes());
    for (int i = 0; i <= samples; ++i) {
        head_start.give(queue);
        queue.begin("launch");
        for (int k = 0; k < launches; ++k)
            queue.launch(empty, compute_units(device) * local, local, 0);
        const StageTime time = queue.finish().back();
        if (i > 0)  // the first is a warm-up
            costs.push_back(static_cast<double>(time.span_ns) / launches);
    }
    return {median(costs), launches, samples};
}

HeadStart::HeadStart(Programs& programs, const Queue& queue)
{
    if (programs.device().is_cpu())
        return;
    Arena arena = scratch_of(programs.device(), sizeof(cl_uint));
    word_ = arena.take<cl_uint>(1, Use::scratch);
    word_.upload(queue.cl(), std::array<cl_uint, 1>{0});
    busy_ = programs.kernel(kernels, "keep_busy");
    set_arguments(busy_, word_, busy_rounds);
}

void HeadStart::give(const Queue& queue)
{
    if (busy_() != nullptr)
        queue.cl().enqueueNDRangeKernel(busy_, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
}

FillingKernel::FillingKernel(Programs& programs, const Queue& queue, const char* name,
                             std::size_t count)
    : kernel(programs.kernel(kernels, name))
    , arena(scratch_of(programs.device(), count * sizeof(cl_uint4)))
    , memory(arena.take<cl_uint4>(count, Use::scratch))
    , work_items(4 * compute_units(programs.device()))
    , group(1)
{
    if (!programs.device().is_cpu()) {
        group = 256;
        work_items = 8 * group * compute_units(programs.device());
    }
    queue.cl().enqueueFillBuffer(memory.cl(), cl_uint{0}, 0, memory.bytes());
}

CacheFlush::CacheFlush(Programs& programs, const Queue& queue)
    : walk_(programs, queue, "walk",
            vectors_past_caches(programs.device(), 2,
                                std::min(std::size_t{1} << 30, programs.device().most_at_once())))
{
    set_arguments(walk_.kernel, walk_.memory, static_cast<cl_uint>(walk_.memory.size()));
    flush(queue);
}

void CacheFlush::flush(const Queue& queue)
{
    queue.cl().enqueueNDRangeKernel(walk_.kernel, cl::NullRange, cl::NDRange(walk_.work_items),
                                    cl::NDRange(walk_.group));
    queue.cl().finish();
}

Calibration::Calibration(Programs& programs, Queue& queue)
    : work_(programs, queue, "calibrate", programs.device().is_cpu() ? cpu_vectors : gpu_vectors)
{
    set_arguments(work_.kernel, work_.memory, static_cast<cl_uint>(work_.memory.size()),
                  calibration_rounds);
    take(queue);
}

std::int64_t Calibration::take(Queue& queue)
{
    for (std::size_t i = 0; i < calibration_launches; ++i) {
        queue.begin("calibration");
        queue.launch(work_.kernel, work_.work_items, work_.group, 0);
    }
    std::vector<std::int64_t> times;
    for (const StageTime& stage : queue.finish())
        times.push_back(stage.busy_ns);
    return median(times);
}

}  // namespace bvhbench
