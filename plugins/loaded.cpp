// SPDX-License-Identifier: MIT
#include "plugins/loaded.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "geometry/error.h"
#include "process/worker.h"
#include "scenes/mesh_file.h"

namespace bvhbench::outside {
namespace {

constexpr std::uint32_t without_steps = 2;  ///< version whose methods end before load_step

std::string text_of(const char* text, const char* what)
{
    if (text == nullptr)
        throw Unavailable(std::string("its `") + what + "` is NULL");
    return text;
}

/// Writes an array to the file that a request names at `key`.
template <class Value>
void write_array(const Json& request, const char* key, const Value* values, std::uint64_t count)
{
    if (values == nullptr && count > 0)
        throw Unavailable(std::string("it gives no array of ") + key);
    const int file = open(request.at(key).get<std::string>().c_str(), O_WRONLY | O_TRUNC);
    const bool is_written = file >= 0 && write_all(file, {reinterpret_cast<const char*>(values),
                                                          count * sizeof(Value)});
    const std::string reason = std::system_category().message(errno);
    close(file);
    if (!is_written)
        throw Unavailable(std::string("the file of ") + key + " cannot be written: " + reason);
}

template <class Value>
const Value* values_in(const std::string& bytes)
{
    return reinterpret_cast<const Value*>(bytes.data());
}

/// A library with the interface in C, and the state of one of its methods.
class Loaded {
public:
    /// Loads the library. Throws Unavailable if it is none, or has another interface.
    explicit Loaded(const char* path)
    {
        void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr)
            throw Unavailable(std::string("it cannot be loaded: ") + dlerror());
        const auto entry = reinterpret_cast<decltype(&bvhbench_plugin_entry)>(
            dlsym(library, "bvhbench_plugin_entry"));
        if (entry == nullptr)
            throw Unavailable("it has no symbol `bvhbench_plugin_entry`");
        plugin_ = entry(BVHBENCH_PLUGIN_ABI);
        if (plugin_ == nullptr)
            plugin_ = entry(without_steps);
        if (plugin_ == nullptr)
            throw Unavailable("it does not serve version " + std::to_string(BVHBENCH_PLUGIN_ABI) +
                              " of the interface");
        if (plugin_->abi != BVHBENCH_PLUGIN_ABI && plugin_->abi != without_steps)
            throw Unavailable("it was made for version " + std::to_string(plugin_->abi) +
                              " of the interface, and this is version " +
                              std::to_string(BVHBENCH_PLUGIN_ABI));
        const std::size_t bytes = plugin_->abi == without_steps
                                      ? offsetof(bvhbench_method, load_step)
                                      : sizeof(bvhbench_method);
        for (std::uint32_t k = 0; k < plugin_->method_count; ++k)
            std::memcpy(&methods_.emplace_back(),
                        reinterpret_cast<const char*>(plugin_->methods) + k * bytes, bytes);
    }

    Loaded(const Loaded&) = delete;
    ~Loaded()
    {
        if (state_ != nullptr)
            method_->destroy(state_);
    }

    Json reply_to(const Json& request)
    {
        const std::string call = request.at("call").get<std::string>();
        if (call == "hello")
            return hello();
        if (call == "create")
            return create(request.at("method").get<std::string>());
        if (state_ == nullptr)
            throw Unavailable("`" + call + "` comes before `create`");
        if (call == "prepare")
            return prepare(request);
        if (call == "load")
            return load(request);
        if (call == "build")
            return timed(method_->build);
        if (call == "refit")
            return timed(method_->refit);
        if (call == "query" && request.contains("within"))
            return timed(method_->query_within, request.at("within").get<double>());
        if (call == "query")
            return timed(method_->query);
        if (call == "pairs")
            return pairs(request);
        if (call == "tree")
            return tree(request);
        if (call == "queries")
            return load_queries(request);
        if (call == "answer")
            return timed(method_->answer);
        if (call == "times")
            return times(request);
        if (call == "candidates")
            return load_candidates(request);
        if (call == "narrow")
            return timed(method_->narrow);
        if (call == "bytes")
            return {{"ok", true},
                    {"bytes", method_->bytes == nullptr ? 0 : method_->bytes(state_)}};
        throw Unavailable("there is no call `" + call + "`");
    }

private:
    Json hello() const
    {
        Json methods = Json::array();
        for (const bvhbench_method& method : methods_) {
            const std::string name = text_of(method.name, "name");
            const bool answers = method.load_queries && method.answer && method.times;
            for (const auto& [call, is_there] : {std::pair("create", method.create != nullptr),
                                                 {"prepare", answers || method.prepare != nullptr},
                                                 {"load", answers || method.load != nullptr},
                                                 {"error", method.error != nullptr},
                                                 {"destroy", method.destroy != nullptr}})
                if (!is_there)
                    throw Unavailable("its method " + name + " lacks `" + call + "`");
            methods.push_back({{"name", name},
                               {"summary", text_of(method.summary, "summary")},
                               {"build", method.build != nullptr},
                               {"refit", method.refit != nullptr},
                               {"query", method.query != nullptr},
                               {"pairs", method.pairs != nullptr},
                               {"tree", method.tree != nullptr},
                               {"answer", answers},
                               {"steps", method.load_step != nullptr},
                               {"within", method.query_within != nullptr},
                               {"narrow", method.load_candidates && method.narrow},
                               {"finds_contacts", method.finds_contacts != 0},
                               {"widens_boxes", method.widens_boxes != 0}});
        }
        return {{"ok", true},
                {"protocol", protocol},
                {"library", text_of(plugin_->library, "library")},
                {"version", text_of(plugin_->version, "version")},
                {"licence", text_of(plugin_->licence, "licence")},
                {"device", text_of(plugin_->device, "device")},
                {"methods", methods}};
    }

