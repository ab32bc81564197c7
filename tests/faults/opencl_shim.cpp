// SPDX-License-Identifier: MIT
#include "tests/faults/opencl_shim.h"

#define CL_TARGET_OPENCL_VERSION 300
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl.h>
#include <dlfcn.h>
#include <execinfo.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>

namespace bvhbench::shim {

/// The driver's release of each kind of object.
template <class Handle>
cl_int release(void* object);

namespace {

struct Object {
    const char* made_by;
    cl_int (*release)(void*);  ///< the driver's own
    long count = 1;
    long refused = 0;  ///< releases that were made to fail
};

/// Calls come from one thread here, but nothing says that they must.
struct State {
    std::mutex mutex;
    Plan plan;
    long calls = 0;
    std::string failed;
    bool remembers = false;
    int depth_of_begin = 0;
    std::vector<Call> remembered;
    std::map<void*, Object> objects;
    std::vector<std::string> misused;
};

/// Of a preloaded shim: BVHBENCH_FAIL_CALL=17 lets the 17th call fail, 17+ all from there on.
Plan plan_of_environment()
{
    const char* text = std::getenv("BVHBENCH_FAIL_CALL");
    if (text == nullptr)
        return {};
    char* end = nullptr;
    const long nth = std::strtol(text, &end, 10);
    return {nth, *end == '+'};
}

/// Never destroyed: drivers may still call when statics are gone.
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

/// Of the calls since `begin`: who called that is the same for all.
std::uint64_t stack_hash()
{
    void* frames[deepest];
    const int depth = backtrace(frames, deepest);
    std::uint64_t hash = 1469598103934665603u;
    for (int i = 1; i < depth - state().depth_of_begin; ++i)
        hash = (hash ^ reinterpret_cast<std::uintptr_t>(frames[i])) * 1099511628211u;
    return hash;
}

/// Whether this call is to fail. Counts it.
bool fails(const char* name, const char* error)
{
    State& now = state();
    const std::lock_guard lock(now.mutex);
    ++now.calls;
    if (now.remembers)
        now.remembered.push_back({name, stack_hash()});
    const bool is_hit = now.plan.nth > 0 && (now.plan.from_there_on ? now.calls >= now.plan.nth
                                                                    : now.calls == now.plan.nth);
    if (is_hit && now.failed.empty())
        now.failed = std::string(name) + " " + error;
    return is_hit;
}

/// Where an object is on the account; its end, and a note, if it is not.
auto on_account(void* object, const char* call)
{
    State& now = state();
    const auto found = now.objects.find(object);
    if (found == now.objects.end())
        now.misused.push_back(std::string(call) + " of what is not there");
    return found;
}

void retained(void* object, const char* call)
{
    const std::lock_guard lock(state().mutex);
    if (const auto found = on_account(object, call); found != state().objects.end())
        ++found->second.count;
}

/// False if there is nothing that could be released: the driver is spared it.
bool released(void* object, bool refused, const char* call)
{
    State& now = state();
    const std::lock_guard lock(now.mutex);
    const auto found = on_account(object, call);
    if (found == now.objects.end())
        return false;
    if (refused)
        ++found->second.refused;
    else if (--found->second.count == 0)
        now.objects.erase(found);
    return true;
}

template <class Function>
Function* real(const char* name)
{
    // Opened by name: of a test all of whose calls come here first, the linker leaves the loader out.
    static void* const loader = dlopen("libOpenCL.so.1", RTLD_NOW);
    void* found = loader != nullptr ? dlsym(loader, name) : nullptr;
    if (found == nullptr) {
        std::fprintf(stderr, "opencl_shim: the loader has no %s\n", name);
        std::abort();
    }
    return reinterpret_cast<Function*>(found);
}

template <class Handle>
void made(Handle object, const char* by)
{
    if (object == nullptr)
        return;
    const std::lock_guard lock(state().mutex);
    state().objects[object] = {by, release<Handle>};
}

}  // namespace

void begin(Plan plan)
{
    State& now = state();
    // What is left is given back, so that ten thousand runs do not fill the memory with what was made to fail.
    for (const auto& [object, entry] : now.objects)
        for (long i = 0; i < entry.count; ++i)
            entry.release(object);
    void* frames[deepest];
    now.depth_of_begin = backtrace(frames, deepest) - 1;
    now.plan = plan;
    now.calls = 0;
    now.failed.clear();
    now.remembered.clear();
    now.objects.clear();
    now.misused.clear();
}

long calls() { return state().calls; }
std::string failed_call() { return state().failed; }
void remember_calls(bool wanted) { state().remembers = wanted; }
const std::vector<Call>& remembered() { return state().remembered; }
const std::vector<std::string>& misused() { return state().misused; }

std::vector<std::string> leaked()
{
    std::vector<std::string> names;
    for (const auto& [object, entry] : state().objects)
        if (entry.count > entry.refused)
            names.push_back(std::string(entry.made_by) + " + " +
                            std::to_string(entry.count - entry.refused));
    return names;
}

}  // namespace bvhbench::shim

