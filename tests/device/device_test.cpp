// SPDX-License-Identifier: MIT
#include "device/device.h"

#include "device/arena.h"
#include "device/device_choice.h"
#include "device/yardsticks.h"
#include "tests/device/testing.h"

namespace bvhbench {
namespace {

class QueueOf : public OnDevice {};
class Yardsticks : public OnDevice {};
class CacheFlushed : public OnDevice {};

TEST(OpenDevice, TakesAnIndexOrWordsInAnyCaseAndOrder)
{
    const std::vector<std::string> names = device_names();
    ASSERT_FALSE(names.empty());
    const Device first = open_device("0");
    EXPECT_EQ(first.platform() + '/' + first.name(), names[0]);

    std::string shouted = names[0];
    for (char& c : shouted)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(open_device(shouted).name(), first.name());
}

TEST(OpenDevice, SaysWhatWasAskedAndWhatThereIs)
{
    for (const std::string words : {"no such device", "77"}) {
        expect_sentence(refusal_of([&] { open_device(words); }),
                        {"'" + words + "'", device_names()[0]});
        setenv("BVHBENCH_DEVICE", words.c_str(), 1);
        expect_sentence(refusal_of([&] { open_device(""); }),
                        {"'" + words + "' of BVHBENCH_DEVICE", device_names()[0]});
        EXPECT_NO_THROW(open_device("0")) << "words come before the variable";
        unsetenv("BVHBENCH_DEVICE");
    }
}

TEST(OpenDevice, TakesTheFirstGpuUnlessAnotherIsNamed)
{
    const NamedDevice devices[] = {{"PoCL/Some CPU", CL_DEVICE_TYPE_CPU},
                                   {"Big/GPU of CPUs", CL_DEVICE_TYPE_GPU},
                                   {"Big/Second", CL_DEVICE_TYPE_GPU},
                                   {"Odd/Board", CL_DEVICE_TYPE_ACCELERATOR}};
    const auto chosen = [&](std::string_view words) { return chosen_device(devices, words); };
    EXPECT_EQ(chosen(""), 1u);
    EXPECT_EQ(chosen("GPU"), 1u);
    EXPECT_EQ(chosen("cpu"), 0u);
    EXPECT_EQ(chosen("second big"), 2u);
    EXPECT_EQ(chosen("3"), 3u);
    for (const char* none : {"4", "999", "third", "big board"})
        EXPECT_EQ(chosen(none), std::size(devices)) << none;
    EXPECT_EQ(chosen_device(std::span(devices).first(1), ""), 0u);
    EXPECT_EQ(chosen_device(std::span(devices).first(1), "gpu"), 1u);
    EXPECT_EQ(chosen_device(std::span(devices).last(1), ""), 0u);
    EXPECT_EQ(chosen_device({}, ""), 0u);

    const auto matching = [&](std::string_view words) { return matching_devices(devices, words); };
    using Indices = std::vector<std::size_t>;
    EXPECT_EQ(matching(""), (Indices{1, 2}));
    EXPECT_EQ(matching("gpu"), (Indices{1, 2}));
    EXPECT_EQ(matching("big"), (Indices{1, 2}));
    EXPECT_EQ(matching("cpu"), Indices{0});
    EXPECT_EQ(matching("4"), Indices{});
}

TEST(Device, CountsWhatIsTakenUntilItIsGivenBack)
{
    Device device = open_device("");
    EXPECT_NO_THROW(device.take_memory(1024));
    expect_sentence(refusal_of([&] { device.take_memory(std::size_t{1} << 60); }),
                    {"1152921504606846976 bytes"});
    device.memory_limit = 1000;
    MemoryShare most = device.take_memory(600);
    const MemoryShare rest = Device(device).take_memory(400);
    EXPECT_EQ(*device.taken, 1000u);
    expect_sentence(refusal_of([&] { device.take_memory(1); }),
                    {"out of device memory: 1 bytes", "beside 1000 taken", "gives 1000"});
    most.reset();
    EXPECT_EQ(*device.taken, 400u);
    EXPECT_EQ(*device.most_taken, 1024u) << "the first one, which was given back at once";
    *device.most_taken = 0;
    EXPECT_NO_THROW(device.take_memory(600));
    EXPECT_EQ(*device.most_taken, 1000u);
    EXPECT_EQ(*device.taken, 400u) << "nobody kept that";
}

TEST(Device, PredictsThatAnArenaWillNotFitBeforeItIsThere)
{
    Device device = open_device("");
    device.memory_limit = 1 << 20;
    const Arena held = Arena::reserved(device, {1 << 19, 0});
    EXPECT_THROW(Arena::reserved(device, {1 << 20, 0}), Unavailable);
    EXPECT_EQ(*device.taken, 1u << 19);
}

TEST_F(QueueOf, KeepsStagesApartAndCountsWhatTheyMove)
{
    const cl::Buffer memory(device.context, CL_MEM_READ_WRITE, 4096);
    queue.begin("one");
    queue.clear(memory, 4096);
    queue.clear(memory, 1024);
    queue.declare(1000);
    queue.on_host("two", [] {});
    const std::vector<StageTime> stages = queue.finish();
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_EQ(stages[0].stage, "one");
    EXPECT_EQ(stages[0].launches, 2);
    EXPECT_EQ(stages[0].moved_bytes, 6120);
    EXPECT_GE(stages[0].span_ns, stages[0].busy_ns) << "gaps between launches count";
    EXPECT_GT(stages[0].busy_ns, 0);
    EXPECT_EQ(stages[0].wall_ns, 0);
    EXPECT_EQ(stages[1].launches, 0);
    EXPECT_EQ(stages[1].moved_bytes, 0);
    EXPECT_GE(stages[1].wall_ns, 0);
    EXPECT_EQ(stages[1].elapsed_ns(), stages[1].wall_ns);
    EXPECT_TRUE(queue.finish().empty()) << "finish forgets";
}

TEST_F(QueueOf, TakesTheHostsClockIfTheDeviceSays)
{
    Device by_host = device;
    by_host.host_clock = true;
    Programs own(by_host);
    Queue own_queue(by_host);
    EXPECT_NO_THROW(check_clocks(own, own_queue));
    const cl::Buffer memory(device.context, CL_MEM_READ_WRITE, 4096);
    for (const char* stage : {"first", "second"}) {
        own_queue.begin(stage);
        own_queue.clear(memory, 4096);
    }
    const std::vector<StageTime> stages = own_queue.finish();
    EXPECT_NO_THROW(own_queue.check_times());
    ASSERT_EQ(stages.size(), 2u);
    for (const StageTime& stage : stages) {
        EXPECT_GT(stage.span_ns, 0);
        EXPECT_EQ(stage.busy_ns, stage.span_ns);
    }
    EXPECT_GE(stages[1].start_ns, stages[0].span_ns);
    EXPECT_LE(stages[1].start_ns + stages[1].span_ns, own_queue.wall_ns());
}

TEST_F(Yardsticks, CopyAtARateFromTheSamplesTheyName)
{
    const CopyRate rate = measure_copy_rate(programs, queue);
    EXPECT_GT(rate.bytes_per_s, 0);
    EXPECT_GE(rate.buffer_bytes, std::size_t{64} << 20);
    EXPECT_GE(rate.buffer_bytes, device.cl.getInfo<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>());
    EXPECT_GE(rate.samples, 3);
    EXPECT_LE(rate.samples, 9);
}

TEST_F(Yardsticks, LaunchForMoreThanNothing)
{
    const LaunchCost cost = measure_launch_cost(programs, queue);
    EXPECT_GT(cost.ns, 0);
    EXPECT_TRUE(queue.finish().empty());
}

TEST_F(CacheFlushed, CountsWhatItHoldsAndGivesItBack)
{
    {
        const CacheFlush flush(programs, queue);
        EXPECT_GE(*device.taken, std::size_t{64} << 20);
        const std::size_t flushing = *device.taken;
        Calibration calibration(programs, queue);
        EXPECT_GT(*device.taken, flushing);
        EXPECT_GT(calibration.take(queue), 0);
    }
    EXPECT_EQ(*device.taken, 0u);
}

TEST_F(CacheFlushed, TouchesEveryVector)
{
    constexpr std::size_t count = 1001;  // not a multiple of the number of work-items
    Arena arena = Arena::reserved(device, {count * sizeof(cl_uint4), 0});
    const Buffer<cl_uint4> memory = arena.take<cl_uint4>(count, Use::tree);
    queue.begin("walk");
    queue.clear(memory.cl(), memory.bytes());
    cl::Kernel walk = programs.kernel("device/limits.cl", "walk");
    set_arguments(walk, memory, static_cast<cl_uint>(count));
    queue.launch(walk, 8, 1, 0);
    queue.finish();
    for (const cl_uint4& vector : memory.download(queue.cl()))
        ASSERT_TRUE(vector.s[0] == 1 && vector.s[1] == 1 && vector.s[2] == 1 && vector.s[3] == 1);
}

}  // namespace
}  // namespace bvhbench
