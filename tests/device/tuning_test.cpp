// SPDX-License-Identifier: MIT
#include "device/tuning.h"

#include "tests/device/testing.h"

namespace bvhbench {
namespace {

constexpr Parameter keys{.name = "part.keys",
                         .meaning = "keys",
                         .stage = "sort",
                         .on_cpu = 3,
                         .elsewhere = 5,
                         .least = 1,
                         .most = 15,
                         .candidates = {1, 3, 5}};
constexpr Parameter group{.name = "part.group",
                          .meaning = "work-items",
                          .stage = "sort",
                          .on_cpu = 0,
                          .elsewhere = 64,
                          .least = 0,
                          .most = 1024,
                          .is_group_size = true,
                          .candidates = {64, 128}};

TEST(Parameter, SaysWhyItCannotBeAValue)
{
    EXPECT_EQ(keys.refusal(15), "");
    EXPECT_EQ(keys.refusal(0), "must be from 1 to 15, not 0");
    EXPECT_EQ(keys.refusal(17), "must be from 1 to 15, not 17");
    EXPECT_EQ(group.refusal(96), "must be a power of two, not 96");
    EXPECT_EQ(group.refusal(0), "") << "0 leaves the choice to the part";
    EXPECT_EQ(group.refusal(1024), "");
}

TEST(Tuning, HasTheDefaultsOfTheKindOfDeviceUntilAValueIsSet)
{
    Tuning tuning("a file");
    EXPECT_EQ(tuning.value(keys, true), 3u);
    EXPECT_EQ(tuning.value(keys, false), 5u);
    tuning.set(keys, 9);
    EXPECT_EQ(tuning.value(keys, true), 9u);
    EXPECT_TRUE(tuning.has(keys));
    EXPECT_FALSE(tuning.has(group));
    tuning.unset(keys);
    EXPECT_EQ(tuning.value(keys, false), 5u);
    EXPECT_EQ(tuning.origin(), "a file");
    EXPECT_EQ(Tuning().origin(), "none");
}

TEST(Tuning, RemembersWhichParametersWereAskedFor)
{
    Tuning tuning;
    tuning.set(group, 64);
    EXPECT_TRUE(tuning.asked().empty()) << "to set a value is not to ask for it";
    tuning.value(keys, true);
    EXPECT_EQ(tuning.asked(), (std::set<const Parameter*>{&keys}));
}

TEST(Device, IsTunedByWhatItIsGiven)
{
    Device device = open_device("");
    EXPECT_EQ(device.tuned(keys), keys.usual(device.is_cpu()));
    device.tuning.set(keys, 7);
    EXPECT_EQ(device.tuned(keys), 7u);
}

TEST(Device, RefusesGroupsThatItDoesNotHaveInOneSentence)
{
    const Device device = open_device("");
    const std::size_t most = device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    const std::size_t local = device.cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    const auto refusal = [&](std::size_t group_size, std::size_t local_bytes) {
        return refusal_of([&] { device.require_group("a part", group_size, local_bytes); });
    };
    EXPECT_EQ(refusal(most, local), "");
    EXPECT_EQ(refusal(most + 1, 0), "a part needs groups of " + std::to_string(most + 1) +
                                        " work-items, and " + device.name() + " has them up to " +
                                        std::to_string(most));
    const std::size_t over = local + 9;  // some drivers report 8 bytes more than a kernel declares
    EXPECT_EQ(refusal(1, over), "a part needs " + std::to_string(over) +
                                    " bytes of local memory, and a group has " +
                                    std::to_string(local) + " on " + device.name());
}

}  // namespace
}  // namespace bvhbench
