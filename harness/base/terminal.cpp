// SPDX-License-Identifier: MIT
#include "harness/base/terminal.h"

#include <unistd.h>

#include <cstdio>

namespace bvhbench {

std::string printable(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte >= 0x20 && byte != 0x7f) || c == '\n' || c == '\t') {
            out += c;
            continue;
        }
        char escaped[8];
        std::snprintf(escaped, sizeof escaped, "\\x%02x", byte);
        out += escaped;
    }
    return out;
}

std::streamsize PrintableOutput::xsputn(const char* text, std::streamsize count)
{
    const std::string shown = printable({text, static_cast<std::size_t>(count)});
    const auto size = static_cast<std::streamsize>(shown.size());
    return to_->sputn(shown.data(), size) == size ? count : 0;
}

int PrintableOutput::overflow(int c)
{
    if (c == traits_type::eof())
        return 0;
    const char text = static_cast<char>(c);
    return xsputn(&text, 1) == 1 ? c : traits_type::eof();
}

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
