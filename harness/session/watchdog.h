// SPDX-License-Identifier: MIT
//
// A kernel that never ends cannot be taken back, by no call of OpenCL 1.2, and a process that has used PoCL cannot be
// forked. So when a build or a query takes too long, or crashes, the program begins anew in its own place, by exec: the
// same process for who started it, with all that hung gone. What it must know of itself goes on in its environment
// (docs/decisions/0012).
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace bvhbench {

/// Watches single builds and queries from a thread of its own.
///
/// When one is not over in time, or anything crashes: if it is for a cell of a result, finished cells are kept, and the
/// program begins anew, gives up that cell and does the rest. Else the program ends, with a sentence and exit code 3.
class Watchdog {
public:
    /// 0 seconds: watches nothing, and a crash is a crash. Reads what was left for it in the environment. One that watches
    /// is there at a time: signals are the process's.
    explicit Watchdog(double limit_s);
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    /// The run that this process goes on with; empty if it begins one.
    const std::string& run_id() const { return run_id_; }

    /// Why `cell` was given up by a process before this one; empty if it was not.
    std::string given_up(const std::string& cell) const;

    /// What keeps finished cells, called while the thread that adds them hangs, and whose they are.
    void keep_by(std::string run_id, std::function<void()> keep);

    /// As long as this is there, what is done is done for `cell`.
    class Hand {
    public:
        Hand(Watchdog& dog, const std::string& cell) : dog_(dog) { dog_.cell_ = &cell; }
        ~Hand() { dog_.cell_ = nullptr; }
        Hand(const Hand&) = delete;
        Hand& operator=(const Hand&) = delete;

    private:
        Watchdog& dog_;
    };

    /// Runs `work`, one build or query, and watches it. Within another nothing is added.
    template <class Work>
    auto watch(Work&& work)
    {
        const Watch watch(*this);
        return work();
    }

private:
    class Watch {
    public:
        explicit Watch(Watchdog& dog);
        ~Watch();
        Watch(const Watch&) = delete;
        Watch& operator=(const Watch&) = delete;

    private:
        Watchdog& dog_;
        long until_ = 0;  ///< 0: this one does not watch
    };

    void look();
    static void crashed(int signal);
    [[noreturn]] void end(const std::string& why) const;

    double limit_s_;
    std::string run_id_;
    std::map<std::string, std::string> given_up_;
    std::string keeps_;  ///< the run whose cells `keep_` keeps
    std::function<void()> keep_;
    std::atomic<const std::string*> cell_ = nullptr;
    std::atomic<long> until_ =
        0;  ///< steady clock, milliseconds; 0: nothing is watched; -1: it is over
    std::mutex mutex_;
    std::condition_variable stop_;
    bool stops_ = false;
    std::thread thread_;
};

}  // namespace bvhbench
