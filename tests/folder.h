// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace bvhbench {

/// A temporary folder that is deleted with the object. Its name begins with `name`.
class Folder {
public:
    explicit Folder(const std::string& name = "bvhbench-")
    {
        std::string pattern = std::filesystem::temp_directory_path() / (name + "XXXXXX");
        if (mkdtemp(pattern.data()) == nullptr)
            throw std::runtime_error("no temporary folder " + pattern);
        path_ = pattern;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path_); }

    /// Writes a file and returns its path.
    std::string file(const std::string& name, std::string_view bytes) const
    {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Returns this machine's data folder, which BVHBENCH_DATA names; empty if there is none.
inline std::filesystem::path data_folder()
{
    const char* const folder = std::getenv("BVHBENCH_DATA");
    return folder != nullptr ? folder : "";
}

}  // namespace bvhbench
