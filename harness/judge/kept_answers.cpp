// SPDX-License-Identifier: MIT
#include "harness/judge/kept_answers.h"

#include <re2/re2.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "geometry/hash.h"
#include "harness/session/pocl_cache.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t least_pairs = 100'000;  ///< fewer are listed in a tenth of a second
constexpr std::ptrdiff_t most_files = 4096;     ///< 16 MiB on disks with blocks of 4 KiB

fs::path file_of(std::uint64_t key)
{
    const fs::path folder = cache_folder("answers");
    return folder.empty() ? folder : folder / (hex(key) + ".txt");
}

/// Returns the text of a file: one line that ends in a hash of what is before it.
std::string text_of(std::uint64_t key, const AnswerFacts& facts)
{
    const std::string line = "bvhbench answer " + hex(key) + ' ' + hex(facts.set.count) + ' ' +
                             hex(facts.set.low) + ' ' + hex(facts.set.high) + ' ' +
                             hex(facts.file_hash) + ' ' + hex(facts.touching) + ' ';
    Hash hash;
    hash.bytes(line.data(), line.size());
    return line + hex(hash.get()) + '\n';
}

}  // namespace

std::optional<AnswerFacts> kept_answer(std::uint64_t key)
{
    std::ifstream file(file_of(key), std::ios::binary);
    std::string text(4096, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    AnswerFacts facts;
    const bool is_answer = RE2::FullMatch(
        text,
        "bvhbench answer \\w{16} (\\w{16}) (\\w{16}) (\\w{16}) (\\w{16}) (\\w{16}) \\w{16}\\n",
        RE2::Hex(&facts.set.count), RE2::Hex(&facts.set.low), RE2::Hex(&facts.set.high),
        RE2::Hex(&facts.file_hash), RE2::Hex(&facts.touching));
    if (!is_answer || text != text_of(key, facts))
        return std::nullopt;
    return facts;
}

void keep_answer(std::uint64_t key, const AnswerFacts& facts)
try {
    const fs::path path = file_of(key);
    if (path.empty() || facts.set.count < least_pairs)
        return;
    const fs::path folder = path.parent_path();
    fs::create_directories(folder);
    if (std::distance(fs::directory_iterator(folder), fs::directory_iterator()) >= most_files)
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            fs::remove_all(entry);
    const fs::path temporary = folder / (hex(key) + '-' + std::to_string(getpid()));
    std::error_code failed;
    if (std::ofstream(temporary, std::ios::binary) << text_of(key, facts) << std::flush)
        fs::rename(temporary, path, failed);
    fs::remove(temporary, failed);       // what could not be written or renamed
} catch (const fs::filesystem_error&) {  // the next run asks the oracle again
}

}  // namespace bvhbench
