// SPDX-License-Identifier: MIT
#include "harness/session/pocl_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <vector>

#include "geometry/error.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

/// More than what all programs of one run take.
constexpr std::uintmax_t needed_bytes = std::uintmax_t{16} << 20;

/// Some 400 programs.
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

/// A program that PoCL keeps, in folder/XX/<hash>.
struct KeptProgram {
    fs::path path;
    std::uintmax_t bytes = 0;
    fs::file_time_type used;
};

/// Throws filesystem_error where others remove what is being listed.
std::vector<KeptProgram> programs_in(const fs::path& folder)
{
    std::vector<KeptProgram> programs;
    for (const auto& group : fs::directory_iterator(folder)) {
        if (group.path().filename().string().size() != 2 || !group.is_directory())
            continue;
        for (const auto& entry : fs::directory_iterator(group)) {
            KeptProgram program{entry.path(), 0, entry.last_write_time()};
            for (const auto& file : fs::recursive_directory_iterator(entry)) {
                if (file.path().filename() == "last_accessed")
                    program.used = file.last_write_time();  // PoCL empties it at every use
                else if (!file.is_directory())
                    program.bytes += file.file_size();
            }
            programs.push_back(std::move(program));
        }
    }
    return programs;
}

/// Removes the programs used longest ago until all take no more than `most_bytes`.
void remove_oldest(const fs::path& folder)
try {
    std::vector<KeptProgram> programs = programs_in(folder);
    std::sort(programs.begin(), programs.end(),
              [](const KeptProgram& a, const KeptProgram& b) { return a.used > b.used; });
    std::uintmax_t bytes = 0;
    for (const KeptProgram& program : programs)
        if ((bytes += program.bytes) > most_bytes)
            fs::remove_all(program.path);
} catch (const std::exception&) {  // what cannot be removed stays
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
    if (!problem.empty()) {
        take_temporary("they cannot be kept in '" + folder.string() + "': " + problem);
        return;
    }
    if (folder == own)
        tidy(folder);
    tell_pocl(folder);  // empty counts as unset, PoCL aborts on it
}

PoclCache::~PoclCache()
{
    if (lock_ >= 0)
        close(lock_);
    std::error_code ignored;
    if (!temporary_.empty()) {
        fs::remove_all(temporary_, ignored);
        unsetenv("POCL_CACHE_DIR");
    }
}

/// Nothing is removed while others use the folder.
void PoclCache::tidy(const fs::path& folder)
{
    std::error_code ignored;
    fs::permissions(folder, fs::perms::owner_all, ignored);
    lock_ = open((folder / "bvhbench.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) == 0)
        remove_oldest(folder);
    if (lock_ >= 0)
        flock(lock_, LOCK_SH);  // waits for a process that is removing just now
    remove_leftovers(folder);
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
