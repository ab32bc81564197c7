// SPDX-License-Identifier: MIT
//
// Every file that a command writes. It is checked before anything is measured, and replaced as a whole.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace bvhbench {

/// What an output may replace.
struct OutputRules {
    bool force = false;                    ///< --force: any earlier file that is no input
    std::vector<std::string> inputs = {};  ///< files and folders that it reads, there or not
    /// Whether the text of an earlier file may be replaced without --force: because the command made it and makes it
    /// again, or because it keeps what is in it. Empty: no.
    std::function<bool(const std::string& text)> may_replace = {};
};

/// A file that a command will write, or nowhere.
///
/// Links are followed. Devices, pipes, and the file that is this process's standard output are written to as they are; any
/// other file is replaced by one that was written beside it, with its mode and owner.
class Output {
public:
    /// Nowhere: nothing is written.
    Output() = default;

    /// Reserves `path` for this process until the object is destroyed; nowhere if it is empty. `option` is what the user
    /// named it by.
    ///
    /// Throws BadUsage if it is a folder, a .xz file, an input, or an earlier file that the rules do not let go, and Unavailable if it
    /// cannot be written or another process has reserved it. No folder is made.
    Output(const std::filesystem::path& path, const std::string& option, const OutputRules& rules);

    bool is_nowhere() const { return path_.empty(); }

    /// Whether it can be replaced again and again: it is neither a device nor a pipe.
    bool is_file() const { return is_file_; }

    /// Whether an earlier file was there that is not empty.
    bool was_there() const { return was_there_; }

    /// As the user named it.
    const std::filesystem::path& path() const { return path_; }

    /// Replaces the file by `text`. Throws Unavailable with the system's reason; then the earlier file stays.
    void replace(std::string_view text) const;

    /// Writes the file piece by piece: nothing is replaced before finish(), and without it nothing at all.
    class Writer {
    public:
        explicit Writer(const Output& output);
        ~Writer();
        Writer(const Writer&) = delete;
        Writer& operator=(const Writer&) = delete;

        /// Throws Unavailable with the system's reason, as finish() does.
        void append(std::string_view text);

        /// Syncs the new file, renames it, and syncs the folder.
        void finish();

    private:
        const Output& output_;
        std::filesystem::path temporary_;  ///< empty: written to as it is
        int file_ = -1;
    };

private:
    void check_earlier(const OutputRules& rules, const std::string& option);

    std::filesystem::path path_;
    std::filesystem::path target_;  ///< without links
    bool is_file_ = false;
    bool was_there_ = false;
    std::shared_ptr<const void> lock_;
};

/// Throws BadUsage if a file in `folder`, which a command draws pictures into, is called like a picture and is none, or is an
/// input. --force lets go what is no input.
void check_pictures(const std::filesystem::path& folder, const std::string& option,
                    OutputRules rules);

/// Creates the folder that a command was asked to write into. Throws Unavailable with the system's reason.
void make_folder(const std::filesystem::path& folder);

}  // namespace bvhbench
