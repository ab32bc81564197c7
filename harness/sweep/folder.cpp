// SPDX-License-Identifier: MIT
#include "harness/sweep/folder.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/json_reason.h"
#include "harness/result_file.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

constexpr int plan_format = 1;

/// Longer than a shard looks at the plan, and than the system takes to end a process that was killed.
constexpr std::chrono::seconds patience{5};

std::optional<std::string> text_of(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file.is_open())
        return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(file), {});
}

std::optional<Json> plan_in(const fs::path& path)
{
    const std::optional<std::string> text = text_of(path);
    if (!text)
        return std::nullopt;
    try {
        Json plan = Json::parse(*text);
        if (plan.at("format") != plan_format)
            throw Unavailable(path.string() + " is of a newer program");
        return plan;
    } catch (const Json::exception& error) {
        throw Unavailable(path.string() + " is no plan of a sweep: " + json_reason(error));
    }
}

/// The hash of this program's own bytes: two programs with changes that are in no commit may have one name.
std::string own_bytes()
{
    const std::optional<std::string> bytes = text_of("/proc/self/exe");
    Hash hash;
    if (bytes)
        hash.bytes(bytes->data(), bytes->size());
    return hex(hash.get());
}

/// Of processes that were killed while they wrote.
void remove_leftovers(const fs::path& folder)
{
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (entry->path().filename().string().find(".json.tmp") != std::string::npos)
            fs::remove(entry->path(), error);
}

}  // namespace

std::string program_words(const RunFacts& facts)
{
    std::string words = "commit " + facts.commit.substr(0, 10);
    if (facts.dirty || facts.commit == "unknown")
        words += " with changes (" + own_bytes() + ")";
    return words + ", " + facts.version + ' ' + facts.build_type + ' ' + facts.compiler + ' ' +
           facts.arch + (facts.kernels == "embedded" ? "" : ", kernels of " + facts.kernels);
}

std::string device_words(const RunFacts& facts)
{
    std::string words =
        facts.device.platform + '/' + facts.device.name + ", driver " + facts.device.driver;
    for (const auto& [parameter, value] : facts.tuning)
        words += ", " + parameter + '=' + std::to_string(value);
    return words;
}

SweepFolder::SweepFolder(fs::path folder, const Sweep& sweep, bool together,
                         const std::vector<SweepUnit>& units, const Shard& shard,
                         const RunFacts& facts, bool keeps_other_commit)
    : folder_(std::move(folder)), device_(device_words(facts)), programs_{program_words(facts)}
{
    const std::string part = std::to_string(shard.number) + "of" + std::to_string(shard.of);
    result_ = folder_ / (sweep.name + (shard.is_all() ? "" : '-' + part) + ".json");
    std::error_code error;
    for (const char* inside : {"cells", "experiments"})
        if (fs::create_directories(folder_ / inside, error); error)
            throw Unavailable((folder_ / inside).string() + " cannot be made: " + error.message());
    // Shards work beside each other, a whole sweep alone; whoever looks at the plan and writes it does so alone.
    const std::string subject = "the sweep in " + folder_.string();
    lock_.emplace(folder_ / "lock",
                  shard.is_all() ? FileLock::Kind::exclusive : FileLock::Kind::shared, subject,
                  patience);
    const FileLock planning(folder_ / "lock-plan", FileLock::Kind::exclusive, subject, patience);
    if (!shard.is_all())
        shard_lock_.emplace(folder_ / ("lock-" + part), FileLock::Kind::exclusive, subject,
                            patience);
    const fs::path plan_file = folder_ / "plan.json";
    const std::optional<Json> plan = plan_in(plan_file);
    if (plan)
        check_plan(*plan, units, keeps_other_commit);
    else if (fs::exists(result_))
        throw BadUsage(result_.string() +
                       " is there and no sweep's: choose another --out or --name");
    Json now = plan_of(sweep, units);
    now["together"] = together ? "scene" : "cell";
    write_atomically(plan_file, now.dump(1) + '\n');
    if (shard.is_all())
        remove_leftovers(folder_ / "cells");
}

