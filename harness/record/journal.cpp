// SPDX-License-Identifier: MIT
#include "harness/record/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <utility>

#include "harness/base/failure.h"
#include "harness/base/json_keys.h"
#include "process/worker.h"

namespace bvhbench {

Journal::~Journal()
{
    if (file_ >= 0)
        close(file_);
}

void Journal::open(std::filesystem::path path)
{
    path_ = std::move(path);
    if (std::filesystem::exists(path_))
        std::filesystem::resize_file(path_, file_text(path_, "the journal").rfind('\n') + 1);
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0)
        cannot_write(path_);
}

void Journal::append(const std::string& line)
{
    if (file_ >= 0 && !write_all(file_, line + '\n'))
        cannot_write(path_);
}

void Journal::append(const std::string& part, const char* kind, const std::string& value)
{
    append("{\"part\": \"" + part + "\", \"" + kind + "\": " + value + '}');
}

}  // namespace bvhbench
