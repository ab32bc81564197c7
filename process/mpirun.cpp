// SPDX-License-Identifier: MIT
#include "process/mpirun.h"

#include <poll.h>
#include <re2/re2.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "geometry/error.h"
#include "process/child.h"
#include "process/interrupt.h"
#include "process/mpirun_watch.h"

namespace bvhbench {
namespace {

constexpr std::string_view own_lines = "bvhbench: ";
constexpr std::chrono::seconds grace(5);  ///< in which mpirun ends the ranks after a signal

/// Returns true if a program of this name is in a folder of PATH.
bool is_program(const std::string& name)
{
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access((std::filesystem::path(folder) / name).c_str(), X_OK) == 0)
            return true;
    return false;
}

/// Throws Unavailable if the folder of Open MPI's session has too little room, with which mpirun waits for ever.
void require_session_room()
{
    constexpr std::uintmax_t needed = std::uintmax_t{16} << 20;  // 8 MiB are too few for two ranks
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    const auto room = error ? std::filesystem::space_info{} : std::filesystem::space(folder, error);
    if (!error && room.available < needed)
        throw Unavailable("mpirun keeps its session in '" + folder.string() +
                          "' (TMPDIR), which has room for " + std::to_string(room.available) +
                          " bytes, and " + std::to_string(needed) + " are needed");
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

/// Returns the first error that a rank wrote, without the program's name; empty without one. That a rank was stopped is mpirun's
/// doing.
std::string own_sentence(const std::string& text)
{
    for (const std::string& line : lines_of(text))
        if (line.starts_with(own_lines) && !line.starts_with("bvhbench: stopped"))
            return line.substr(own_lines.size());
    return {};
}

/// Returns "rank 1 on this host: ", of the rank that mpirun says ended first, if `sentence` names none.
std::string rank_before(const std::string& sentence, const std::string& text)
{
    std::string rank;
    if (sentence.starts_with("rank ") ||
        !RE2::PartialMatch(text, "Process name: \\[\\[\\d+,\\d+\\],(\\d+)\\]", &rank))
        return {};
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    return "rank " + rank + " on " + host.data() + ": ";
}

/// Reads what mpirun and the ranks write until all have ended, or until mpirun hangs.
MpirunWatch::State read_all(Child& child, MpirunWatch& watch)
{
    for (;;) {
        pollfd waiting{child.reader(), POLLIN, 0};
        if (poll(&waiting, 1, static_cast<int>(watch.pause().count())) > 0 && !child.take())
            return MpirunWatch::State::ranks_run;
        if (const auto state = watch.state(); state != MpirunWatch::State::ranks_run)
            return state;
    }
}

/// Throws what is to be said of an mpirun that hung, and that has been ended.
[[noreturn]] void say_hung(MpirunWatch::State state, const MpirunWatch& watch, unsigned ranks,
                           const std::string& text)
{
    std::ostringstream limit;
    limit << watch.limit_s() << " s";
    if (state == MpirunWatch::State::starts_too_few)
        throw Unavailable("mpirun started " + std::to_string(watch.started_ranks()) + " of " +
                          std::to_string(ranks) + " ranks within " + limit.str() +
                          ", and all were ended");
    const std::string said = own_sentence(text);
    throw NothingMeasured("mpirun or a rank ended, the others did not within " + limit.str() +
                          ", and all were ended" +
                          (said.empty() ? "" : "; it said: " + rank_before(said, text) + said));
}

/// Returns which rank a signal ended, as a sentence; empty if none.
std::string lost_rank(const std::string& text)
{
    std::string rank, host, signal, name;
    if (!RE2::PartialMatch(text,
                           "process rank (\\d+) with PID \\d+ on node (\\S+) exited on signal "
                           "(\\d+) \\(([^)]*)\\)",
                           &rank, &host, &signal, &name))
        return {};
    const std::string said = own_sentence(text);
    return "rank " + rank + " on " + host + " was ended by signal " + signal + " (" + name +
           "), and so were the others" + (said.empty() ? "" : "; it said: " + said);
}

}  // namespace

std::optional<unsigned> ranks_started()
{
    // Open MPI's mpirun, MPICH's and Slurm's PMI-2, and Slurm's PMIx, which has no variable of its own for the number.
    const bool is_slurm = std::getenv("PMIX_RANK") != nullptr;
    for (const char* variable :
         {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", is_slurm ? "SLURM_NTASKS" : ""})
        if (const char* value = std::getenv(variable); value != nullptr) {
            const std::string_view text = value;
            unsigned count = 0;
            std::from_chars(text.data(), text.data() + text.size(), count);
            return count;
        }
    return std::nullopt;
}

RanksEnd run_ranks(unsigned ranks, const std::vector<std::string>& words, std::size_t columns,
                   double time_limit_s)
{
    if (!is_program("mpirun"))
        throw Unavailable(
            "mpirun, which starts the ranks, is in no folder of PATH (Debian: openmpi-bin)");
    require_session_room();
    std::vector<std::string> command = {"setpriv",
                                        "--pdeathsig",
                                        "TERM",
                                        "mpirun",
                                        "-np",
                                        std::to_string(ranks),
                                        "--oversubscribe",
                                        "--bind-to",
                                        "none",
                                        std::filesystem::read_symlink("/proc/self/exe").string()};
    command.insert(command.end(), words.begin(), words.end());
    const ProcessFamily family;
    std::cout.flush();
    std::optional<Child> child;
    const Child::Start start = {
        .path = command.front(),
        .words = command,
        .environment = {family.variable(),
                        // mpirun gives rank 0 a terminal of its own, of 80 columns.
                        "COLUMNS=" + std::to_string(columns), "OMPI_ALLOW_RUN_AS_ROOT=1",
                        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                        "OMPI_MCA_btl_vader_single_copy_mechanism=none"},
        .output = Child::Stream::inherited,
        .errors = Child::Stream::captured};
    // mpirun can be deaf to the signal that setpriv sends it when this process ends.
    const AtSignal stop([&] { child.emplace(start); },
                        [&] {
                            child->send(SIGTERM);
                            family.end(grace);
                        });
    MpirunWatch watch(child->process(), family, ranks, time_limit_s);
    const auto state = read_all(*child, watch);
    if (state != MpirunWatch::State::ranks_run)
        family.end({});
    const ProcessEnd end = child->wait();
    if (state != MpirunWatch::State::ranks_run)
        say_hung(state, watch, ranks, end.output);
    const bool has_exited = end.how == ProcessEnd::How::exited;
    if (has_exited && end.code == 0) {
        std::cerr << end.output;
        return {};
    }
    if (const std::string lost = lost_rank(end.output); !lost.empty())
        throw NothingMeasured(lost);
    if (const std::string said = own_sentence(end.output); !said.empty() && has_exited) {
        const bool is_of_rank = end.code != 2;  // which is wrong usage
        return {end.code, (is_of_rank ? rank_before(said, end.output) : "") + said};
    }
    if (has_exited && RE2::PartialMatch(end.output, "Exit code:\\s+" + std::to_string(end.code)))
        return {end.code};          // a rank said why in its table
    constexpr int by_signal = 128;  // and more, by the signal
    if (has_exited && end.code > by_signal && end.code < by_signal + NSIG) {
        // A rank that was lost while it started: mpirun then sometimes says no more.
        const int signal = end.code - by_signal;
        throw NothingMeasured("a rank was ended by signal " + std::to_string(signal) + " (" +
                              strsignal(signal) +
                              "), and so were the others; mpirun does not say which");
    }
    std::string first;
    RE2::PartialMatch(end.output, "(?m)^([^-\\s][^\\n]*)$", &first);
    throw Unavailable("mpirun " + spelled(end, 0) + (first.empty() ? "" : ": " + first));
}

}  // namespace bvhbench