Json SweepFolder::plan_of(const Sweep& sweep, const std::vector<SweepUnit>& units) const
{
    Json whats = Json::array();
    for (const SweepUnit& unit : units)
        whats.push_back(hex(unit.what));
    return {{"format", plan_format}, {"sweep", sweep.name},   {"product", sweep.product},
            {"device", device_},     {"programs", programs_}, {"units", whats}};
}

void SweepFolder::check_plan(const Json& plan, const std::vector<SweepUnit>& units,
                             bool keeps_other_commit)
{
    std::set<std::string> whats;
    for (const SweepUnit& unit : units)
        whats.insert(hex(unit.what));
    const auto earlier = plan.at("units").get<std::vector<std::string>>();
    const auto missing = std::count_if(earlier.begin(), earlier.end(),
                                       [&](const auto& what) { return !whats.contains(what); });
    if (missing > 0)
        throw BadUsage(folder_.string() + " holds another sweep, '" + text_at(plan, "sweep") +
                       "' of " + text_at(plan, "product") + ": " + std::to_string(missing) +
                       " of the " + counted(earlier.size(), "cell") +
                       " that it measures are none of these; choose another --out");
    const std::string device = text_at(plan, "device");
    if (device != device_)
        throw BadUsage(folder_.string() + " holds a sweep on " + device + ", and this is " +
                       device_ + "; choose another --out, and merge --other-devices");
    for (const Json& words : plan.at("programs")) {
        const auto program = words.get<std::string>();
        if (program == programs_.front())
            continue;
        std::size_t there = 0;
        std::string other_format;
        for (const SweepUnit& unit : units) {
            const auto document = finished_document(cell_file(unit, program));
            there += document ? 1 : 0;
            if (document && document->minor != newest_minor)
                other_format = "1." + std::to_string(document->minor);
        }
        if (there == 0)
            continue;
        const std::string by = counted(there, "cell") + " by " + program;
        if (!keeps_other_commit)
            throw BadUsage(folder_.string() + " holds " + by + ", and this program is of " +
                           programs_.front() +
                           "; --continue-other-commit keeps them and goes on, or choose another "
                           "--out");
        if (!other_format.empty())
            throw BadUsage(folder_.string() + " holds " + by + " in format " + other_format +
                           ", and this program writes " + result_format +
                           ", which are not merged; choose another --out");
        programs_.push_back(program);
        note_ += (note_.empty() ? "kept: " : "\nkept: ") + by + "; the others are measured by " +
                 programs_.front();
    }
}

std::string SweepFolder::id(const SweepUnit& unit, const std::string& program) const
{
    Hash hash;
    hash.value(unit.what);
    for (const std::string& part : {program, device_})
        hash.bytes(part.c_str(), part.size() + 1);
    return hex(hash.get());
}

fs::path SweepFolder::cell_file(const SweepUnit& unit, const std::string& program) const
{
    return folder_ / "cells" / (id(unit, program) + ".json");
}

fs::path SweepFolder::cell_file(const SweepUnit& unit) const
{
    return cell_file(unit, programs_.front());
}

fs::path SweepFolder::experiment_file(const SweepUnit& unit) const
{
    return folder_ / "experiments" / (id(unit, programs_.front()) + ".json");
}

std::optional<Document> finished_document(const fs::path& file)
{
    const std::optional<std::string> text = text_of(file);
    if (!text)
        return std::nullopt;
    Document document = read_document(*text, file.string());
    if (document.run.finished_at.empty() || document.cells.empty())
        return std::nullopt;
    return document;
}

bool has_failed(const Document& document)
{
    return std::any_of(document.cells.begin(), document.cells.end(),
                       [](const Cell& cell) { return cell.status == Cell::Status::failed; });
}

std::optional<fs::path> SweepFolder::done(const SweepUnit& unit) const
{
    for (const std::string& program : programs_)
        if (const fs::path file = cell_file(unit, program); finished_document(file))
            return file;
    return std::nullopt;
}

void SweepFolder::begin(const SweepUnit& unit) const
{
    const fs::path file = cell_file(unit);
    std::error_code ignored;
    fs::remove(file, ignored);
    write_atomically(experiment_file(unit), unit.experiment.dump(1) + '\n');
}

}  // namespace bvhbench
