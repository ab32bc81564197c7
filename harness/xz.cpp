// SPDX-License-Identifier: MIT
#include "harness/xz.h"

#include <lzma.h>

#include <array>
#include <cstdint>
#include <limits>

#include "geometry/error.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

/// A decoder of the library's, released at the end.
struct Decoder {
    lzma_stream stream = LZMA_STREAM_INIT;

    Decoder() = default;
    ~Decoder() { lzma_end(&stream); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
};

}  // namespace

bool is_xz(std::string_view file)
{
    return file.starts_with(
        std::string_view("\xfd"
                         "7zXZ\0",
                         6));
}

std::string unpacked_xz(std::string_view file, const std::string& what)
{
    Decoder decoder;
    lzma_stream& stream = decoder.stream;
    lzma_ret state =
        lzma_stream_decoder(&stream, std::numeric_limits<std::uint64_t>::max(), LZMA_CONCATENATED);
    stream.next_in = reinterpret_cast<const std::uint8_t*>(file.data());
    stream.avail_in = file.size();
    std::string text;
    std::array<char, 1 << 16> piece;
    while (state == LZMA_OK) {
        stream.next_out = reinterpret_cast<std::uint8_t*>(piece.data());
        stream.avail_out = piece.size();
        state = lzma_code(&stream, LZMA_FINISH);
        const std::size_t count = piece.size() - stream.avail_out;
        if (text.size() + count >
            text.capacity()) {  // it doubles, and the old text is there while it is copied
            require_host_memory("unpacking " + what, 2 * (text.size() + count));
            text.reserve(2 * (text.size() + count));
        }
        text.append(piece.data(), count);
    }
    if (state != LZMA_STREAM_END)
        throw Unavailable(what + " cannot be unpacked: it is cut off or damaged");
    return text;
}

}  // namespace bvhbench
