// SPDX-License-Identifier: MIT
#include "process/temporary_folder.h"

#include <cstdlib>

#include "geometry/error.h"

namespace bvhbench {
namespace {

std::filesystem::path made(const std::string& of)
{
    std::error_code error;
    std::string name =
        (std::filesystem::temp_directory_path(error) / ("bvhbench-" + of + "-XXXXXX")).string();
    if (error || mkdtemp(name.data()) == nullptr)
        throw Unavailable("no folder can be made as " + name);
    return name;
}

void discard(const std::filesystem::path& folder)
{
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& of)
    : path(made(of)), removed_([this] { discard(path); })
{}

TemporaryFolder::~TemporaryFolder() { discard(path); }

}  // namespace bvhbench
