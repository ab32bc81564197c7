// SPDX-License-Identifier: MIT
#include "harness/base/printable.h"

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

}  // namespace bvhbench
