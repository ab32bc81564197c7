// SPDX-License-Identifier: MIT
#include "harness/sweep/run.h"

#include <poll.h>

#include <algorithm>
#include <csignal>
#include <ctime>
#include <deque>
#include <memory>

#include "geometry/error.h"
#include "harness/interrupt.h"
#include "harness/provenance.h"
#include "harness/report.h"
#include "harness/result_file.h"
#include "harness/sweep/cell_process.h"
#include "harness/sweep/facts_worker.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

constexpr double look_ms = 500;   ///< how often signals are looked for that came at a bad moment
constexpr double patience_s = 5;  ///< for processes that were asked to end

/// What sets a unit's time apart, but for its scene.
std::string kind_of(const SweepUnit& unit)
{
    const std::string scene = unit.cells.front().scene_name();
    return unit.label.substr(scene.size());
}

double seconds_between(const std::string& started, const std::string& finished)
{
    const auto when = [](const std::string& text) {
        std::tm parts{};
        return strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) != nullptr ? timegm(&parts) : 0;
    };
    return std::difftime(when(finished), when(started));
}

class Runner {
public:
    Runner(const Sweep& sweep, const std::vector<SweepUnit>& units, const SweepFolder& folder,
           const SweepTask& task, const Options& options, const RunFacts& facts)
        : sweep_(sweep), folder_(folder), task_(task), options_(options), facts_(facts)
    {
        total_ = units.size();
        for (const SweepUnit& unit : units)
            if (!is_done(unit))
                waiting_.push_back(&unit);
        slots_.resize(task.devices.size());
    }

    void run()
    {
        while (!waiting_.empty() || is_any_running()) {
            if (is_interrupted()) {
                stop_all();
                break;
            }
            for (std::size_t i = 0; i < slots_.size(); ++i)
                if (slots_[i] == nullptr && !waiting_.empty())
                    start(i);
            wait_for_some();
        }
    }

private:
    using Slot = std::unique_ptr<CellProcess>;

    bool is_done(const SweepUnit& unit)
    {
        const auto file = folder_.done(unit);
        const auto document = file ? finished_document(*file) : std::nullopt;
        if (!document || (task_.retry_failed && has_failed(*document)))
            return false;
        // Files tell whole seconds.
        count(unit, *document,
              std::max(0.5, seconds_between(document->run.started_at, document->run.finished_at)));
        return true;
    }

    /// What a cell took that was not measured says nothing of others.
    void count(const SweepUnit& unit, const Document& document, double seconds)
    {
        ++done_;
        if (document.cells.front().status == Cell::Status::measured)
            left_.add(kind_of(unit), unit.triangles, seconds);
    }

    bool is_any_running() const
    {
        return std::any_of(slots_.begin(), slots_.end(),
                           [](const Slot& slot) { return slot != nullptr; });
    }

    void start(std::size_t i)
    {
        const SweepUnit& unit = *waiting_.front();
        waiting_.pop_front();
        slots_[i] =
            std::make_unique<CellProcess>(unit, folder_, options_, task_.costs, task_.devices[i]);
    }

