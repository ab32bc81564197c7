// SPDX-License-Identifier: MIT
#include "harness/session/sample_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "geometry/error.h"

namespace bvhbench {

SampleLock::SampleLock()
{
    const char* path = std::getenv("BVHBENCH_SAMPLE_LOCK");
    if (path == nullptr || *path == '\0')
        return;
    descriptor_ = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
        throw Unavailable("BVHBENCH_SAMPLE_LOCK: " + std::string(path) +
                          " cannot be written: " + std::strerror(errno));
    while (flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
}

SampleLock::~SampleLock()
{
    if (descriptor_ >= 0)
        close(descriptor_);
}

}  // namespace bvhbench
