// SPDX-License-Identifier: MIT
#include "harness/base/file_text.h"

#include <lzma.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "geometry/error.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t bytes_a_text_byte = 8;

/// A decoder of the library's, released at the end.
struct Decoder {
    lzma_stream stream = LZMA_STREAM_INIT;

    Decoder() = default;
    ~Decoder() { lzma_end(&stream); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
};

/// Whether a file with these contents is a .xz file.
bool is_xz(std::string_view file)
{
    return file.starts_with(
        std::string_view("\xfd"
                         "7zXZ\0",
                         6));
}

/// The contents of a .xz file, unpacked; `what` names it in errors. Throws Unavailable if it is damaged or cut off, or if the
/// host has not the memory for what comes out.
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

}  // namespace

std::string file_text(const fs::path& path, const std::string& what)
{
    std::error_code error;
    if (fs::is_directory(path, error))
        throw Unavailable(what + " '" + path.string() + "' cannot be read: it is a folder");
    if (const std::uintmax_t size = fs::file_size(path, error); !error)  // a pipe has none
        require_host_memory("reading '" + path.string() + '\'', bytes_a_text_byte * size);
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text;
    if (file.is_open())
        text.assign(std::istreambuf_iterator<char>(file), {});
    if (!file.is_open() || file.bad())
        throw Unavailable(what + " '" + path.string() + "' cannot be read" +
                          (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
    return is_xz(text) ? unpacked_xz(text, what + " '" + path.string() + '\'') : text;
}

}  // namespace bvhbench
