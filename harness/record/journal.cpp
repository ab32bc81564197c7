// SPDX-License-Identifier: MIT
#include "harness/record/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <string_view>
#include <utility>

#include "geometry/error.h"

namespace bvhbench {
namespace {

MeasuredPart& part_called(Measured& measured, const std::string& key)
{
    const auto [place, is_new] = measured.parts.try_emplace(key);
    if (is_new)
        measured.order.push_back(key);
    return place->second;
}

void take(Measured& measured, const Json& line)
{
    if (line.contains("run")) {
        measured.runs.push_back(line["run"]);
        measured.last_run = line["run"];
        return;
    }
    MeasuredPart& part = part_called(measured, line.at("part"));
    if (line.contains("keeps")) {
        part.has_ended = false;
        part.cells.resize(std::min(line["keeps"].get<std::size_t>(), part.cells.size()));
    }
    if (line.contains("ended")) {
        part.has_ended = true;
        part.seconds = line["ended"].get<double>();
    }
    if (line.contains("cell")) {
        part.cells.push_back(line["cell"]);
        part.cells.back()["run"] = measured.runs.back().at("id");
    }
}

}  // namespace

std::size_t Measured::cell_count() const
{
    std::size_t count = 0;
    for (const auto& [key, part] : parts)
        count += part.cells.size();
    return count;
}

Measured measured_in(const std::filesystem::path& path)
{
    const Json json = Json::parse(file_text(path, "the result file"), nullptr, false);
    if (!json.is_object() || !json.contains("run") || !json.contains("cells"))
        throw BadUsage(path.string() + " is no result file");
    Measured measured;
    measured.last_run = json["run"];
    for (const Json& run : json.value("merged_from", Json::array({json["run"]})))
        measured.runs.push_back(run);
    const bool has_ended = json["run"].contains("finished_at");
    for (const Json& cell : json["cells"]) {
        if (cell.value("status", "") == "skipped" && !cell.contains("part"))
            continue;  // an impossible cell of the plan, which is written again
        if (!cell.contains("part"))
            throw BadUsage(path.string() +
                           " is a result, and its cells do not say of which part of a "
                           "plan they are; --force replaces it, or choose another file");
        MeasuredPart& part = part_called(measured, cell["part"]);
        part.has_ended = has_ended;
        part.cells.push_back(cell);
        if (!cell.contains("run"))
            part.cells.back()["run"] = json["run"].at("id");
    }
    return measured;
}

void add_journal(const std::filesystem::path& path, Measured& measured)
{
    std::istringstream text(file_text(path, "the journal"));
    bool has_run = false;
    for (std::string line; std::getline(text, line) && !text.eof();) {
        const Json json = Json::parse(line, nullptr, false);
        has_run = has_run || json.contains("run");
        if (!has_run || !(json.contains("run") || json.contains("part")))
            throw Unavailable(path.string() + " is no journal of a run; remove it to measure anew");
        take(measured, json);
    }
}

Journal::~Journal()
{
    if (file_ >= 0)
        close(file_);
}

void Journal::open(std::filesystem::path path)
{
    path_ = std::move(path);
    std::error_code none;
    if (std::filesystem::file_size(path_, none) > 0 &&
        !none) {  // a last line may have been cut off
        const std::string text = file_text(path_, "the journal");
        std::filesystem::resize_file(path_, text.rfind('\n') + 1);
    }
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0)
        throw Unavailable(path_.string() + " cannot be written: " + std::strerror(errno));
}

void Journal::append(const std::string& line)
{
    if (file_ < 0)
        return;
    const std::string text = line + '\n';
    for (std::string_view rest = text; !rest.empty();) {
        const ssize_t count = write(file_, rest.data(), rest.size());
        if (count < 0 && errno != EINTR)
            throw Unavailable(path_.string() + " cannot be written: " + std::strerror(errno));
        rest.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
    }
}

}  // namespace bvhbench
