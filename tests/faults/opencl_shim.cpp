// SPDX-License-Identifier: MIT
#include "tests/faults/opencl_shim.h"

#define CL_TARGET_OPENCL_VERSION 300
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <time.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace bvhbench::shim {

namespace {

struct Object {
    const char* made_by;
    const char* release;  ///< name of the function that releases it
    long count = 1;
    long refused = 0;  ///< number of releases that were made to fail
};

/// State of the shim. The mutex is needed because calls may come from several threads.
struct State {
    std::mutex mutex;
    Plan plan;
    long calls = 0;
    std::string failed;
    bool remembers = false;
    int depth_of_begin = 0;
    std::vector<std::uint64_t> ways;  ///< hash of the call path of each call
    std::map<void*, Object> objects;
    std::vector<std::string> misused;
};

/// Reads the plan of a preloaded shim: BVHBENCH_FAIL_CALL=17 makes the 17th call fail, 17+ all from the 17th on.
Plan plan_of_environment()
{
    const char* text = std::getenv("BVHBENCH_FAIL_CALL");
    if (text == nullptr)
        return {};
    char* end = nullptr;
    const long nth = std::strtol(text, &end, 10);
    return {nth, *end == '+'};
}

/// Returns the state. It is never destroyed, because drivers may call after the destruction of statics.
State& state()
{
    static State& one = *[] {
        auto* made = new State;
        made->plan = plan_of_environment();
        return made;
    }();
    return one;
}

constexpr int deepest = 64;

/// Returns a hash of the call path below begin(); the callers of begin() are the same for all calls.
std::uint64_t stack_hash()
{
    void* frames[deepest];
    const int depth = backtrace(frames, deepest);
    std::uint64_t hash = 1469598103934665603u;
    for (int i = 1; i < depth - state().depth_of_begin; ++i)
        hash = (hash ^ reinterpret_cast<std::uintptr_t>(frames[i])) * 1099511628211u;
    return hash;
}

/// Counts this call and returns true if it is to fail.
bool fails(const char* name, const char* error)
{
    State& now = state();
    const std::lock_guard lock(now.mutex);
    ++now.calls;
    if (now.remembers)
        now.ways.push_back(stack_hash());
    const bool is_hit = now.plan.nth > 0 && (now.plan.from_there_on ? now.calls >= now.plan.nth
                                                                    : now.calls == now.plan.nth);
    if (is_hit && now.failed.empty())
        now.failed = std::string(name) + " " + error;
    return is_hit;
}

/// Adds `more` to the owners of an object. A refused release is only noted. False if the object does not exist.
bool counted(void* object, int more, bool is_refused, const char* call)
{
    State& now = state();
    const std::lock_guard lock(now.mutex);
    const auto found = now.objects.find(object);
    if (found == now.objects.end()) {
        now.misused.push_back(std::string(call) + " of what is not there");
        return false;
    }
    if (is_refused)
        found->second.refused += more < 0;
    else if ((found->second.count += more) == 0)
        now.objects.erase(found);
    return true;
}

/// Returns the loader's function of this name.
template <class Function>
Function* loaders(const char* name)
{
    // Opened by name, since the linker drops the loader from a test whose calls are all defined here.
    static void* const loader = dlopen("libOpenCL.so.1", RTLD_NOW);
    void* found = loader != nullptr ? dlsym(loader, name) : nullptr;
    if (found == nullptr) {
        std::fprintf(stderr, "opencl_shim: the loader has no %s\n", name);
        std::abort();
    }
    return reinterpret_cast<Function*>(found);
}

void made(void* object, const char* by, const char* release)
{
    const std::lock_guard lock(state().mutex);
    state().objects[object] = {by, release};
}

constexpr const char* release_of(cl_command_queue) { return "clReleaseCommandQueue"; }
constexpr const char* release_of(cl_context) { return "clReleaseContext"; }
constexpr const char* release_of(cl_event) { return "clReleaseEvent"; }
constexpr const char* release_of(cl_kernel) { return "clReleaseKernel"; }
constexpr const char* release_of(cl_mem) { return "clReleaseMemObject"; }
constexpr const char* release_of(cl_program) { return "clReleaseProgram"; }

/// Replaces a function that returns a status, or that creates an object or mapping and writes the status to its last argument.
/// Tracks the created object and the event, if there is one.
template <class Call, class Function>
struct Any;

template <class Call, class Result, class... Arguments>
struct Any<Call, Result(Arguments...)> {
    static Result call(Arguments... arguments)
    {
        static auto* const real = loaders<Result(Arguments...)>(Call::name);
        constexpr bool gives_status = std::is_same_v<Result, cl_int>;
        [[maybe_unused]] const std::tuple all(arguments...);
        if (fails(Call::name, Call::error_name)) {
            if constexpr (gives_status) {
                return Call::error;
            } else {
                if (cl_int* const status = std::get<sizeof...(Arguments) - 1>(all))
                    *status = Call::error;
                return nullptr;
            }
        }
        const Result result = real(arguments...);
        const bool went_well = gives_status ? result == Result(CL_SUCCESS) : result != Result{};
        if constexpr (requires { release_of(result); })
            if (went_well)
                made(result, Call::name, release_of(result));
        if constexpr ((std::is_same_v<Arguments, cl_event*> || ...))
            if (cl_event* const event = std::get<cl_event*>(all); went_well && event != nullptr)
                made(*event, Call::name, release_of(*event));
        return result;
    }
};

/// Replaces a function that retains or releases an object. The driver is not called for an object that does not exist.
template <class Call, class Function>
struct Count;

template <class Call, class Handle>
struct Count<Call, cl_int(Handle)> {
    static cl_int call(Handle object)
    {
        static auto* const real = loaders<cl_int(Handle)>(Call::name);
        constexpr int more = std::string_view(Call::name).starts_with("clRetain") ? 1 : -1;
        const bool is_refused = fails(Call::name, Call::error_name);
        const bool is_there = counted(object, more, is_refused, Call::name);
        return is_refused || !is_there ? Call::error : real(object);
    }
};

/// Returns the clock that BVHBENCH_BAD_CLOCK makes wrong: of the device `zero`, `back` (each launch ends before it begins), `some`
/// (one in seven does), `huge` or `slow` (a thousandth of the time passes), or that of the `host`, which steps back by a second at
/// each look, or if `jumps` at one in fifty; or if `stalls` goes on by two at one in three, as if the program had been stopped.
std::string_view bad_clock()
{
    static const char* const kind = std::getenv("BVHBENCH_BAD_CLOCK");
    return kind != nullptr ? kind : "";
}

/// Replaces the function that tells when a command began and ended.
template <class Call, class Function>
struct Times;

template <class Call>
struct Times<Call, cl_int(cl_event, cl_profiling_info, std::size_t, void*, std::size_t*)> {
    static cl_int call(cl_event event, cl_profiling_info what, std::size_t size, void* value,
                       std::size_t* needed)
    {
        const cl_int status =
            Any<Call, decltype(::clGetEventProfilingInfo)>::call(event, what, size, value, needed);
        if (status == CL_SUCCESS && value != nullptr && !bad_clock().empty())
            spoil(what, *static_cast<cl_ulong*>(value));
        return status;
    }

    static void spoil(cl_profiling_info what, cl_ulong& time)
    {
        static std::atomic<unsigned> ends = 0;
        constexpr cl_ulong step = 50'000'000;
        const std::string_view kind = bad_clock();
        if (kind == "zero")
            time = 0;
        else if (kind == "slow")
            time = step + time / 1000;
        else if (what == CL_PROFILING_COMMAND_END && kind == "huge")
            time = cl_ulong{1} << 63;
        else if (what == CL_PROFILING_COMMAND_END &&
                 (kind == "back" || (kind == "some" && ++ends % 7 == 0)))
            time -= step;
    }
};

}  // namespace

void begin(Plan plan)
{
    State& now = state();
    // Leftover objects are released, so that ten thousand runs with failed releases do not fill the memory.
    for (const auto& [object, entry] : now.objects)
        for (long i = 0; i < entry.count; ++i)
            loaders<cl_int(void*)>(entry.release)(object);
    void* frames[deepest];
    now.depth_of_begin = backtrace(frames, deepest) - 1;
    now.plan = plan;
    now.calls = 0;
    now.failed.clear();
    now.ways.clear();
    now.objects.clear();
    now.misused.clear();
}

long calls() { return state().calls; }
std::string failed_call() { return state().failed; }
void remember_calls(bool wanted) { state().remembers = wanted; }
const std::vector<std::string>& misused() { return state().misused; }

bool every_call_fails()
{
    const char* faults = std::getenv("BVHBENCH_FAULTS");
    return faults != nullptr && std::string_view(faults) == "calls";
}

std::vector<long> chosen_calls(std::set<std::uint64_t>& tried, long behind, std::size_t share)
{
    const std::vector<std::uint64_t>& ways = state().ways;
    std::set<std::uint64_t> added;
    std::vector<long> chosen;
    for (std::size_t call = static_cast<std::size_t>(behind); call < ways.size(); ++call) {
        const bool is_new = tried.insert(ways[call]).second;
        if (is_new)
            added.insert(ways[call]);
        if (every_call_fails() ? added.contains(ways[call]) : is_new && tried.size() % share == 0)
            chosen.push_back(static_cast<long>(call) + 1);
    }
    std::printf("%zu calls, %zu of them fail\n", ways.size(), chosen.size());
    return chosen;
}

std::vector<std::string> leaked()
{
    std::vector<std::string> names;
    for (const auto& [object, entry] : state().objects)
        if (entry.count > entry.refused)
            names.push_back(std::string(entry.made_by) + " + " +
                            std::to_string(entry.count - entry.refused));
    return names;
}

/// Defines an OpenCL function as an indirect function: its signature comes from the header, and the dynamic linker asks once
/// which template instance implements it.
#define STAND_BEFORE(function, kind, failure)                      \
    struct function##_call {                                       \
        static constexpr const char* name = #function;             \
        static constexpr const char* error_name = #failure;        \
        static constexpr cl_int error = failure;                   \
    };                                                             \
    extern "C" decltype(&::function) resolve_##function()          \
    {                                                              \
        return &kind<function##_call, decltype(::function)>::call; \
    }                                                              \
    extern "C" __attribute__((ifunc("resolve_" #function))) decltype(::function) function;

#define STAND_BEFORE_COUNTS(what)                            \
    STAND_BEFORE(clRetain##what, Count, CL_OUT_OF_RESOURCES) \
    STAND_BEFORE(clRelease##what, Count, CL_OUT_OF_RESOURCES)

// clang-format off
STAND_BEFORE_COUNTS(CommandQueue)
STAND_BEFORE_COUNTS(Context)
STAND_BEFORE_COUNTS(Event)
STAND_BEFORE_COUNTS(Kernel)
STAND_BEFORE_COUNTS(MemObject)
STAND_BEFORE_COUNTS(Program)
// Root devices are not reference-counted, so they are not tracked.
STAND_BEFORE(clRetainDevice, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clReleaseDevice, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetPlatformIDs, Any, CL_OUT_OF_HOST_MEMORY)
STAND_BEFORE(clGetPlatformInfo, Any, CL_OUT_OF_HOST_MEMORY)
STAND_BEFORE(clGetDeviceIDs, Any, CL_DEVICE_NOT_FOUND)
STAND_BEFORE(clGetDeviceInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetContextInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetCommandQueueInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetMemObjectInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetProgramInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetProgramBuildInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetKernelInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetKernelWorkGroupInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetEventInfo, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clGetEventProfilingInfo, Times, CL_PROFILING_INFO_NOT_AVAILABLE)
STAND_BEFORE(clBuildProgram, Any, CL_OUT_OF_HOST_MEMORY)
STAND_BEFORE(clSetKernelArg, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clFlush, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clFinish, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clWaitForEvents, Any, CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST)
STAND_BEFORE(clCreateContext, Any, CL_DEVICE_NOT_AVAILABLE)
STAND_BEFORE(clCreateCommandQueue, Any, CL_OUT_OF_HOST_MEMORY)
STAND_BEFORE(clCreateBuffer, Any, CL_MEM_OBJECT_ALLOCATION_FAILURE)
STAND_BEFORE(clCreateSubBuffer, Any, CL_MEM_OBJECT_ALLOCATION_FAILURE)
STAND_BEFORE(clCreateProgramWithSource, Any, CL_OUT_OF_HOST_MEMORY)
STAND_BEFORE(clCreateProgramWithBinary, Any, CL_INVALID_BINARY)
STAND_BEFORE(clCreateKernel, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clEnqueueNDRangeKernel, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clEnqueueReadBuffer, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clEnqueueWriteBuffer, Any, CL_MEM_OBJECT_ALLOCATION_FAILURE)
STAND_BEFORE(clEnqueueCopyBuffer, Any, CL_MEM_OBJECT_ALLOCATION_FAILURE)
STAND_BEFORE(clEnqueueFillBuffer, Any, CL_MEM_OBJECT_ALLOCATION_FAILURE)
STAND_BEFORE(clEnqueueMarkerWithWaitList, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clEnqueueBarrierWithWaitList, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clEnqueueUnmapMemObject, Any, CL_OUT_OF_RESOURCES)
STAND_BEFORE(clEnqueueMapBuffer, Any, CL_MAP_FAILURE)
// clang-format on

/// Replaces the C library's clock.
extern "C" int clock_gettime(clockid_t clock, timespec* time)
{
    static auto* const real =
        reinterpret_cast<int (*)(clockid_t, timespec*)>(dlsym(RTLD_NEXT, "clock_gettime"));
    static std::atomic<time_t> looks = 0;
    const int status = real(clock, time);
    if (clock != CLOCK_MONOTONIC && clock != CLOCK_REALTIME)
        return status;
    if (bad_clock() == "host")
        time->tv_sec -= ++looks;
    else if (bad_clock() == "jumps")
        time->tv_sec -= ++looks / 50;
    else if (bad_clock() == "stalls")
        time->tv_sec += 2 * (++looks / 3);
    return status;
}

}  // namespace bvhbench::shim
