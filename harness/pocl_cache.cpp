// SPDX-License-Identifier: MIT
#include "harness/pocl_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "geometry/error.h"
#include "harness/cache_seals.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

/// More than what all programs of one run take.
constexpr std::uintmax_t needed_bytes = std::uintmax_t{16} << 20;

/// Some 400 programs. To hold all of it to its seals takes 0.06 s, and that at every start.
constexpr std::uintmax_t most_bytes = std::uintmax_t{32} << 20;

fs::path variable(const char* name)
{
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

fs::path own_folder()
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

void tell_pocl(const fs::path& folder) { setenv("POCL_CACHE_DIR", folder.c_str(), 1); }

}  // namespace

std::string folder_problem(const fs::path& folder, std::uintmax_t bytes)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return error.message();
    const fs::space_info space = fs::space(folder, error);
    if (!error && space.available < bytes)
        return std::to_string(space.available) + " bytes are free, and " + std::to_string(bytes) +
               " needed";
    const fs::path probe = folder / ("probe-" + std::to_string(getpid()));
    const bool is_written =
        static_cast<bool>(std::ofstream(probe) << std::string(4096, ' ') << std::flush);
    fs::remove(probe, error);
    return is_written ? "" : "no file can be written there";
}

PoclCache::PoclCache()
{
    const fs::path named = variable("POCL_CACHE_DIR"), own = own_folder();
    const fs::path folder = named.empty() ? own : named;
    std::string problem =
        folder.empty() ? "there is no home folder" : folder_problem(folder, needed_bytes);
    if (problem.empty() && folder == own && !take(folder))
        problem = "what is broken there cannot be removed";
    if (problem.empty())
        tell_pocl(folder);  // empty counts as unset, PoCL aborts on it
    else
        take_temporary("they cannot be kept in '" + folder.string() + "': " + problem);
}

PoclCache::~PoclCache()
{
    if (!ours_.empty())
        seal(ours_);
    if (lock_ >= 0)
        close(lock_);
    std::error_code ignored;
    if (!temporary_.empty()) {
        fs::remove_all(temporary_, ignored);
        unsetenv("POCL_CACHE_DIR");
    }
}

/// Look for what is broken unless others use the folder: then they, or those before them, have.
bool PoclCache::take(const fs::path& folder)
{
    std::error_code ignored;
    fs::permissions(folder, fs::perms::owner_all, ignored);
    lock_ = open((folder / "bvhbench.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    const bool is_alone = lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) == 0;
    if (is_alone && !remove_broken(folder, most_bytes))
        return false;
    if (lock_ >= 0)
        flock(lock_, LOCK_SH);  // waits for whoever is looking just now
    remove_leftovers(folder);
    ours_ = folder;
    return true;
}

void PoclCache::take_temporary(const std::string& why)
{
    std::error_code error;
    const fs::path base = fs::temp_directory_path(error);
    std::string problem = error ? error.message() : folder_problem(base, needed_bytes);
    std::string name = (base / "bvhbench-pocl-XXXXXX").string();
    if (problem.empty() && mkdtemp(name.data()) == nullptr)
        problem = "no folder can be made there";
    if (!problem.empty())
        throw Unavailable("there is nowhere to put compiled kernels: " + why +
                          "; nor among temporary files: " + problem);
    temporary_ = name;
    removed_.emplace([this] {
        std::error_code ignored;
        fs::remove_all(temporary_, ignored);
    });
    tell_pocl(temporary_);
    std::cerr << "bvhbench: kernels are compiled anew, for " << why << '\n';
}

}  // namespace bvhbench
