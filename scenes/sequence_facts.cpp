// SPDX-License-Identifier: MIT
#include "scenes/sequence.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "geometry/error.h"

namespace bvhbench {
namespace {

using Json = nlohmann::json;

/// A disagreement or malformed content. The file's name is put before the message.
struct Fault {
    std::string what;
};

std::uint64_t count(const Json& json, const char* key)
{
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number_unsigned())
        throw Fault{"has no count '" + std::string(key) + "' where one goes"};
    return found->get<std::uint64_t>();
}

void expect(const Json& json, const char* key, std::size_t found)
{
    if (json.contains(key) && count(json, key) != found)
        throw Fault{"says " + std::to_string(count(json, key)) + " " + key + ", and there are " +
                    std::to_string(found)};
}

/// A line of the table of objects. Without `first`, the triangles need not follow each other: the mesh's object_id decides.
struct ObjectLine {
    std::string name;
    std::optional<std::int64_t> id;
    std::optional<uint> first;
    uint count;
};

std::vector<ObjectLine> object_table(const Json& table)
{
    if (!table.is_array())
        throw Fault{"has 'objects' that are no list"};
    std::vector<ObjectLine> objects;
    for (const Json& line : table) {
        const auto name = line.is_object() ? line.find("name") : line.end();
        if (!line.is_object() || name == line.end() || !name->is_string())
            throw Fault{"has an object without a name, number " + std::to_string(objects.size())};
        const auto triangles = [&](const char* key) {
            const std::uint64_t value = count(line, key);
            if (value > 0xffffffffu)
                throw Fault{"has an object of more triangles than there can be"};
            return static_cast<uint>(value);
        };
        const auto first = line.find("face_first");
        const bool has_first = first != line.end() && !first->is_null();
        const auto id = line.find("id");
        if (id != line.end() && !id->is_number_integer())
            throw Fault{"has an object whose id is no whole number, '" + name->get<std::string>() +
                        "'"};
        objects.push_back({name->get<std::string>(),
                           id != line.end() ? std::optional(id->get<std::int64_t>()) : std::nullopt,
                           has_first ? std::optional(triangles("face_first")) : std::nullopt,
                           triangles("face_count")});
    }
    return objects;
}

/// Divides a scene of one object by the table, which has to cover its triangles.
void divide(Scene& scene, const std::vector<ObjectLine>& table)
{
    std::uint64_t covered = 0;
    scene.objects.clear();
    scene.object_ids.clear();
    for (const ObjectLine& line : table) {
        if (!line.first)
            throw Fault{"has an object, '" + line.name +
                        "', without a face_first, and the mesh has no object_id"};
        if (*line.first != covered || line.count == 0)
            break;
        scene.objects.push_back({line.name, *line.first, line.count});
        covered += line.count;
    }
    if (scene.objects.size() != table.size() || covered != scene.faces.size())
        throw Fault{"has objects that do not cover the mesh's triangles one after the other"};
}

void take_objects(Scene& scene, const std::vector<ObjectLine>& table)
{
    if (scene.objects.size() < 2 && table.size() != 1) {  // the mesh has no object_id
        divide(scene, table);
        return;
    }
    const bool has_ids = !scene.objects.empty() || !scene.object_ids.empty();
    if (scene.objects.empty())
        scene.objects.push_back({"all", 0, scene.triangle_count()});
    if (table.size() != scene.objects.size())
        throw Fault{"has " + std::to_string(table.size()) + " objects, and the mesh has " +
                    std::to_string(scene.objects.size())};
    for (std::size_t k = 0; k < table.size(); ++k) {
        SceneObject& object = scene.objects[k];
        const uint first =
            scene.file_faces.empty() ? object.first_face : scene.file_faces[object.first_face];
        const std::int64_t id =
            scene.object_ids.empty() ? static_cast<std::int64_t>(k) : scene.object_ids[k];
        const auto& [name, said_id, said_first, said_count] = table[k];
        if (said_first.value_or(first) != first || said_count != object.face_count)
            throw Fault{"has an object, '" + name + "', over " + std::to_string(said_count) +
                        " triangles from " + std::to_string(said_first.value_or(first)) +
                        ", and the mesh has " + std::to_string(object.face_count) + " from " +
                        std::to_string(first)};
        if (has_ids && said_id.value_or(id) != id)
            throw Fault{"has an object, '" + name + "', of id " + std::to_string(*said_id) +
                        ", and the mesh has id " + std::to_string(id) + " in its place"};
        object.name = name;
    }
}

void take(Scene& scene, const Json& json)
{
    expect(json, "frames", scene.frames.size());
    expect(json, "vertices", scene.frames.front().size());
    expect(json, "triangles", scene.faces.size());
    if (const auto table = json.find("objects"); table != json.end()) {
        take_objects(scene, object_table(*table));
        scene.has_meshes = true;
    }
    if (const auto list = json.find("frame_labels"); list != json.end()) {
        if (!list->is_array())
            throw Fault{"has 'frame_labels' that are no list"};
        for (const Json& label : *list) {
            if (!label.is_string() && !label.is_number_integer())
                throw Fault{"has a frame label that is neither text nor a whole number"};
            scene.frame_labels.push_back(label.is_string() ? label.get<std::string>()
                                                           : label.dump());
        }
        if (scene.frame_labels.size() != scene.frames.size())
            throw Fault{"has " + std::to_string(scene.frame_labels.size()) + " frame labels for " +
                        std::to_string(scene.frames.size()) + " frames"};
    }
}

StepFacts step_of(const Scene& scene, const Json& ccd)
{
    if (!ccd.is_object())
        throw Fault{"has a 'ccd' that is no object"};
    const auto frame = [&](const char* key) {
        const auto label = ccd.find(key);
        const auto& all = scene.frame_labels;
        const auto found = label == ccd.end() || !label->is_string()
                               ? all.end()
                               : std::find(all.begin(), all.end(), label->get<std::string>());
        if (found == all.end())
            throw Fault{"has a 'ccd' whose '" + std::string(key) + "' is no label of a frame"};
        return static_cast<std::size_t>(found - all.begin());
    };
    const auto count_if = [&](const char* key) {
        return ccd.contains(key) ? std::optional(count(ccd, key)) : std::nullopt;
    };
    StepFacts facts{frame("from_frame"),   count_if("vf_listed"), count_if("vf_true"),
                    count_if("ee_listed"), count_if("ee_true"),   count_if("swept_vf"),
                    count_if("swept_ee")};
    if (frame("to_frame") != facts.from_frame + 1)
        throw Fault{"has a 'ccd' whose frames do not follow each other"};
    return facts;
}

/// Calls `use` with the contents of the file, if it exists.
void read_facts(const std::filesystem::path& meta, const std::function<void(const Json&)>& use)
{
    if (!std::filesystem::exists(meta))
        return;
    const Json json = Json::parse(file_bytes(meta), nullptr, false);  // on errors: is_discarded()
    try {
        if (json.is_discarded())
            throw Fault{"is not JSON"};
        if (!json.is_object())
            throw Fault{"is no JSON object"};
        use(json);
    } catch (const Fault& fault) {
        throw Unavailable(meta.string() + " " + fault.what);
    }
}

}  // namespace

void add_sequence_facts(Scene& scene, const std::filesystem::path& meta)
{
    read_facts(meta, [&](const Json& json) { take(scene, json); });
}

std::optional<StepFacts> step_facts(const Scene& scene, const std::filesystem::path& meta)
{
    std::optional<StepFacts> facts;
    read_facts(meta, [&](const Json& json) {
        if (const auto ccd = json.find("ccd"); ccd != json.end())
            facts = step_of(scene, *ccd);
    });
    return facts;
}

}  // namespace bvhbench
