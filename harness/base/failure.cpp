// SPDX-License-Identifier: MIT
#include "harness/base/failure.h"

#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>

#include "device/cl.h"
#include "geometry/error.h"

namespace bvhbench {

std::string sentence_of(const std::exception& error)
{
    if (const auto* from_cl = dynamic_cast<const cl::Error*>(&error))
        return std::string(from_cl->what()) + " failed: " + opencl_error_name(from_cl->err());
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return "out of host memory: more was needed than had been asked for";
    if (const auto* of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
        return of_file->path1().string() + ": " + of_file->code().message();
    if (const auto* from_system = dynamic_cast<const std::system_error*>(&error);
        from_system != nullptr && from_system->code() == std::errc::resource_unavailable_try_again)
        return "out of host memory: there is no room for another thread";
    const std::string sentence = error.what();
    return sentence.empty() ? "failed without a word" : sentence;
}

void cannot_write(const std::filesystem::path& path, const std::string& why)
{
    throw Unavailable(path.string() +
                      " cannot be written: " + (why.empty() ? std::strerror(errno) : why));
}

std::string reason_of_failure(const std::function<void()>& work, bool* cannot_be)
{
    try {
        work();
        return {};
    } catch (const std::exception& error) {
        if (cannot_be != nullptr)
            *cannot_be = dynamic_cast<const BadUsage*>(&error) != nullptr;
        return sentence_of(error);
    }
}

}  // namespace bvhbench
