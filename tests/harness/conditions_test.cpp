// SPDX-License-Identifier: MIT
#include "harness/record/conditions.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace bvhbench {
namespace {

/// A folder that looks like a host's root.
class FakeRoot {
public:
    FakeRoot() { std::filesystem::create_directories(path()); }
    ~FakeRoot() { std::filesystem::remove_all(path()); }
    FakeRoot(const FakeRoot&) = delete;
    FakeRoot& operator=(const FakeRoot&) = delete;

    static std::filesystem::path path()
    {
        return std::filesystem::temp_directory_path() / ("conditions-" + std::to_string(getpid()));
    }
    void put(const std::string& file, const std::string& text) const
    {
        std::filesystem::create_directories((path() / file).parent_path());
        std::ofstream(path() / file) << text << '\n';
    }
    std::vector<std::string> warnings(int threads = 4, const std::string& build = "Release") const
    {
        return host_conditions(threads, build, path()).warnings;
    }
};

const std::string cpus = "sys/devices/system/cpu/";
const std::string supplies = "sys/class/power_supply/";

TEST(Conditions, AreUnknownWhereTheHostTellsNothing)
{
    const FakeRoot root;
    EXPECT_EQ(host_conditions(4, "Release", FakeRoot::path()), HostConditions());
}

TEST(Conditions, AreNothingToWarnOfOnAQuietServer)
{
    const FakeRoot root;
    root.put(cpus + "cpu0/cpufreq/scaling_governor", "performance");
    root.put(cpus + "intel_pstate/no_turbo", "1");
    root.put(supplies + "AC/type", "Mains");
    root.put("proc/loadavg", "0.90 0.10 0.10 1/99 1");
    EXPECT_TRUE(root.warnings().empty());
    const HostConditions found = host_conditions(4, "Release", FakeRoot::path());
    EXPECT_EQ(found.governor, "performance");
    EXPECT_EQ(found.turbo, false);
    EXPECT_FALSE(found.on_battery);
    EXPECT_EQ(found.load, 0.9);
}

TEST(Conditions, AreWarnedOfEachByItself)
{
    const FakeRoot root;
    root.put(cpus + "cpu0/cpufreq/scaling_governor", "performance");
    root.put(cpus + "cpu1/cpufreq/scaling_governor", "powersave");
    ASSERT_EQ(root.warnings().size(), 1u);
    EXPECT_NE(root.warnings()[0].find("powersave"), std::string::npos);
    root.put(cpus + "cpufreq/boost", "1");
    EXPECT_EQ(root.warnings().size(), 2u);
    root.put(supplies + "BAT0/type", "Battery");
    root.put(supplies + "BAT0/status", "Charging");
    EXPECT_EQ(root.warnings().size(), 2u);
    root.put(supplies + "BAT0/status", "Discharging");
    EXPECT_EQ(root.warnings().size(), 3u);
    root.put("proc/loadavg", "1.10 0.10 0.10 1/99 1");
    EXPECT_EQ(root.warnings(4).size(), 4u);
    EXPECT_EQ(root.warnings(8).size(), 3u);
    EXPECT_EQ(root.warnings(8, "Debug").size(), 4u);
}

TEST(Conditions, DoNotTakeAMousesBatteryForTheHosts)
{
    const FakeRoot root;
    root.put(supplies + "hid/type", "Battery");
    root.put(supplies + "hid/scope", "Device");
    root.put(supplies + "hid/status", "Discharging");
    EXPECT_TRUE(root.warnings().empty());
}

}  // namespace
}  // namespace bvhbench
