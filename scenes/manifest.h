// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/error.h"

namespace bvhbench {

/// The file of a data set exists and is valid, but its counts differ from the manifest.
class OtherCounts : public Unavailable {
    using Unavailable::Unavailable;
};

/// One line of scenes/manifest.tsv. A count of 0 is unknown and not checked.
struct ManifestEntry {
    std::string name;
    std::size_t triangles = 0;
    enum class Kind {
        mesh,     ///< one mesh file
        frames,   ///< a folder of frames
        queries,  ///< a folder of moving_queries.h, which is no scene
    } kind = Kind::mesh;
    std::size_t vertices = 0;
    std::size_t objects = 0;
    std::size_t frames = 0;
    std::vector<std::string> files;      ///< possible paths in the data folder
    std::vector<std::string> stand_ins;  ///< scenes to use instead if no file is found
    std::string source;                  ///< where to download it
    std::string note;
};

/// Returns the lines of a manifest. Throws std::logic_error at a malformed line.
std::vector<ManifestEntry> parse_manifest(std::string_view text);

/// Returns the data sets known to the program, in the manifest's order.
std::span<const ManifestEntry> manifest();
const ManifestEntry* manifest_entry(std::string_view name);

/// Returns the path of the data set under `data`; empty if it is not there.
std::filesystem::path located(const ManifestEntry& entry, const std::filesystem::path& data);

/// Returns a line of text: the note, the counts, and either where the data set was found or where to download it.
std::string summary(const ManifestEntry& entry, const std::filesystem::path& data);

}  // namespace bvhbench
