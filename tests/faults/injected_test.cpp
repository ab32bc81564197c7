// SPDX-License-Identifier: MIT
//
// Runs the program's commands repeatedly in one process, each time with another OpenCL call failing. The shim is linked before
// the loader, so that it receives every OpenCL call of the program.
//
// By default the first call of every sixteenth call path fails, and for every fifth of these also all calls that follow. With
// BVHBENCH_FAULTS=calls, every call fails, alone and with all that follow.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <sstream>

#include "device/device.h"
#include "harness/base/json_keys.h"
#include "harness/commands/command.h"
#include "tests/faults/opencl_shim.h"
#include "tests/folder.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

/// Captures standard output or error during its lifetime.
class Caught {
public:
    explicit Caught(std::ostream& stream) : stream_(stream), before_(stream.rdbuf(text_.rdbuf())) {}
    ~Caught() { stream_.rdbuf(before_); }
    Caught(const Caught&) = delete;
    Caught& operator=(const Caught&) = delete;
    std::string text() const { return text_.str(); }

private:
    std::ostream& stream_;
    std::ostringstream text_;
    std::streambuf* before_;
};

struct Outcome {
    int code;
    std::string out, error;
};

/// Placeholders for a memory limit: this much more than the process has when a run begins. The smaller one leaves no room for
/// the copy rate, the slowest measurement, whose buffers take 128 MiB. The kernels of a collision need the larger one.
constexpr const char* room_to_build = "124 MiB";
constexpr const char* room_to_collide = "256 MiB";

std::size_t bytes_in_memory()
{
    static const Device loaded = open_device("");  // keeps the driver and its compiler loaded
    std::size_t all = 0, pages = 0;
    std::ifstream("/proc/self/statm") >> all >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

class Injected : public testing::Test {
protected:
    void TearDown() override { setenv("BVHBENCH_COPY_BYTES", copied_.c_str(), 1); }

    /// Finds the copy rate over small buffers in this test. The calls that find it over large ones fail in that of a build.
    static void copy_little() { setenv("BVHBENCH_COPY_BYTES", "1048576", 1); }

    Outcome run(std::vector<std::string> words, shim::Plan plan) const
    {
        fs::remove(file_);
        words.insert(words.begin(), {"bvhbench", "--time-limit", "0",  // a crash must end the test
                                     "--quiet"});
        for (std::string& word : words)
            if (word == room_to_build || word == room_to_collide)
                word = std::to_string(bytes_in_memory() + (std::stoul(word) << 20));
        std::vector<const char*> argv;
        for (const std::string& word : words)
            argv.push_back(word.c_str());
        const Caught out(std::cout);
        const Caught error(std::cerr);
        shim::begin(plan);
        const int code = run_program(static_cast<int>(argv.size()), argv.data());
        return {code, out.text(), error.text()};
    }

    Json document() const
    {
        std::ifstream file(file_);
        return Json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
    }

    /// Makes every chosen call of the run fail in turn, alone and with all calls that follow.
    void fail_calls_of(const std::vector<std::string>& words, std::size_t cells);

private:
    void expect_clean(const Outcome& outcome, const shim::Plan& plan, std::size_t cells) const;

    std::set<std::uint64_t> tried_;  ///< call paths tried in this test
    const std::string copied_ =
        std::getenv("BVHBENCH_COPY_BYTES") ? std::getenv("BVHBENCH_COPY_BYTES") : "";

protected:
    const Folder made_;
    const fs::path folder_ = made_.path(), file_ = folder_ / "r.json";
};

void Injected::expect_clean(const Outcome& outcome, const shim::Plan& plan, std::size_t cells) const
{
    SCOPED_TRACE("call " + std::to_string(plan.nth) +
                 (plan.from_there_on ? " and all that follow, " : ", ") + shim::failed_call() +
                 ": " + outcome.error);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 3 || outcome.code == 4) << outcome.code;
    if (outcome.code != 0) {
        EXPECT_EQ(outcome.error.rfind("bvhbench: ", 0), 0u);
        EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1);
    }
    EXPECT_EQ(shim::leaked(), std::vector<std::string>());
    EXPECT_EQ(shim::misused(), std::vector<std::string>());
    if (!fs::exists(file_)) {
        EXPECT_EQ(outcome.code, 3);
        return;
    }
    const Json result = document();
    EXPECT_LE(result["cells"].size(), cells);
    for (const Json& cell : result["cells"]) {
        if (cell["status"] == "measured")
            EXPECT_TRUE(cell["check"]["verdict"] == "agrees" ||
                        (cell["check"]["verdict"] == "not_checked" &&
                         cell["check"]["detail"].get<std::string>().find("the reference failed") !=
                             std::string::npos))
                << cell["check"];
        else
            EXPECT_NE(cell["reason"], "");
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "a temporary file was left";
}

