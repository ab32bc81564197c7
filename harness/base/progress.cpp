// SPDX-License-Identifier: MIT
#include "harness/base/progress.h"

#include <unistd.h>

#include <cstdio>

#include "harness/base/printable.h"

namespace bvhbench {
namespace {

constexpr const char* clear_line = "\r\033[K";

}  // namespace

Progress::Progress(std::size_t total) : total_(total), is_shown_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress()
{
    if (is_shown_)
        std::fputs(clear_line, stderr);
}

void Progress::step(const std::string& what)
{
    ++done_;
    note(what);
}

void Progress::note(const std::string& what) const
{
    if (is_shown_)
        std::fprintf(stderr, "%s[%zu/%zu] %s", clear_line, done_, total_, printable(what).c_str());
}

}  // namespace bvhbench
