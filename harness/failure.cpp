// SPDX-License-Identifier: MIT
#include "harness/failure.h"

#include <filesystem>
#include <new>

#include "device/cl.h"
#include "device/error_name.h"
#include "geometry/error.h"

namespace bvhbench {

std::string sentence_of(const std::exception& error)
{
    if (const auto* from_cl = dynamic_cast<const cl::Error*>(&error))
        return std::string(from_cl->what()) + " failed: " + opencl_error_name(from_cl->err());
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return "the host has not enough memory";
    if (const auto* of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
        return of_file->path1().string() + ": " + of_file->code().message();
    return error.what();
}

std::string reason_of_failure(const std::function<void()>& work)
{
    bool ignored = false;
    return reason_of_failure(ignored, work);
}

std::string reason_of_failure(bool& cannot_be, const std::function<void()>& work)
{
    cannot_be = false;
    try {
        work();
        return {};
    } catch (const std::exception& error) {
        cannot_be = dynamic_cast<const BadUsage*>(&error) != nullptr;
        const std::string sentence = sentence_of(error);
        return sentence.empty() ? "failed without a word" : sentence;
    }
}

}  // namespace bvhbench
