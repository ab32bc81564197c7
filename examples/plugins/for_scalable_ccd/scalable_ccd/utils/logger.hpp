// SPDX-License-Identifier: MIT
//
// Stands before Scalable-CCD's header of this name, which needs spdlog and the fmt within it. Of the log errors are kept.
#pragma once

#include <cassert>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace fmt {

// The one call: the text of an exception, "CUDA error {}".
inline std::string format(const char* text, int number)
{
    return std::string(text) + " " + std::to_string(number);
}

}  // namespace fmt

namespace scalable_ccd {

struct Log {
    template <class... Values>
    void trace(const Values&...) const
    {}
    template <class... Values>
    void debug(const Values&...) const
    {}
    template <class... Values>
    void warn(const Values&...) const
    {}

    template <class... Values>
    void error(const char* text, const Values&... values) const
    {
        std::fprintf(stderr, "Scalable-CCD: %s", text);
        (write(values), ...);
        std::fputc('\n', stderr);
    }

private:
    static void write(const std::string& value) { std::fprintf(stderr, " %s", value.c_str()); }
    static void write(long long value) { std::fprintf(stderr, " %lld", value); }
};

inline const Log& logger()
{
    static const Log log;
    return log;
}

}  // namespace scalable_ccd