    Json create(const std::string& name)
    {
        for (const bvhbench_method& method : methods_)
            if (name == method.name)
                method_ = &method;
        if (method_ == nullptr)
            throw Unavailable("it has no method " + name);
        std::array<char, 256> why{};
        state_ = method_->create(why.data());
        why.back() = '\0';
        if (state_ == nullptr)
            throw Unavailable(why.front() == '\0' ? "`create` fails and does not say why"
                                                  : why.data());
        return {{"ok", true}};
    }

    /// Calls a function of the method. Throws what the plug-in says if it fails, and Unavailable if the method lacks it.
    template <class... Parameters, class... Arguments>
    void call(int (*function)(void*, Parameters...), Arguments... arguments) const
    {
        if (function == nullptr)
            throw Unavailable("its method lacks this call");
        if (function(state_, arguments...) == 0)
            return;
        const char* const why = method_->error(state_);
        throw Unavailable(why == nullptr || *why == '\0' ? "it fails and does not say why" : why);
    }

    Json prepare(const Json& request)
    {
        faces_ = file_bytes(request.at("faces").get<std::string>());
        const bvhbench_mesh mesh = {request.at("vertices").get<std::uint64_t>(),
                                    request.at("triangles").get<std::uint64_t>(),
                                    values_in<std::uint32_t>(faces_),
                                    request.at("first").get<std::uint64_t>(),
                                    request.at("drops_adjacent").get<bool>() ? 1u : 0u};
        call(method_->prepare, &mesh);
        return {{"ok", true}};
    }

    Json load(const Json& request)
    {
        points_ = file_bytes(request.at("points").get<std::string>());
        if (request.contains("end_points")) {
            end_points_ = file_bytes(request.at("end_points").get<std::string>());
            call(method_->load_step, values_in<float>(points_), values_in<float>(end_points_));
        } else {
            call(method_->load, values_in<float>(points_));
        }
        return {{"ok", true}};
    }

    Json load_queries(const Json& request)
    {
        points_ = file_bytes(request.at("points").get<std::string>());
        queries_ = {request.at("count").get<std::uint64_t>(),
                    request.at("of_edges").get<bool>() ? 1u : 0u, values_in<double>(points_)};
        call(method_->load_queries, &queries_);
        return {{"ok", true}};
    }

    Json load_candidates(const Json& request)
    {
        candidates_ = file_bytes(request.at("candidates").get<std::string>());
        call(method_->load_candidates, request.at("count").get<std::uint64_t>(),
             values_in<std::uint32_t>(candidates_));
        return {{"ok", true}};
    }

    Json times(const Json& request)
    {
        const double* times = nullptr;
        call(method_->times, &times);
        write_array(request, "times", times, queries_.count);
        return {{"ok", true}};
    }

    template <class Function, class... Arguments>
    Json timed(Function function, Arguments... arguments)
    {
        bvhbench_stages stages = {};
        call(function, arguments..., &stages);
        if (stages.count > BVHBENCH_MOST_STAGES)
            throw Unavailable("it gives " + std::to_string(stages.count) + " stages, and " +
                              std::to_string(BVHBENCH_MOST_STAGES) + " are allowed");
        Json list = Json::array();
        for (std::uint32_t k = 0; k < stages.count; ++k) {
            const bvhbench_stage& stage = stages.stage[k];
            list.push_back({{"name", text_of(stage.name, "name of a stage")},
                            {"begin_ns", stage.begin_ns},
                            {"end_ns", stage.end_ns},
                            {"device", stage.on_device != 0}});
        }
        return {{"ok", true}, {"stages", list}};
    }

    Json pairs(const Json& request)
    {
        std::uint64_t count = 0;
        const std::uint32_t* two_each = nullptr;
        call(method_->pairs, &count, &two_each);
        write_array(request, "pairs", two_each, 2 * count);
        return {{"ok", true}, {"count", count}};
    }

    Json tree(const Json& request)
    {
        bvhbench_tree tree = {};
        call(method_->tree, &tree);
        write_array(request, "nodes", tree.node, tree.nodes);
        write_array(request, "entries", tree.entry, tree.entries);
        return {{"ok", true}, {"nodes", tree.nodes}, {"entries", tree.entries}};
    }

    const bvhbench_plugin* plugin_ = nullptr;
    const bvhbench_method* method_ = nullptr;
    void* state_ = nullptr;
    std::vector<bvhbench_method> methods_;  ///< of the plug-in, those that it lacks NULL
    std::string faces_, points_, end_points_, candidates_;
    bvhbench_queries queries_ = {};
};

}  // namespace

std::function<Json(const Json&)> loaded_library(const char* path)
{
    return [loaded = std::make_shared<Loaded>(path)](const Json& request) {
        return loaded->reply_to(request);
    };
}

}  // namespace bvhbench::outside
