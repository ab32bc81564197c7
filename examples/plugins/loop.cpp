// SPDX-License-Identifier: MIT
//
// Calls the methods of a plug-in in a plain loop, without bvhbench, and prints the medians of their stages in microseconds: what a
// library takes in a program of its own.
//
//     plugin_loop PLUGIN MESH.obj [CALLS]
#include <bvhbench/plugin.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Mesh {
    std::vector<float> points;
    std::vector<uint32_t> faces;
};

/// Reads lines `v x y z` and `f a b c`, with vertices counted from 1. Of a file with others the mesh is empty.
Mesh read_mesh(const char* path)
{
    Mesh mesh;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind, rest;
        float x, y, z;
        uint32_t a, b, c;
        if (!(words >> kind) || kind[0] == '#')
            continue;
        if (kind == "v" && words >> x >> y >> z && !(words >> rest))
            mesh.points.insert(mesh.points.end(), {x, y, z});
        else if (kind == "f" && words >> a >> b >> c && !(words >> rest))
            mesh.faces.insert(mesh.faces.end(), {a - 1, b - 1, c - 1});
        else
            return {};
    }
    return mesh;
}

using Call = int (*)(void*, bvhbench_stages*);

/// Prints the median of the sum of all stages. Returns false if a call fails.
bool time_calls(const char* name, Call call, void* state, int calls)
{
    std::vector<uint64_t> sums;
    for (int k = 0; k < calls; ++k) {
        bvhbench_stages stages = {};
        if (call(state, &stages) != 0)
            return false;
        uint64_t sum = 0;
        for (uint32_t s = 0; s < stages.count; ++s)
            sum += stages.stage[s].end_ns - stages.stage[s].begin_ns;
        sums.push_back(sum);
    }
    std::sort(sums.begin(), sums.end());
    std::fprintf(stderr, "  %s %.1f", name, sums[sums.size() / 2] * 1e-3);
    return true;
}

/// Times all calls that a method has. Results go to standard error, because libraries print to standard output.
bool time_method(const bvhbench_method& method, const Mesh& mesh, int calls)
{
    std::fprintf(stderr, "%s:", method.name);
    char why[256] = "";
    void* const state = method.create(why);
    if (state == nullptr) {
        std::fprintf(stderr, " %s\n", why);
        return false;
    }
    const bvhbench_mesh given = {mesh.points.size() / 3, mesh.faces.size() / 3, mesh.faces.data(),
                                 0, 0};
    bool is_done =
        method.prepare(state, &given) == 0 && method.load(state, mesh.points.data()) == 0;
    for (const auto& [name, call] :
         {std::pair("build", method.build), std::pair("query", method.query),
          std::pair("refit", method.refit)})
        is_done = is_done && (call == nullptr || time_calls(name, call, state, calls));
    std::fprintf(stderr, "%s\n", is_done ? "" : method.error(state));
    method.destroy(state);
    return is_done;
}

}  // namespace

int main(int argc, char** argv)
{
    void* const library = argc > 2 ? dlopen(argv[1], RTLD_NOW) : nullptr;
    const auto entry = library == nullptr ? nullptr
                                          : reinterpret_cast<decltype(&bvhbench_plugin_entry)>(
                                                dlsym(library, "bvhbench_plugin_entry"));
    const bvhbench_plugin* const plugin = entry == nullptr ? nullptr : entry(BVHBENCH_PLUGIN_ABI);
    if (plugin == nullptr) {
        std::fprintf(stderr, "Usage: plugin_loop PLUGIN MESH.obj [CALLS]\n%s\n",
                     argc > 2 ? "the plug-in cannot be loaded" : "");
        return 2;
    }
    const Mesh mesh = read_mesh(argv[2]);
    if (mesh.faces.empty()) {
        std::fprintf(stderr, "%s has not lines `v x y z` and `f a b c` alone\n", argv[2]);
        return 3;
    }
    bool is_done = true;
    for (uint32_t k = 0; k < plugin->method_count; ++k)
        is_done =
            time_method(plugin->methods[k], mesh, argc > 3 ? std::atoi(argv[3]) : 50) && is_done;
    return is_done ? 0 : 1;
}
