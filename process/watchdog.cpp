// SPDX-License-Identifier: MIT
#include "process/watchdog.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <memory>
#include <new>

#include "geometry/error.h"
#include "process/child.h"
#include "process/interrupt.h"

namespace bvhbench {
namespace {

constexpr long over = -1;

/// Memory shared by parent and child. The parent reads `until_ms` while the child runs, and the rest after it has ended.
struct SharedState {
    std::atomic<long> until_ms = 0;  ///< deadline, steady clock; 0: not watched; -1: expired
    std::array<char, 64> cell = {};
    std::array<char, 256> run = {};
    std::array<char, 4096> kernels = {};
    bool wants_another = false;  ///< whether the child asks for one that goes on
    bool ends_itself = false;    ///< whether abort was called by this program's own code
};
static_assert(std::atomic<long>::is_always_lock_free);

sigset_t unblocked;             // the signals as they were before supervised()
SharedState* shared = nullptr;  // nullptr: there is no parent
double limit_ms = 0;

// Run to continue and cells lost by earlier children. A child inherits copies from the parent.
std::string continued_run;
std::map<std::string, std::string> lost_cells;

template <std::size_t size>
void publish(std::array<char, size> SharedState::*place, const std::string& text)
{
    if (shared != nullptr)
        std::strncpy((shared->*place).data(), text.c_str(), size - 1);
}

long now_ms()
{
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

void* base_of(void* address)
{
    Dl_info object{};
    return dladdr(address, &object) != 0 ? object.dli_fbase : nullptr;
}

/// Handles SIGABRT: notes whether the caller of abort, the first frame beyond the C library's, is in this program or in a library
/// such as the OpenCL driver.
void note_who_aborts(int)
{
    std::array<void*, 64> frames{};
    const auto end = frames.begin() + backtrace(frames.data(), static_cast<int>(frames.size()));
    static void* const c_library = base_of(dlsym(RTLD_DEFAULT, "gnu_get_libc_version"));
    const auto is_c = [](void* frame) { return base_of(frame) == c_library; };
    const auto caller = std::find_if_not(std::find_if(frames.begin(), end, is_c), end, is_c);
    shared->ends_itself =
        caller != end && base_of(*caller) == base_of(reinterpret_cast<void*>(&note_who_aborts));
}

/// Returns how damaged kernels or too little address space can be why a process crashed by `signal`; empty if they cannot.
std::string possible_cause(int signal)
{
    if (signal == SIGABRT && shared->ends_itself)
        return {};
    rlimit space{};
    if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
        return "; the limit of address space (ulimit -v) can be why: raise it";
    if (shared->kernels[0] == '\0')
        return {};
    return std::string("; damaged kernels in the OpenCL driver's cache can be why: remove ") +
           shared->kernels.data();
}

struct Ending {
    ProcessEnd process;
    int signal = 0;     ///< signal passed on to the child; 0: none
    bool late = false;  ///< whether the child was killed at its deadline

    /// Returns the signal that ended the child; 0 if it exited.
    int ended_by() const { return process.how == ProcessEnd::How::signalled ? process.code : 0; }

    /// A kill by another process, such as the system that lacks memory, costs a cell, and ends what has none.
    bool is_loss(bool has_cell) const
    {
        const int by = ended_by();
        const bool crashed = by == SIGSEGV || by == SIGBUS || by == SIGILL || by == SIGABRT;
        return signal == 0 && (late || crashed || (by == SIGKILL && has_cell));
    }

    std::string reason() const
    {
        if (late) {
            const ProcessEnd end = {.how = ProcessEnd::How::timed_out};
            return spelled(end, limit_ms / 1000) + " and was ended; --time-limit gives it more";
        }
        if (ended_by() == SIGKILL)
            return "was killed (signal 9), as the system does that lacks memory";
        return spelled(process, 0) + possible_cause(ended_by());
    }
};

/// Waits for the child, kills it after its deadline and passes signals on to it. `awaited` must be blocked: it has SIGCHLD and
/// the signals to pass on.
Ending end_of(Child& child, const sigset_t& awaited)
{
    constexpr timespec moment = {0, 100'000'000};
    Ending end;
    for (;;) {
        if (const auto ended = child.end()) {
            end.process = *ended;
            return end;
        }
        long until = shared->until_ms;
        if (end.signal == 0 && until > 0 && now_ms() > until &&
            shared->until_ms.compare_exchange_strong(until, over)) {
            end.late = true;
            child.send(SIGKILL);
        }
        const int signal = sigtimedwait(&awaited, nullptr, &moment);
        if (signal > 0 && signal != SIGCHLD) {
            end.signal = signal;
            child.send(signal);
        }
    }
}

}  // namespace

int supervised(double limit_s, const std::function<int()>& work)
{
    if (limit_s <= 0) {
        end_on_signals();
        return work();
    }
    limit_ms = 1000 * limit_s;
    void* const memory = mmap(nullptr, sizeof(SharedState), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
        throw Unavailable("out of host memory: there is no room for another process");
    sigset_t awaited;
    sigemptyset(&awaited);
    sigaddset(&awaited, SIGCHLD);
    for (const int signal : ending_signals())
        sigaddset(&awaited, signal);
    std::signal(SIGCHLD, SIG_DFL);
    sigprocmask(SIG_BLOCK, &awaited, &unblocked);
    for (int held_back = 0;;) {
        shared = new (memory) SharedState;
        const std::unique_ptr<Child> child = Child::forked();
        if (child == nullptr) {
            std::signal(SIGABRT, note_who_aborts);
            end_on_signals();
            if (continued_run.empty())
                watchdog::let_signals_through();
            return work();
        }
        if (held_back != 0)
            child->send(held_back);
        const Ending end = end_of(*child, awaited);
        const int by = end.ended_by();
        if (shared->wants_another && by == 0 && end.process.code == 0) {
            continued_run = shared->run.data();
            held_back = end.signal;  // it came when the child was about to end
            continue;
        }
        if (by == 0)
            return end.process.code;
        const bool has_cell = shared->cell[0] != '\0' && shared->run[0] != '\0';
        if (!end.is_loss(has_cell)) {
            watchdog::let_signals_through();
            std::signal(by, SIG_DFL);
            raise(by);  // ends this process by the same signal
            return 128 + by;
        }
        if (!has_cell)
            throw Unavailable("what was to be done " + end.reason());
        continued_run = shared->run.data();
        lost_cells[shared->cell.data()] = end.reason();
    }
}

namespace watchdog {

const std::string& run_id() { return continued_run; }

std::string given_up(const std::string& cell)
{
    const auto found = lost_cells.find(cell);
    return found == lost_cells.end() ? std::string() : found->second;
}

void let_signals_through()
{
    if (shared != nullptr)
        sigprocmask(SIG_SETMASK, &unblocked, nullptr);
}

void resume_after_crash(const std::string& run_id)
{
    publish(&SharedState::run, run_id);
    let_signals_through();
}

bool can_begin_another() { return shared != nullptr; }

void begin_another()
{
    if (shared == nullptr)
        return;
    ignore_signals();
    shared->wants_another = true;
}

void kernels_are_in(const std::string& folder) { publish(&SharedState::kernels, folder); }

CellScope::CellScope(const std::string& cell)
    : around_(shared == nullptr ? "" : shared->cell.data())
{
    publish(&SharedState::cell, cell);
}

CellScope::~CellScope() { publish(&SharedState::cell, around_); }

Watch::Watch()
{
    if (shared == nullptr || shared->until_ms != 0)
        return;
    until_ = now_ms() + static_cast<long>(limit_ms);
    shared->until_ms = until_;
}

Watch::~Watch()
{
    long expected = until_;
    if (until_ != 0 && !shared->until_ms.compare_exchange_strong(expected, 0))
        for (;;)  // the deadline has just expired: waits until the parent kills this process
            pause();
}

}  // namespace watchdog
}  // namespace bvhbench
