// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "harness/record/provenance.h"
#include "harness/session/other_processes.h"
#include "tests/folder.h"

namespace bvhbench {
namespace {

/// Provides a folder that looks like a host's root.
class Conditions : public testing::Test {
protected:
    void put(const std::string& file, const std::string& text) const
    {
        root_.file(file, text + '\n');
    }
    Json found(const std::string& build = "Release") const
    {
        return host_conditions(build, root_.path());
    }
    std::size_t warnings(const std::string& build = "Release") const
    {
        return found(build)["warnings"].size();
    }

    const Folder root_;
};

const std::string cpus = "sys/devices/system/cpu/";
const std::string supplies = "sys/class/power_supply/";

TEST_F(Conditions, AreUnknownWhereTheHostTellsNothing)
{
    EXPECT_EQ(found(), Json({{"warnings", Json::array()}}));
}

TEST_F(Conditions, AreNothingToWarnOfOnAQuietServer)
{
    put(cpus + "cpu0/cpufreq/scaling_governor", "performance");
    put(cpus + "intel_pstate/no_turbo", "1");
    put(supplies + "AC/type", "Mains");
    put("proc/loadavg", "0.90 0.10 0.10 1/99 1");
    EXPECT_EQ(found(), Json({{"governor", "performance"},
                             {"turbo", false},
                             {"load", 0.9},
                             {"warnings", Json::array()}}));
}

TEST_F(Conditions, AreWarnedOfEachByItself)
{
    put(cpus + "cpu0/cpufreq/scaling_governor", "performance");
    put(cpus + "cpu1/cpufreq/scaling_governor", "powersave");
    ASSERT_EQ(warnings(), 1u);
    EXPECT_NE(found()["warnings"][0].get<std::string>().find("powersave"), std::string::npos);
    put(cpus + "cpufreq/boost", "1");
    EXPECT_EQ(warnings(), 2u);
    put(supplies + "BAT0/type", "Battery");
    put(supplies + "BAT0/status", "Charging");
    EXPECT_EQ(warnings(), 2u);
    put(supplies + "BAT0/status", "Discharging");
    EXPECT_EQ(warnings(), 3u);
    EXPECT_EQ(warnings("Debug"), 4u);
}

TEST_F(Conditions, CountWhoElseWantsToRunBetweenSamples)
{
    OtherProcesses others(root_.path());
    others.look();
    EXPECT_FALSE(others.mean());
    for (const char* running : {"1", "3", "5"}) {  // the one that looks is one of them
        put("proc/loadavg", "1.10 0.10 0.10 " + std::string(running) + "/99 1");
        others.look();
    }
    ASSERT_EQ(others.mean(), 2.0);
    for (const auto& [threads, expected] : {std::pair(8u, 0u), std::pair(7u, 1u)}) {
        Json conditions = found();
        put_other_processes(conditions, *others.mean(), threads);
        EXPECT_EQ(conditions["other_processes"], 2.0);
        EXPECT_EQ(conditions["warnings"].size(), expected);
    }
}

TEST_F(Conditions, DoNotTakeAMousesBatteryForTheHosts)
{
    put(supplies + "hid/type", "Battery");
    put(supplies + "hid/scope", "Device");
    put(supplies + "hid/status", "Discharging");
    EXPECT_EQ(warnings(), 0u);
}

}  // namespace
}  // namespace bvhbench
