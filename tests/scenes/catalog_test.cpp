// SPDX-License-Identifier: MIT

#include "helpers.h"
#include "scenes/generate/generators.h"
#include "scenes/manifest.h"

namespace bvhbench {
namespace {

TEST(Catalog, NamesWhatIsKnownWhenAskedForSomethingElse)
{
    const std::string message = refusal("cube:12");
    EXPECT_TRUE(contains(message, "BadUsage: no scene is called 'cube:12'; there are: torus:N"));
    for (const char* known : {"hairball:N", "cloth-ball:N:F", "refine:SCENE:N", "outlier:SCENE:K:D",
                              "bend:SCENE", "bunny", "nbody_sim", "a path to a mesh file"})
        EXPECT_TRUE(contains(message, known));
    EXPECT_TRUE(refuses("bunni", "BadUsage: no scene is called 'bunni'"));
    EXPECT_TRUE(refuses("", "BadUsage: no scene is called ''"));
    EXPECT_TRUE(refuses("ccd_wang2021", "BadUsage: ccd_wang2021 is no scene but queries"));
}

TEST(Catalog, TakesOnlyAPlainTriangleCount)
{
    for (const std::string bad :
         {"torus", "torus:", "torus:0", "torus:-5", "torus:1.5", "torus: 7", "torus:7x", "torus:k",
          "torus:e5", "torus:1e", "torus:0.1k5", "torus:1.0005k", "torus:1e400", "torus:3000M",
          "torus:2147483649", "torus:99999999999999999999", "soup:1431655766"})
        EXPECT_TRUE(refuses(bad, "BadUsage: scene '" + bad + "' ends in '"));
    EXPECT_TRUE(refuses("torus:0", "a triangle count from 1 to 2147483648"));
}

TEST(Catalog, TakesCountsWithUnitsAndNamesTheSceneInDigits)
{
    for (const char* same : {"torus:1200", "torus:1.2k", "torus:1.2e3", "torus:0.0012M"}) {
        const Scene scene = load_scene(same, {});
        EXPECT_EQ(scene.name, "torus:1200") << same;
        EXPECT_EQ(scene.triangle_count(), 1200u) << same;
        EXPECT_EQ(triangles_in_name(same), 1200u) << same;
    }
    EXPECT_EQ(scene_name("torus:2.88M"), "torus:2880000");
    EXPECT_EQ(scene_name("cloth-ball:100k:3"), "cloth-ball:100000:3");
    EXPECT_EQ(scene_name("refine:bend:sphere:1k:2k"), "refine:bend:sphere:1000:2000");
    EXPECT_EQ(scene_name("outlier:torus:1k:1e1:1e2"), "outlier:torus:1000:10:1e2");
    for (const char* other : {"bunny", "a/torus:1k.obj", "torus:1kk", "nothing:1k"})
        EXPECT_EQ(scene_name(other), other);
}

TEST(Catalog, ListsEveryGeneratorAndDataSetByTheNameTyped)
{
    std::set<std::string> names;
    for (const SceneListing& line : list_scenes({}))
        EXPECT_TRUE(names.insert(line.name).second) << line.name;
    for (const Generator& generator : generators())
        EXPECT_TRUE(names.count(std::string(generator.name) + (generator.moves ? ":N:F" : ":N")));
    for (const ManifestEntry& entry : manifest())
        EXPECT_TRUE(names.count(entry.name));
    EXPECT_TRUE(names.count("refine:SCENE:N"));
    EXPECT_TRUE(names.count("outlier:SCENE:K:D"));
    EXPECT_TRUE(names.count("bend:SCENE"));
}

TEST(Catalog, ListsWhetherAFileIsThere)
{
    const Folder folder;
    const auto summary = [&] {
        for (const SceneListing& line : list_scenes({folder.path()}))
            if (line.name == "bunny")
                return line.summary;
        return std::string();
    };
    EXPECT_TRUE(contains(summary(), "not found: download by hand from "));
    const std::string path = folder.file("bunny/bunny.obj", "");
    EXPECT_TRUE(contains(summary(), "found: " + path));
}

using DataSets = InFolder;

TEST_F(DataSets, OfTableOneHaveStandInsOfTheSameCount)
{
    for (const char* name : {"bunny", "erato", "dragon", "buddha", "hairball"}) {
        const ManifestEntry& set = *manifest_entry(name);
        const Scene scene = load_or_stand_in(name, {});
        EXPECT_EQ(scene.triangle_count(), set.triangles);
        EXPECT_EQ(scene.stand_in_for, name);
        EXPECT_EQ(scene.name, set.stand_ins.back());
    }
    EXPECT_EQ(load_or_stand_in("soup:5", {}).stand_in_for, "");
    EXPECT_THROW(load_or_stand_in("nothing", {}), BadUsage);
}

TEST_F(DataSets, OfAnotherCountAreStoodInForAndRefusedByName)
{
    folder.file("bunny/bunny.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const SceneLibrary library{folder.path()};
    EXPECT_EQ(load_or_stand_in("bunny", library).stand_in_for, "bunny");
    EXPECT_TRUE(
        refuses("bunny", "Unavailable: data set 'bunny' has 144046 triangles, and ", library));
    folder.file("bunny.obj", "v 0 0 0\n");  // the data set's folder is searched first
    EXPECT_TRUE(refuses("bunny", "bunny/bunny.obj has 1", library));
    folder.file("bunny/bunny.obj", "v 0\n");  // a damaged file is not a missing file
    EXPECT_THROW(load_or_stand_in("bunny", library), Unavailable);
}

TEST_F(DataSets, ThatAreNotThereSayWhereToGetThem)
{
    EXPECT_TRUE(refuses("erato", "Unavailable: data set 'erato' is not there: neither --data nor"));
    EXPECT_TRUE(refuses("erato", "https://casual-effects.com/data/"));
    EXPECT_THROW(load_or_stand_in("unc_nbody", {}), Unavailable);
}

TEST_F(DataSets, ThatAreSequencesHaveTheNearestThereIsForStandIn)
{
    const SceneLibrary library{folder.path()};
    const Scene generated = load_or_stand_in("n-body", library);
    EXPECT_EQ(generated.stand_in_for, "n-body");
    EXPECT_EQ(generated.name, "n-body:146480");
    EXPECT_EQ(generated.triangle_count(), 146480u);
    EXPECT_EQ(generated.objects.size(), 305u);
    if (data_folder().empty())
        return;
    const Scene real = load_or_stand_in("n-body", {data_folder()});
    EXPECT_EQ(real.stand_in_for, "n-body");
    EXPECT_EQ(real.name, "unc_nbody");
}

TEST_F(DataSets, OfTablesTwoAndThreeEndInAStandInOfAsManyObjects)
{
    const std::pair<const char*, std::size_t> tables[] = {
        {"cloth-ball", 2}, {"funnel", 4},  {"n-body", 305},  {"flamenco", 10},
        {"andy", 4},       {"bridson", 2}, {"bridson-3", 4},
    };
    for (const auto& [name, objects] : tables) {
        const std::string stand_in = manifest_entry(name)->stand_ins.back();
        const std::string small = stand_in.substr(0, stand_in.find(':')) + ":400:1";
        EXPECT_EQ(load_scene(small, {}).objects.size(), objects) << stand_in;
        EXPECT_THROW(load_scene(name, {}), Unavailable);  // no stand-in if asked for by name
    }
}

TEST(Manifest, HasStandInsOfTheSameCountForMeshesAndGeneratedLastForAll)
{
    std::set<std::string> names;
    for (const ManifestEntry& entry : manifest())
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    for (const ManifestEntry& entry : manifest()) {
        EXPECT_FALSE(entry.files.empty());
        for (const std::string& stand_in : entry.stand_ins) {
            SCOPED_TRACE(entry.name + " " + stand_in);
            const bool is_last = &stand_in == &entry.stand_ins.back();
            if (entry.kind == ManifestEntry::Kind::frames && !is_last) {
                EXPECT_TRUE(names.count(stand_in));
            }
            if (is_last) {
                EXPECT_NE(stand_in.find(':'), stand_in.npos);
                EXPECT_FALSE(stand_in.starts_with("refine:"));
            }
            if (entry.kind == ManifestEntry::Kind::mesh || (is_last && entry.triangles != 0)) {
                EXPECT_EQ(stand_in.substr(stand_in.rfind(':') + 1),
                          std::to_string(entry.triangles));
            }
        }
    }
    EXPECT_THROW(parse_manifest("name\tother\n"), std::logic_error);
}

}  // namespace
}  // namespace bvhbench
