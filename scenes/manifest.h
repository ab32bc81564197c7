// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/error.h"

namespace bvhbench {

/// A data set's file is there and sound, but has other counts than the manifest says.
class OtherCounts : public Unavailable {
    using Unavailable::Unavailable;
};

/// A line of scenes/manifest.tsv. A count of 0 is not known and not checked.
struct ManifestEntry {
    std::string name;
    std::size_t triangles = 0;
    bool is_frames = false;  ///< a folder of frames, not one mesh file
    std::size_t vertices = 0;
    std::size_t objects = 0;
    std::size_t frames = 0;
    std::vector<std::string> files;      ///< where it may lie under the data folder
    std::vector<std::string> stand_ins;  ///< scenes to build over when no file is there
    std::string source;                  ///< where to get it
    std::string note;
};

/// The lines of a manifest. Throws std::logic_error at a line it does not understand.
std::vector<ManifestEntry> parse_manifest(std::string_view text);

/// The data sets the program knows, in the manifest's order.
std::span<const ManifestEntry> manifest();
const ManifestEntry* manifest_entry(std::string_view name);

/// Where the data set lies under `data`; empty if it is not there.
std::filesystem::path located(const ManifestEntry& entry, const std::filesystem::path& data);

/// A line for people: its note, its counts and where it was found, or where to get it.
std::string summary(const ManifestEntry& entry, const std::filesystem::path& data);

}  // namespace bvhbench
