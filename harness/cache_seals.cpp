// SPDX-License-Identifier: MIT
#include "harness/cache_seals.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

struct Seal {
    std::uint64_t sum = 0;
    std::uintmax_t bytes = 0;
    bool operator==(const Seal&) const = default;
};
using Seals = std::map<std::string, Seal>;  ///< by path below the folder

fs::path seals_file(const fs::path& folder) { return folder / "bvhbench.seals"; }

/// Of eight bytes at a time, several times as fast as a hash of single ones: a cache is read whole at every start.
Seal seal_of(const fs::path& path)
{
    std::string text(fs::file_size(path), '\0');
    std::ifstream(path, std::ios::binary)
        .read(text.data(), static_cast<std::streamsize>(text.size()));
    std::uint64_t sum = text.size();
    for (std::size_t at = 0; at < text.size(); at += sizeof sum) {
        std::uint64_t word = 0;
        std::memcpy(&word, text.data() + at, std::min(sizeof word, text.size() - at));
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 29;
    }
    return {sum, text.size()};
}

/// A file that says nothing, or is cut short, seals nothing.
Seals read_seals(const fs::path& folder)
{
    Seals seals;
    std::ifstream file(seals_file(folder));
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        Seal seal;
        std::string path;
        if (words >> std::hex >> seal.sum >> std::dec >> seal.bytes >> std::ws &&
            std::getline(words, path))
            seals[path] = seal;
    }
    return seals;
}

struct Program {
    fs::path path;
    std::vector<fs::path> files;
    std::uintmax_t bytes = 0;
    fs::file_time_type used;
};

/// Throws filesystem_error where others remove what is being listed.
std::vector<Program> programs_in(const fs::path& folder)
{
    std::vector<Program> programs;
    for (const auto& group : fs::directory_iterator(folder)) {
        if (group.path().filename().string().size() != 2 || !group.is_directory())
            continue;
        for (const auto& entry : fs::directory_iterator(group)) {
            Program program{entry.path(), {}, 0, entry.last_write_time()};
            if (!entry.is_directory())
                program.files.push_back(entry.path());
            else
                for (const auto& file : fs::recursive_directory_iterator(entry)) {
                    if (file.path().filename() == "last_accessed") {
                        program.used = file.last_write_time();  // PoCL empties it at every use
                    } else if (!file.is_directory()) {
                        program.files.push_back(file.path());
                        program.bytes += file.file_size();
                    }
                }
            programs.push_back(std::move(program));
        }
    }
    return programs;
}

std::string name_of(const fs::path& file, const fs::path& folder)
{
    return file.lexically_relative(folder).string();
}

/// Another file that becomes it. Not waited for: lost with the machine's power, it is but compiled again.
void write_seals(const fs::path& folder, const Seals& seals)
{
    const fs::path temporary = folder / ("bvhbench.seals." + std::to_string(getpid()));
    std::ofstream file(temporary);
    for (const auto& [name, seal] : seals)
        file << std::hex << seal.sum << ' ' << std::dec << seal.bytes << ' ' << name << '\n';
    file.close();
    if (!file) {
        fs::remove(temporary);
        throw std::runtime_error("no room for seals");
    }
    fs::rename(temporary, seals_file(folder));
}

bool is_as_sealed(const Program& program, const fs::path& folder, const Seals& seals)
{
    return std::all_of(program.files.begin(), program.files.end(), [&](const fs::path& file) {
        const auto known = seals.find(name_of(file, folder));
        return known != seals.end() && known->second == seal_of(file);
    });
}

}  // namespace

bool remove_broken(const fs::path& folder, std::uintmax_t most_bytes)
try {
    std::vector<Program> programs = programs_in(folder);
    std::sort(programs.begin(), programs.end(),
              [](const Program& a, const Program& b) { return a.used > b.used; });
    const Seals seals = read_seals(folder);
    Seals kept;
    std::uintmax_t bytes = 0;
    for (const Program& program : programs) {
        if (bytes + program.bytes > most_bytes || !is_as_sealed(program, folder, seals)) {
            fs::remove_all(program.path);
            continue;
        }
        bytes += program.bytes;
        for (const fs::path& file : program.files)
            kept.insert(*seals.find(name_of(file, folder)));
    }
    if (kept != seals)
        write_seals(folder, kept);
    return true;
} catch (const std::exception&) {
    return false;
}

void seal(const fs::path& folder) noexcept
try {
    const Seals known = read_seals(folder);
    Seals seals;
    for (const Program& program : programs_in(folder))
        for (const fs::path& file : program.files) {
            const std::string name = name_of(file, folder);
            const auto found = known.find(name);
            seals[name] = found != known.end() ? found->second : seal_of(file);
        }
    if (seals != known)
        write_seals(folder, seals);
} catch (const std::exception&) {  // others removed what was being listed, or there is no room
}

}  // namespace bvhbench
