// SPDX-License-Identifier: MIT
#include "harness/pocl_cache.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "geometry/error.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

fs::path variable(const char* name)
{
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

fs::path cache_folder()
{
    if (const fs::path base = variable("XDG_CACHE_HOME"); base.is_absolute())
        return base / "bvhbench" / "pocl";
    if (const fs::path home = variable("HOME"); home.is_absolute())
        return home / ".cache" / "bvhbench" / "pocl";
    return {};
}

/// PoCL leaves a tempfile_* behind in every process; an hour later no compilation can still need it.
void remove_leftovers(const fs::path& folder)
{
    const auto too_old = fs::file_time_type::clock::now() - std::chrono::hours(1);
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code ignored;  // another process may clean up at the same time
        if (entry->path().filename().string().starts_with("tempfile_") &&
            entry->last_write_time(ignored) < too_old && !ignored)
            fs::remove(entry->path(), ignored);
    }
}

/// PoCL writes there even for kernels that it has, and says of a disk that is full only that nothing was built.
void require_writable(const fs::path& folder)
{
    const fs::path probe = folder / ("tempfile_probe" + std::to_string(getpid()));
    const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    const std::string text(4096, ' ');
    const bool is_written =
        file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    const std::string reason = std::strerror(errno);
    if (file >= 0) {
        close(file);
        unlink(probe.c_str());
    }
    if (!is_written)
        throw Unavailable("the folder for compiled kernels, " + folder.string() +
                          ", cannot be written: " + reason + "; XDG_CACHE_HOME names another");
}

}  // namespace

void prepare_pocl_cache()
{
    if (!variable("POCL_CACHE_DIR").empty())
        return;  // whose folder that is, is not ours to know
    const fs::path folder = cache_folder();
    std::error_code error;
    if (folder.empty() || (fs::create_directories(folder, error), error))
        return;
    fs::permissions(folder, fs::perms::owner_all, error);
    require_writable(folder);
    setenv("POCL_CACHE_DIR", folder.c_str(), 1);  // empty counts as unset, PoCL aborts on it
    remove_leftovers(folder);
}

}  // namespace bvhbench