namespace shim = bvhbench::shim;

#define REAL(name) static auto* const real = shim::real<decltype(name)>(#name)

// A call that gives back nothing but whether it went well.
#define STATUS(name, error, parameters, arguments) \
    extern "C" cl_int name parameters              \
    {                                              \
        REAL(name);                                \
        if (shim::fails(#name, #error))            \
            return error;                          \
        return real arguments;                     \
    }

// A call that makes an object.
#define CREATE(type, name, error, parameters, arguments) \
    extern "C" type name parameters                      \
    {                                                    \
        REAL(name);                                      \
        if (shim::fails(#name, #error)) {                \
            if (status != nullptr)                       \
                *status = error;                         \
            return nullptr;                              \
        }                                                \
        type object = real arguments;                    \
        shim::made(object, #name);                       \
        return object;                                   \
    }

// A call that is enqueued, and makes an event if one is asked for.
#define ENQUEUE(name, error, parameters, arguments)   \
    extern "C" cl_int name parameters                 \
    {                                                 \
        REAL(name);                                   \
        if (shim::fails(#name, #error))               \
            return error;                             \
        const cl_int status = real arguments;         \
        if (status == CL_SUCCESS && event != nullptr) \
            shim::made(*event, #name);                \
        return status;                                \
    }

// A release that fails has no effect, like any call that fails: who made the object is not to blame if it stays.
#define RETAIN_AND_RELEASE(what, type)                                                 \
    extern "C" cl_int clRetain##what(type object)                                      \
    {                                                                                  \
        REAL(clRetain##what);                                                          \
        if (shim::fails("clRetain" #what, "CL_OUT_OF_RESOURCES"))                      \
            return CL_OUT_OF_RESOURCES;                                                \
        shim::retained(object, "clRetain" #what);                                      \
        return real(object);                                                           \
    }                                                                                  \
    extern "C" cl_int clRelease##what(type object)                                     \
    {                                                                                  \
        REAL(clRelease##what);                                                         \
        const bool is_refused = shim::fails("clRelease" #what, "CL_OUT_OF_RESOURCES"); \
        const bool is_there = shim::released(object, is_refused, "clRelease" #what);   \
        return is_refused || !is_there ? CL_OUT_OF_RESOURCES : real(object);           \
    }                                                                                  \
    template <>                                                                        \
    cl_int bvhbench::shim::release<type>(void* object)                                 \
    {                                                                                  \
        REAL(clRelease##what);                                                         \
        return real(static_cast<type>(object));                                        \
    }

RETAIN_AND_RELEASE(CommandQueue, cl_command_queue)
RETAIN_AND_RELEASE(Context, cl_context)
RETAIN_AND_RELEASE(Event, cl_event)
RETAIN_AND_RELEASE(Kernel, cl_kernel)
RETAIN_AND_RELEASE(MemObject, cl_mem)
RETAIN_AND_RELEASE(Program, cl_program)

// Devices that nobody has divided are not counted.
STATUS(clRetainDevice, CL_OUT_OF_RESOURCES, (cl_device_id device), (device))
STATUS(clReleaseDevice, CL_OUT_OF_RESOURCES, (cl_device_id device), (device))

STATUS(clGetPlatformIDs, CL_OUT_OF_HOST_MEMORY,
       (cl_uint room, cl_platform_id* list, cl_uint* count), (room, list, count))
STATUS(clGetPlatformInfo, CL_OUT_OF_HOST_MEMORY,
       (cl_platform_id platform, cl_platform_info what, size_t room, void* value, size_t* size),
       (platform, what, room, value, size))
STATUS(clGetDeviceIDs, CL_DEVICE_NOT_FOUND,
       (cl_platform_id platform, cl_device_type type, cl_uint room, cl_device_id* list,
        cl_uint* count),
       (platform, type, room, list, count))
STATUS(clGetDeviceInfo, CL_OUT_OF_RESOURCES,
       (cl_device_id device, cl_device_info what, size_t room, void* value, size_t* size),
       (device, what, room, value, size))
STATUS(clGetContextInfo, CL_OUT_OF_RESOURCES,
       (cl_context context, cl_context_info what, size_t room, void* value, size_t* size),
       (context, what, room, value, size))
STATUS(clGetCommandQueueInfo, CL_OUT_OF_RESOURCES,
       (cl_command_queue queue, cl_command_queue_info what, size_t room, void* value, size_t* size),
       (queue, what, room, value, size))
STATUS(clGetMemObjectInfo, CL_OUT_OF_RESOURCES,
       (cl_mem memory, cl_mem_info what, size_t room, void* value, size_t* size),
       (memory, what, room, value, size))
STATUS(clGetProgramInfo, CL_OUT_OF_RESOURCES,
       (cl_program program, cl_program_info what, size_t room, void* value, size_t* size),
       (program, what, room, value, size))
STATUS(clGetProgramBuildInfo, CL_OUT_OF_RESOURCES,
       (cl_program program, cl_device_id device, cl_program_build_info what, size_t room,
        void* value, size_t* size),
       (program, device, what, room, value, size))
STATUS(clGetKernelInfo, CL_OUT_OF_RESOURCES,
       (cl_kernel kernel, cl_kernel_info what, size_t room, void* value, size_t* size),
       (kernel, what, room, value, size))
STATUS(clGetKernelWorkGroupInfo, CL_OUT_OF_RESOURCES,
       (cl_kernel kernel, cl_device_id device, cl_kernel_work_group_info what, size_t room,
        void* value, size_t* size),
       (kernel, device, what, room, value, size))
STATUS(clGetEventInfo, CL_OUT_OF_RESOURCES,
       (cl_event event, cl_event_info what, size_t room, void* value, size_t* size),
       (event, what, room, value, size))
STATUS(clGetEventProfilingInfo, CL_PROFILING_INFO_NOT_AVAILABLE,
       (cl_event event, cl_profiling_info what, size_t room, void* value, size_t* size),
       (event, what, room, value, size))
STATUS(clBuildProgram, CL_OUT_OF_HOST_MEMORY,
       (cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
        void(CL_CALLBACK* notify)(cl_program, void*), void* data),
       (program, count, devices, options, notify, data))
STATUS(clSetKernelArg, CL_OUT_OF_RESOURCES,
       (cl_kernel kernel, cl_uint index, size_t size, const void* value),
       (kernel, index, size, value))
STATUS(clFlush, CL_OUT_OF_RESOURCES, (cl_command_queue queue), (queue))
STATUS(clFinish, CL_OUT_OF_RESOURCES, (cl_command_queue queue), (queue))
STATUS(clWaitForEvents, CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST,
       (cl_uint count, const cl_event* events), (count, events))

CREATE(cl_context, clCreateContext, CL_DEVICE_NOT_AVAILABLE,
       (const cl_context_properties* properties, cl_uint count, const cl_device_id* devices,
        void(CL_CALLBACK* notify)(const char*, const void*, size_t, void*), void* data,
        cl_int* status),
       (properties, count, devices, notify, data, status))
CREATE(cl_command_queue, clCreateCommandQueue, CL_OUT_OF_HOST_MEMORY,
       (cl_context context, cl_device_id device, cl_command_queue_properties properties,
        cl_int* status),
       (context, device, properties, status))
CREATE(cl_mem, clCreateBuffer, CL_MEM_OBJECT_ALLOCATION_FAILURE,
       (cl_context context, cl_mem_flags flags, size_t size, void* host, cl_int* status),
       (context, flags, size, host, status))
CREATE(cl_mem, clCreateSubBuffer, CL_MEM_OBJECT_ALLOCATION_FAILURE,
       (cl_mem memory, cl_mem_flags flags, cl_buffer_create_type type, const void* region,
        cl_int* status),
       (memory, flags, type, region, status))
CREATE(cl_program, clCreateProgramWithSource, CL_OUT_OF_HOST_MEMORY,
       (cl_context context, cl_uint count, const char** texts, const size_t* lengths,
        cl_int* status),
       (context, count, texts, lengths, status))
CREATE(cl_program, clCreateProgramWithBinary, CL_INVALID_BINARY,
       (cl_context context, cl_uint count, const cl_device_id* devices, const size_t* lengths,
        const unsigned char** binaries, cl_int* loaded, cl_int* status),
       (context, count, devices, lengths, binaries, loaded, status))
CREATE(cl_kernel, clCreateKernel, CL_OUT_OF_RESOURCES,
       (cl_program program, const char* name, cl_int* status), (program, name, status))

ENQUEUE(clEnqueueNDRangeKernel, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
         const size_t* global, const size_t* local, cl_uint waits, const cl_event* list,
         cl_event* event),
        (queue, kernel, dimensions, offset, global, local, waits, list, event))
ENQUEUE(clEnqueueReadBuffer, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_mem memory, cl_bool waiting, size_t offset, size_t size,
         void* to, cl_uint waits, const cl_event* list, cl_event* event),
        (queue, memory, waiting, offset, size, to, waits, list, event))
ENQUEUE(clEnqueueWriteBuffer, CL_MEM_OBJECT_ALLOCATION_FAILURE,
        (cl_command_queue queue, cl_mem memory, cl_bool waiting, size_t offset, size_t size,
         const void* from, cl_uint waits, const cl_event* list, cl_event* event),
        (queue, memory, waiting, offset, size, from, waits, list, event))
ENQUEUE(clEnqueueCopyBuffer, CL_MEM_OBJECT_ALLOCATION_FAILURE,
        (cl_command_queue queue, cl_mem from, cl_mem to, size_t from_offset, size_t to_offset,
         size_t size, cl_uint waits, const cl_event* list, cl_event* event),
        (queue, from, to, from_offset, to_offset, size, waits, list, event))
ENQUEUE(clEnqueueFillBuffer, CL_MEM_OBJECT_ALLOCATION_FAILURE,
        (cl_command_queue queue, cl_mem memory, const void* pattern, size_t pattern_size,
         size_t offset, size_t size, cl_uint waits, const cl_event* list, cl_event* event),
        (queue, memory, pattern, pattern_size, offset, size, waits, list, event))
ENQUEUE(clEnqueueBarrierWithWaitList, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_uint waits, const cl_event* list, cl_event* event),
        (queue, waits, list, event))
ENQUEUE(clEnqueueUnmapMemObject, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_mem memory, void* mapped, cl_uint waits, const cl_event* list,
         cl_event* event),
        (queue, memory, mapped, waits, list, event))

extern "C" void* clEnqueueMapBuffer(cl_command_queue queue, cl_mem memory, cl_bool waiting,
                                    cl_map_flags flags, size_t offset, size_t size, cl_uint waits,
                                    const cl_event* list, cl_event* event, cl_int* status)
{
    REAL(clEnqueueMapBuffer);
    if (shim::fails("clEnqueueMapBuffer", "CL_MAP_FAILURE")) {
        if (status != nullptr)
            *status = CL_MAP_FAILURE;
        return nullptr;
    }
    void* mapped = real(queue, memory, waiting, flags, offset, size, waits, list, event, status);
    if (mapped != nullptr && event != nullptr)
        shim::made(*event, "clEnqueueMapBuffer");
    return mapped;
}
