// SPDX-License-Identifier: MIT
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "builders/orders.h"
#include "geometry/error.h"
#include "harness/commands.h"
#include "harness/plot.h"
#include "harness/result_file.h"
#include "harness/view.h"

namespace bvhbench {
namespace {

/// Files that only the page's script reads, in a folder that is removed when it is done.
class ViewFiles {
public:
    ViewFiles()
    {
        std::string name = (std::filesystem::temp_directory_path() / "bvhbench-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw Unavailable("no temporary folder can be made as " + name + ": " +
                              std::strerror(errno));
        folder_ = name;
    }
    ViewFiles(const ViewFiles&) = delete;
    ViewFiles& operator=(const ViewFiles&) = delete;
    ~ViewFiles()
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    void add(const View& view)
    {
        paths_.push_back((folder_ / std::to_string(paths_.size())).string());
        write_atomically(paths_.back(), view_text(view));
    }

    const std::vector<std::string>& paths() const { return paths_; }

private:
    std::filesystem::path folder_;
    std::vector<std::string> paths_;
};

/// Wrong words are found before anything is opened.
void check_words(const ReportCommand& command)
{
    if (command.files.empty() && command.scenes.empty())
        throw BadUsage("name result files, or a --scene to show");
    find_builder(command.builder.name);
    find_order(command.builder.order);
    check_boxes(command.builder);
    find_collider(command.collider.name);
}

}  // namespace

int report(const ReportCommand& command, const Options& options)
{
    check_words(command);
    const SceneLibrary library = scene_library(options.common);
    std::vector<std::string> inputs = command.files;
    for (const std::string& scene : command.scenes)
        for (std::string& file : scene_files(scene, library))
            inputs.push_back(std::move(file));
    const Output page(
        command.out, "--out",
        {.force = options.common.force, .inputs = std::move(inputs), .may_replace = is_page});
    ViewFiles views;
    if (!command.scenes.empty()) {
        Session session(options.common);
        for (const std::string& scene : command.scenes) {
            const ViewTask task{.scene = scene,
                                .frame = command.frame,
                                .pipeline = {command.builder, command.collider}};
            views.add(view_of(session, task, options.words));
        }
    }
    std::vector<std::string> words = {"--out", command.out};
    if (options.common.force)
        words.push_back("--force");
    for (const std::string& path : views.paths())
        words.insert(words.end(), {"--view", path});
    words.push_back("--");
    words.insert(words.end(), command.files.begin(), command.files.end());
    return run_plots_script("report.py", words);
}

}  // namespace bvhbench
