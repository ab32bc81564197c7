// SPDX-License-Identifier: MIT
//
// A C++ class as a method of bvhbench/plugin.h: an adapter derives from Method, and method() makes the table of C functions.
// C++17, so that every library's compiler takes it.
#pragma once

#include <bvhbench/plugin.h>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <string>
#include <type_traits>
#include <utility>

// The one symbol that an adapter shows.
extern "C" __attribute__((visibility("default"))) const bvhbench_plugin* bvhbench_plugin_entry(
    uint32_t host_abi);

namespace adapter {

/// Pairs of triangles, two numbers each. They stay the method's.
struct PairList {
    uint64_t count;
    const uint32_t* two_each;
};

/// One way to build a tree or to find pairs. A function fails by throwing a std::exception whose text is one sentence.
class Method {
public:
    virtual ~Method() = default;

    // As in plugin.h. A class overrides those that it has: the others become NULL.
    virtual void prepare(const bvhbench_mesh& mesh) = 0;
    virtual void load(const float* points) = 0;
    virtual void load_step(const float*, const float*) {}
    virtual void build(bvhbench_stages&) {}
    virtual void refit(bvhbench_stages&) {}
    virtual void query(bvhbench_stages&) {}
    virtual PairList pairs() { return {}; }
    virtual bvhbench_tree tree() { return {}; }
    virtual uint64_t bytes() = 0;

    std::string error;  // why the last call failed
};

/// Calls `act` with the method behind `state`. Returns 0, or 1 if it threw, and keeps the reason.
template <class Act>
int tried(void* state, Act act)
{
    Method& method = *static_cast<Method*>(state);
    try {
        act(method);
        return 0;
    } catch (const std::exception& failure) {
        method.error = failure.what();
        return 1;
    }
}

template <class M>
void* create(char* why)
{
    try {
        return static_cast<Method*>(new M);
    } catch (const std::exception& failure) {
        std::snprintf(why, 256, "%s", failure.what());
        return nullptr;
    }
}

/// Returns `function` if `Own` is a member that a class has overridden, NULL if it is still `Plain`.
template <class Own, class Plain, class Function>
Function if_overridden(Function function)
{
    return std::is_same_v<Own, Plain> ? nullptr : function;
}

/// Returns the table of functions of class M. Both texts must live as long as the library.
template <class M>
bvhbench_method method(const char* name, const char* summary)
{
    using Timed = int (*)(void*, bvhbench_stages*);
    bvhbench_method made{};
    made.name = name;
    made.summary = summary;
    made.create = create<M>;
    made.prepare = [](void* state, const bvhbench_mesh* mesh) {
        return tried(state, [&](Method& m) { m.prepare(*mesh); });
    };
    made.load = [](void* state, const float* points) {
        return tried(state, [&](Method& m) { m.load(points); });
    };
    made.load_step = if_overridden<decltype(&M::load_step), decltype(&Method::load_step),
                                   decltype(bvhbench_method::load_step)>(
        [](void* state, const float* start, const float* end) {
            return tried(state, [&](Method& m) { m.load_step(start, end); });
        });
    made.build = if_overridden<decltype(&M::build), decltype(&Method::build), Timed>(
        [](void* state, bvhbench_stages* stages) {
            return tried(state, [&](Method& m) { m.build(*stages); });
        });
    made.refit = if_overridden<decltype(&M::refit), decltype(&Method::refit), Timed>(
        [](void* state, bvhbench_stages* stages) {
            return tried(state, [&](Method& m) { m.refit(*stages); });
        });
    made.query = if_overridden<decltype(&M::query), decltype(&Method::query), Timed>(
        [](void* state, bvhbench_stages* stages) {
            return tried(state, [&](Method& m) { m.query(*stages); });
        });
    made.pairs = if_overridden<decltype(&M::pairs), decltype(&Method::pairs),
                               decltype(bvhbench_method::pairs)>(
        [](void* state, uint64_t* count, const uint32_t** two_each) {
            return tried(state, [&](Method& m) {
                const PairList found = m.pairs();
                *count = found.count;
                *two_each = found.two_each;
            });
        });
    made.tree =
        if_overridden<decltype(&M::tree), decltype(&Method::tree), decltype(bvhbench_method::tree)>(
            [](void* state, bvhbench_tree* tree) {
                return tried(state, [&](Method& m) { *tree = m.tree(); });
            });
    made.bytes = [](void* state) { return static_cast<Method*>(state)->bytes(); };
    made.error = [](void* state) { return static_cast<Method*>(state)->error.c_str(); };
    made.destroy = [](void* state) { delete static_cast<Method*>(state); };
    return made;
}

/// Puts the stage `name` at the end of `stages`. Times are in nanoseconds since the start of the call.
inline void add_stage(bvhbench_stages& stages, const char* name, uint64_t begin_ns, uint64_t end_ns,
                      bool on_device)
{
    stages.stage[stages.count++] = {name, begin_ns, end_ns, on_device};
}

/// What bvhbench_plugin_entry of a library returns. Texts and methods must live as long as the library.
template <std::size_t count>
const bvhbench_plugin* plugin(uint32_t host_abi, const char* library, const char* version,
                              const char* licence, const std::string& device,
                              const bvhbench_method (&methods)[count])
{
    static const std::string kept_device = device;
    static const bvhbench_plugin made{BVHBENCH_PLUGIN_ABI, library, version, licence,
                                      kept_device.c_str(), count,   methods};
    return host_abi == BVHBENCH_PLUGIN_ABI ? &made : nullptr;
}

}  // namespace adapter
