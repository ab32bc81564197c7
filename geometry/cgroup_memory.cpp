// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

/// File names and memory.stat keys of one cgroup version. In v1, keys of sums over a group and its subgroups have a prefix.
struct Version {
    const char* limit;
    const char* usage;
    const char* inactive_files;
    const char* active_files;
};
constexpr Version v1 = {"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file",
                        "total_active_file"};
constexpr Version v2 = {"memory.max", "memory.current", "inactive_file", "active_file"};

/// Mount point of a hierarchy of groups that can limit memory, and the group that appears there as the topmost.
struct Mount {
    const Version* version;
    fs::path point;
    fs::path topmost;
};

/// Returns the mounts of groups that can limit memory. A line of mountinfo:
/// id, parent, device, root, mount point, options, " - ", type, source, options of the type.
std::vector<Mount> mounts(const fs::path& root)
{
    std::vector<Mount> found;
    std::ifstream file(root / "proc/self/mountinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t dash = line.find(" - ");
        if (dash == line.npos)
            continue;
        std::istringstream before(line), behind(line.substr(dash + 3));
        std::string skipped, topmost, point, type, options;
        before >> skipped >> skipped >> skipped >> topmost >> point;
        behind >> type >> skipped >> options;
        const bool has_memory = (',' + options + ',').find(",memory,") != std::string::npos;
        if (type == "cgroup2" || (type == "cgroup" && has_memory))
            found.push_back(
                {type == "cgroup2" ? &v2 : &v1, root / fs::path(point).relative_path(), topmost});
    }
    return found;
}

/// Returns the path of this process's group, from a line "4:memory:/path" (v1) or "0::/path" (v2).
std::optional<fs::path> own_group(const fs::path& root, const Version& version)
{
    std::ifstream file(root / "proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = std::min(line.find(':'), line.size());
        const std::size_t second = std::min(line.find(':', first + 1), line.size());
        const std::string controllers =
            ',' + line.substr(std::min(first + 1, line.size()), second - first - 1) + ',';
        const bool is_it = &version == &v2 ? controllers == ",,"
                                           : controllers.find(",memory,") != std::string::npos;
        if (is_it && second < line.size())
            return line.substr(second + 1);
    }
    return std::nullopt;
}

/// Returns the number in a file; nothing if there is none, as in v2's "max".
std::optional<std::uint64_t> number_in(const fs::path& path)
{
    std::ifstream file(path);
    std::uint64_t value = 0;
    return file >> value ? std::optional(value) : std::nullopt;
}

std::uint64_t kept_files(const fs::path& group, const Version& version)
{
    std::ifstream file(group / "memory.stat");
    std::uint64_t sum = 0, value = 0;
    for (std::string key; file >> key >> value;)
        if (key == version.inactive_files || key == version.active_files)
            sum += value;
    return sum;
}

std::optional<std::uint64_t> left_in(const fs::path& group, const Version& version)
{
    const auto limit = number_in(group / version.limit);
    const auto usage = number_in(group / version.usage);
    if (!limit || !usage)
        return std::nullopt;
    const std::uint64_t used = *usage - std::min(*usage, kept_files(group, version));
    return *limit - std::min(*limit, used);
}

}  // namespace

std::optional<std::uint64_t> cgroup_memory_left(const fs::path& root)
{
    std::optional<std::uint64_t> left;
    for (const Mount& mount : mounts(root)) {
        const auto own = own_group(root, *mount.version);
        if (!own)
            continue;
        // In a container the topmost group that is mounted may be the process's own.
        fs::path below = own->lexically_relative(mount.topmost);
        if (below.empty() || *below.begin() == "..")
            below = ".";
        // Visits the group and all mounted groups around it. Without a limit, v1 gives a number larger than any memory.
        for (;; below = below.parent_path()) {
            if (const auto here = left_in(mount.point / below, *mount.version))
                left = std::min(left.value_or(*here), *here);
            if (below.empty() || below == ".")
                break;
        }
    }
    return left;
}

}  // namespace bvhbench
