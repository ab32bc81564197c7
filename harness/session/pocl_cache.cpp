// SPDX-License-Identifier: MIT
#include "harness/session/pocl_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "geometry/error.h"
#include "harness/base/common_options.h"
#include "harness/base/failure.h"
#include "process/watchdog.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

/// Free space needed: more than all programs of one run take.
constexpr std::uintmax_t needed_bytes = std::uintmax_t{16} << 20;

/// Limit of our own folder's size: some hundred programs.
constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20;

constexpr const char* lock_name = "bvhbench.lock";

/// Removes everything that PoCL has stored in the folder if the files take more than most_bytes.
void empty_if_large(const fs::path& folder)
try {
    constexpr std::uintmax_t block = 4096;
    std::uintmax_t bytes = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        bytes += entry.is_regular_file() ? block + entry.file_size() : 0;
    if (bytes <= most_bytes)
        return;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != lock_name)
            fs::remove_all(entry);
} catch (const fs::filesystem_error&) {  // files that cannot be removed stay
}

/// Creates the folder if necessary. Returns why it cannot hold compiled kernels; empty if it can.
std::string folder_problem(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return error.message();
    const fs::space_info space = fs::space(folder, error);
    if (!error && space.available < needed_bytes)
        return std::to_string(space.available) + " bytes are free, and " +
               std::to_string(needed_bytes) + " needed";
    const fs::path probe = folder / ("probe-" + std::to_string(getpid()));
    const bool is_written =
        static_cast<bool>(std::ofstream(probe) << std::string(4096, ' ') << std::flush);
    fs::remove(probe, error);
    return is_written ? "" : "no file can be written there";
}

}  // namespace

fs::path cache_folder(const char* of)
{
    if (const fs::path base = environment("XDG_CACHE_HOME"); base.is_absolute())
        return base / "bvhbench" / of;
    std::error_code error;
    if (const fs::path home = environment("HOME");
        home.is_absolute() && fs::is_directory(home, error))
        return home / ".cache" / "bvhbench" / of;
    return {};
}

PoclCache::PoclCache()
{
    const fs::path named = environment("POCL_CACHE_DIR"), own = cache_folder("pocl");
    const fs::path folder = named.empty() ? own : named;
    std::string problem = folder.empty() ? "there is no home folder" : folder_problem(folder);
    if (!problem.empty())
        take_temporary("they cannot be kept in '" + folder.string() + "': " + problem);
    else if (folder == own)
        share(folder);
    const fs::path& used = temporary_ ? temporary_->path : folder;
    setenv("POCL_CACHE_DIR", used.c_str(), 1);  // replaces an empty one, on which PoCL aborts
    if (!temporary_)
        watchdog::kernels_are_in(used);
}

PoclCache::~PoclCache()
{
    if (lock_ >= 0)
        close(lock_);
    if (temporary_)
        unsetenv("POCL_CACHE_DIR");
}

/// Empties a large folder, but not while other processes use it.
void PoclCache::share(const fs::path& folder)
{
    std::error_code ignored;
    fs::permissions(folder, fs::perms::owner_all, ignored);
    lock_ = open((folder / lock_name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock_ < 0)
        return;
    if (flock(lock_, LOCK_EX | LOCK_NB) == 0)
        empty_if_large(folder);
    flock(lock_, LOCK_SH);  // waits while another process empties the folder
}

void PoclCache::take_temporary(const std::string& why)
{
    std::string problem = reason_of_failure([&] { temporary_.emplace("pocl"); });
    if (problem.empty())
        problem = folder_problem(temporary_->path);
    if (!problem.empty())
        throw Unavailable("there is nowhere to put compiled kernels: " + why +
                          "; nor among temporary files: " + problem);
    std::cerr << "bvhbench: kernels are compiled anew, for " << why << '\n';
}

}  // namespace bvhbench
