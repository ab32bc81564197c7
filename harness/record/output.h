// SPDX-License-Identifier: MIT
//
// Files that commands write. An output is checked before anything is measured, and is replaced as a whole.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace bvhbench {

/// Rules for replacing existing files.
struct OutputRules {
    bool force = false;                    ///< --force: replace any file that is not an input
    std::vector<std::string> inputs = {};  ///< files and folders that are read; they need not exist
    /// Whether an existing file with this text may be replaced without --force, for example because the same run wrote it or
    /// because its contents are kept. Empty: no file may.
    std::function<bool(const std::string& text)> may_replace = {};
};

/// A file that a command will write, or no file.
///
/// Links are followed. Devices, pipes, and the file behind this process's standard output or standard error are written
/// directly. Any other file is written under a temporary name in its folder, with the old file's mode and owner, and renamed.
class Output {
public:
    /// Makes an output that writes nothing.
    Output() = default;

    /// Reserves `path` for this process for the lifetime of the object. An empty path makes an output that writes nothing.
    /// `option` is the command-line option, for messages.
    ///
    /// Throws BadUsage if it is a folder, a .xz file, an input, or an existing file that `rules` protect. Throws Unavailable if
    /// it cannot be written or another process has reserved it. Creates no folder.
    Output(const std::filesystem::path& path, const std::string& option, const OutputRules& rules);

    bool is_nowhere() const { return path_.empty(); }

    /// True if it can be replaced repeatedly; false for devices and pipes.
    bool is_file() const { return is_file_; }

    /// True if a non-empty file existed before.
    bool was_there() const { return was_there_; }

    /// Path as given by the user.
    const std::filesystem::path& path() const { return path_; }

    /// Returns the path of a file beside the one that is replaced, whose name has `end` appended.
    std::filesystem::path beside(const char* end) const { return target_.string() + end; }

    /// Replaces the file by `text`. Throws Unavailable with the system's reason and leaves the old file unchanged.
    void replace(std::string_view text) const;

    /// Writes the file in pieces. finish() replaces the old file; without it the old file stays unchanged.
    class Writer {
    public:
        explicit Writer(const Output& output);
        ~Writer();
        Writer(const Writer&) = delete;
        Writer& operator=(const Writer&) = delete;

        /// Appends text. Throws Unavailable with the system's reason, as finish() does.
        void append(std::string_view text);

        /// Syncs the new file, renames it, and syncs its folder.
        void finish();

    private:
        const Output& output_;
        std::filesystem::path temporary_;  ///< empty: the output is written directly
        int file_ = -1;
    };

private:
    std::filesystem::path path_;
    std::filesystem::path target_;  ///< path with all links resolved
    bool is_file_ = false;
    bool was_there_ = false;
    std::shared_ptr<const void> lock_;
};

/// Throws BadUsage if a .png or .svg file in `folder`, where a command will draw, is an input or is not a picture. With --force,
/// only inputs are refused.
void check_pictures(const std::filesystem::path& folder, const std::string& option,
                    OutputRules rules);

}  // namespace bvhbench