    /// Until something has come from a process, or time limits are to be looked at.
    void wait_for_some()
    {
        std::vector<pollfd> readers;
        double patience_ms = look_ms;
        for (const Slot& slot : slots_) {
            readers.push_back({slot == nullptr ? -1 : slot->child().reader(), POLLIN, 0});
            if (slot != nullptr && task_.cell_limit_s > 0)
                patience_ms = std::min(patience_ms,
                                       1000 * std::max(0.0, task_.cell_limit_s - slot->seconds()));
        }
        if (poll(readers.data(), readers.size(), static_cast<int>(patience_ms) + 1) < 0)
            return;  // a signal
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            if (slots_[i] == nullptr)
                continue;
            if (readers[i].revents != 0 && !slots_[i]->child().take())
                conclude(i);
            else if (task_.cell_limit_s > 0 && slots_[i]->seconds() > task_.cell_limit_s)
                slots_[i]->give_up(task_.cell_limit_s);
        }
    }

    void conclude(std::size_t i)
    {
        const std::string device = task_.devices[i];
        CellProcess& process = *slots_[i];
        const SweepUnit& unit = process.unit();
        const double seconds = process.seconds();
        const CellProcess::Loss loss = process.end();
        slots_[i] = nullptr;
        if (loss.was_stopped && wait_for_interrupt())
            return;  // Ctrl-C reaches all processes at once, and them first
        if (!loss.why.empty()) {
            if (loss.may_be_the_device)
                require_device(device, loss.why);
            record_loss(unit, loss);
        }
        const auto document = finished_document(folder_.cell_file(unit));
        if (!document)
            throw Unavailable(folder_.cell_file(unit).string() + " is gone");
        count(unit, *document, seconds);
        tell(unit, *document, seconds);
    }

    static bool wait_for_interrupt()
    {
        for (int i = 0; i < 10 && !is_interrupted(); ++i)
            poll(nullptr, 0, 100);
        return is_interrupted();
    }

    /// Else every cell that is left would fail in its turn.
    void require_device(const std::string& device, const std::string& why)
    {
        try {
            facts_of_device(options_.common, device);
        } catch (const std::exception& error) {
            stop_all();
            if (is_interrupted())  // Ctrl-C reaches the process that was asked, too
                return;
            throw Unavailable("the device is gone after " + std::to_string(done_) + " of " +
                              std::to_string(total_) + " cells (" + why + "; " + error.what() +
                              "); they are kept, and the same command goes on");
        }
    }

    void record_loss(const SweepUnit& unit, const CellProcess::Loss& loss)
    {
        RunFacts facts = facts_;
        facts.finished_at = utc_now();
        std::vector<std::string> cells;
        for (const SweepCell& one : unit.cells) {
            Cell cell = record_of(sweep_, one);
            cell.status = loss.is_skipped ? Cell::Status::skipped : Cell::Status::failed;
            cell.reason = loss.why;
            cells.push_back(cell_text(cell));
        }
        write_atomically(folder_.cell_file(unit), document_text(run_text(facts), cells));
    }

    void tell(const SweepUnit& unit, const Document& document, double seconds)
    {
        std::string line =
            '[' + std::to_string(done_) + '/' + std::to_string(total_) + "] " + unit.label + ": ";
        const Cell& cell = document.cells.front();
        const std::string verdict = verdict_text(cell);
        if (document.cells.size() > 1)
            line += std::to_string(document.cells.size()) + " results";
        else
            line += verdict + (cell.reason.empty() ? "" : ": " + cell.reason);
        line += ", " + fixed(seconds, 1) + " s";
        if (done_ < total_ && left_.knows())
            line += "; about " + rough_time(seconds_left()) + " left";
        task_.tell(line);
    }

    double seconds_left() const
    {
        double seconds = 0;
        for (const SweepUnit* unit : waiting_)
            seconds += left_.seconds_of(kind_of(*unit), unit->triangles);
        for (const Slot& slot : slots_)
            if (slot != nullptr)
                seconds +=
                    std::max(0.0, left_.seconds_of(kind_of(slot->unit()), slot->unit().triangles) -
                                      slot->seconds());
        return seconds / static_cast<double>(slots_.size());
    }

    /// Asked first, so that they may leave a driver in order; their cells will be measured anew.
    void stop_all()
    {
        for (const Slot& slot : slots_)
            if (slot != nullptr)
                slot->child().send(SIGTERM);
        const auto now = [] { return std::chrono::steady_clock::now(); };
        const auto until = now() + std::chrono::duration<double>(patience_s);
        for (Slot& slot : slots_) {
            while (slot != nullptr && now() < until) {
                pollfd reader{slot->child().reader(), POLLIN, 0};
                if (poll(&reader, 1, 100) > 0 && !slot->child().take())
                    break;
            }
            slot = nullptr;  // which ends the rest
        }
    }

    const Sweep& sweep_;
    const SweepFolder& folder_;
    const SweepTask& task_;
    const Options& options_;
    const RunFacts& facts_;
    std::deque<const SweepUnit*> waiting_;
    std::vector<Slot> slots_;
    TimeLeft left_;
    std::size_t total_ = 0;  ///< units that are to be done
    std::size_t done_ = 0;   ///< of them
};

}  // namespace

void run_units(const Sweep& sweep, const std::vector<SweepUnit>& units, const SweepFolder& folder,
               const SweepTask& task, const Options& options, const RunFacts& facts)
{
    Runner(sweep, units, folder, task, options, facts).run();
}

}  // namespace bvhbench
