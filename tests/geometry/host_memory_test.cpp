// SPDX-License-Identifier: MIT
#include "geometry/host_memory.h"

#include <cstdint>

#include "tests/folder.h"
#include "tests/refusal.h"

namespace bvhbench {
namespace {

/// A directory tree with files like those of /proc and /sys.
class CgroupMemory : public testing::Test {
protected:
    void file(const std::string& path, const std::string& text) const { root_.file(path, text); }

    /// Writes a v1 group: its limit, its usage, and how much of the usage is page cache.
    void v1(const std::string& group, const char* limit, const char* used, int files) const
    {
        const std::string at = "sys/fs/cgroup/memory" + group;
        file(at + "/memory.limit_in_bytes", limit);
        file(at + "/memory.usage_in_bytes", used);
        file(at + "/memory.stat", "cache 7\ninactive_file 5\ntotal_inactive_file " +
                                      std::to_string(files) + "\ntotal_active_file 1\n");
    }
    void v2(const std::string& group, const char* limit, const char* used, int files) const
    {
        const std::string at = "sys/fs/cgroup" + group;
        file(at + "/memory.max", limit);
        file(at + "/memory.current", used);
        file(at + "/memory.stat",
             "anon 9\nactive_file 1\ninactive_file " + std::to_string(files) + '\n');
    }

    std::optional<std::uint64_t> left() const { return cgroup_memory_left(root_.path()); }

    const Folder root_;
};

constexpr const char* mount_v1 =
    "25 22 0:21 / /sys/fs/cgroup/memory rw,relatime shared:7 - cgroup cgroup rw,memory\n"
    "26 22 0:22 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu\n";
constexpr const char* mount_v2 =
    "30 22 0:26 / /sys/fs/cgroup rw,nosuid - cgroup2 cgroup2 rw,nsdelegate\n";

TEST_F(CgroupMemory, IsTheLeastOfTheGroupAndThoseAroundItInV1)
{
    file("proc/self/cgroup", "4:memory:/a/b\n3:cpu:/c\n0::/\n");
    file("proc/self/mountinfo", mount_v1);
    v1("", "9223372036854771712", "900000", 0);
    v1("/a", "5000", "2000", 0);
    v1("/a/b", "9000", "4000", 0);
    EXPECT_EQ(left(), 3001u) << "of the group around it";
    v1("/a/b", "6000", "4000", 99);
    EXPECT_EQ(left(), 2100u) << "files count as free, of the group and those within it";
    v1("/a/b", "3000", "4000", 0);
    EXPECT_EQ(left(), 0u) << "a limit that was lowered";
}

TEST_F(CgroupMemory, IsThatOfV2)
{
    file("proc/self/cgroup", "0::/user.slice/run.scope\n");
    file("proc/self/mountinfo", mount_v2);
    v2("/user.slice", "max", "700", 0);
    v2("/user.slice/run.scope", "max", "500", 0);
    EXPECT_EQ(left(), std::nullopt) << "no limit anywhere; the topmost group has no such file";
    v2("/user.slice", "1000", "700", 49);
    EXPECT_EQ(left(), 350u);
}

TEST_F(CgroupMemory, IsFoundWhereAContainerMountsItsOwnGroup)
{
    file("proc/self/cgroup", "4:memory:/docker/1f\n");
    file("proc/self/mountinfo",
         "25 22 0:21 /docker/1f /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n");
    v1("", "8000", "1000", 0);
    EXPECT_EQ(left(), 7001u) << "the group is the topmost that is mounted";
    file("proc/self/cgroup", "4:memory:/elsewhere\n");
    EXPECT_EQ(left(), 7001u) << "and it is what there is where the path is another view's";
}

TEST_F(CgroupMemory, IsUnknownWithoutGroups)
{
    EXPECT_EQ(left(), std::nullopt);
    file("proc/self/cgroup", "nonsense\n4:memory\n");
    file("proc/self/mountinfo", std::string(mount_v1) + "nonsense\n");
    EXPECT_EQ(left(), std::nullopt);
}

TEST(HostMemory, IsRefusedWithWhatIsNeededAndGiven)
{
    EXPECT_NO_THROW(require_host_memory("a little", 1000));
    EXPECT_GE(host_memory_facts().predicted, 1000u);
    const std::string message =
        refusal_of([] { require_host_memory("too much", std::uint64_t{1} << 60); });
    EXPECT_TRUE(message.starts_with(
        "out of host memory: too much takes about 1152921504606846976 bytes, and the host gives "))
        << message;
}

TEST(HostMemory, IsLimitedWithWhatTheProcessHas)
{
    constexpr std::uint64_t more = 64 << 20;
    limit_host_memory(0);
    const std::uint64_t free = host_memory_left();
    EXPECT_THROW(limit_host_memory(1000), Unavailable) << "it has more already";
    limit_host_memory(host_memory_facts().peak + more);
    EXPECT_GE(host_memory_left(), more / 2);
    EXPECT_LE(host_memory_left(), more + (host_memory_facts().peak >> 1));
    EXPECT_THROW(require_host_memory("more", 2 * more + host_memory_facts().peak), Unavailable);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    const auto take = [] { return std::string(std::size_t{2} << 30, 'x'); };
    EXPECT_THROW(take(), std::bad_alloc) << "what nobody asked for";
#endif
    limit_host_memory(0);
    EXPECT_GT(host_memory_left(), free / 2);
}

}  // namespace
}  // namespace bvhbench
