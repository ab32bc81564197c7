// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/error.h"
#include "scenes/catalog.h"

namespace bvhbench {

/// A temporary folder that is deleted with the object.
class Folder {
public:
    Folder()
    {
        std::string pattern = std::filesystem::temp_directory_path() / "bvhbench-scenes-XXXXXX";
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

/// Returns the message with which loading `text` is refused, after its class: "BadUsage: no scene is called ...".
inline std::string refusal(std::string_view text, const SceneLibrary& library = {})
{
    try {
        load_scene(text, library);
    } catch (const BadUsage& error) {
        return std::string("BadUsage: ") + error.what();
    } catch (const Unavailable& error) {
        return std::string("Unavailable: ") + error.what();
    }
    return "loaded";
}

inline testing::AssertionResult contains(const std::string& text, const std::string& part)
{
    if (text.find(part) != text.npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << "'" << text << "' lacks '" << part << "'";
}

/// Returns this machine's data folder; empty if there is none.
inline std::string data_folder()
{
    const char* const folder = std::getenv("BVHBENCH_DATA");
    return folder == nullptr ? "" : folder;
}

}  // namespace bvhbench
