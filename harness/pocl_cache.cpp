// SPDX-License-Identifier: MIT
#include "harness/pocl_cache.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

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
    setenv("POCL_CACHE_DIR", folder.c_str(), 1);  // empty counts as unset, PoCL aborts on it
    remove_leftovers(folder);
}

}  // namespace bvhbench