void Injected::fail_calls_of(const std::vector<std::string>& words, std::size_t cells)
{
    const Outcome whole = run(words, {});
    ASSERT_EQ(whole.code, 0) << whole.error;
    ASSERT_EQ(document()["cells"].size(), cells);
    ASSERT_EQ(shim::leaked(), std::vector<std::string>());
    shim::remember_calls(true);
    run(words, {});
    shim::remember_calls(false);
    std::map<int, int> ends;
    int number = 0;
    for (const long nth : shim::chosen_calls(tried_, 0, 16))
        for (const bool from_there_on : {false, true}) {
            if (from_there_on && !shim::every_call_fails() && number++ % 5 != 0)
                continue;
            const shim::Plan plan{nth, from_there_on};
            const Outcome outcome = run(words, plan);
            expect_clean(outcome, plan, cells);
            ++ends[outcome.code];
            if (HasFailure() && !shim::every_call_fails())
                return;  // one failure is enough
        }
    for (const auto& [code, times] : ends)
        std::cout << "exit code " << code << ": " << times << " times\n";
    EXPECT_GT(ends[3], 0);
    const Outcome again = run(words, {});
    EXPECT_EQ(again.code, 0) << again.error;
}

/// Limits memory, so that a call that asks for more than there is fails as well; not under the address sanitizer, which takes memory
/// of its own.
std::vector<std::string> limit([[maybe_unused]] const char* room)
{
#ifdef __SANITIZE_ADDRESS__
    return {};
#else
    return {"--memory-limit", room};
#endif
}

std::vector<std::string> operator+(std::vector<std::string> words,
                                   const std::vector<std::string>& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST_F(Injected, ABuildEndsCleanlyWhicheverCallFails)
{
    const std::vector<std::string> build = {"build",   "--builder", "oibvh-multi",
                                            "--scene", "soup:70",   "--samples",
                                            "1",       "--json",    file_.string()};
    ASSERT_EQ(run(build, {}).code, 0);  // compiles the kernels; later runs lack the room for it
    fail_calls_of(build + limit(room_to_build), 1);
    if (!limit(room_to_build).empty())
        fail_calls_of(build, 1);  // skips the call paths tried above
}

TEST_F(Injected, ACollisionEndsCleanlyWhicheverCallFails)
{
    copy_little();
    const std::vector<std::string> collide = {
        "collide",  "--collider", "leaf",      "--scene", "bend:soup:60", "--frames",    "0:2",
        "--narrow", "exact",      "--samples", "1",       "--json",       file_.string()};
    fail_calls_of(collide + limit(room_to_collide), 2);
}

TEST_F(Injected, FinishedCellsAreKeptAndTheOthersAreDone)
{
    copy_little();
    const fs::path plan = folder_.string() + ".plan.json";
    std::ofstream(plan)
        << R"({"experiment": "faults", "scenes": ["soup:9", "soup:30"], "samples": 1, "warm_up": 0,
                               "builders": ["oibvh-multi", "karras", "median-split"]})";
    const std::vector<std::string> words =
        std::vector<std::string>{"run", plan.string(), "--out", file_.string()} +
        limit(room_to_collide);
    run(words, {});
    const long calls = shim::calls();
    std::size_t kept = 0;
    for (int part = 1; part < 20; ++part) {
        const shim::Plan one{calls * part / 20, false};
        const Outcome outcome = run(words, one);
        SCOPED_TRACE("call " + std::to_string(one.nth) + ", " + shim::failed_call() + ": " +
                     outcome.error);
        if (outcome.code != 0) {  // failed before the first cell
            EXPECT_EQ(outcome.code, 3);
            EXPECT_EQ(kept, 0u);
            continue;
        }
        const Json result = document();
        EXPECT_EQ(result["cells"].size(), 6u);
        EXPECT_TRUE(result["run"].contains("finished_at"));
        const auto measured =
            std::count_if(result["cells"].begin(), result["cells"].end(), [](const Json& cell) {
                return cell["status"] == "measured" && cell["check"]["verdict"] == "agrees";
            });
        EXPECT_GE(measured, 3);  // at most one scene is missing, if its upload fails
        ++kept;
    }
    EXPECT_GT(kept, 10u);
    fs::remove(plan);
}

}  // namespace
}  // namespace bvhbench
