// SPDX-License-Identifier: MIT
//
// Every file of a folder of difficult meshes, listed in its MANIFEST.csv, loads with exactly the triangles
// listed there or is refused as Unavailable in one sentence. Files listed as "load" must load.
#include <map>

#include "helpers.h"

namespace bvhbench {
namespace {

struct NastyFile {
    std::string name, outcome, triangles;
};

std::vector<std::string> csv_fields(const std::string& line)
{
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line)
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

std::vector<NastyFile> listed(const std::filesystem::path& manifest)
{
    std::ifstream file(manifest);
    std::vector<NastyFile> result;
    std::string line;
    std::getline(file, line);  // the names of the columns
    while (std::getline(file, line)) {
        const auto fields = csv_fields(line);
        result.push_back({fields.at(0), fields.at(3), fields.at(4)});
    }
    return result;
}

TEST(NastyFiles, LoadWithTheListedTrianglesOrAreRefusedInOneSentence)
{
    const std::filesystem::path folder = std::filesystem::path(data_folder()) / "nasty";
    if (!std::filesystem::exists(folder / "MANIFEST.csv"))
        GTEST_SKIP() << "BVHBENCH_DATA names no data folder with nasty/MANIFEST.csv";
    std::map<std::string, int> outcomes;
    for (const NastyFile& file : listed(folder / "MANIFEST.csv")) {
        SCOPED_TRACE(file.name + ", listed as " + file.outcome);
        std::string what;
        try {
            const Scene scene = load_scene((folder / file.name).string(), {});
            EXPECT_EQ(std::to_string(scene.triangle_count()), file.triangles);
            EXPECT_NE(file.outcome, "reject");
            what = "loaded";
        } catch (const Unavailable& error) {
            what = "refused";
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            EXPECT_TRUE(contains(error.what(), file.name));
            EXPECT_NE(file.outcome, "load") << error.what();
            std::cout << file.name << ": " << error.what() << '\n';
        }
        ++outcomes[file.outcome + ", " + what];
    }
    EXPECT_FALSE(outcomes.empty());
    for (const auto& [outcome, count] : outcomes)
        std::cout << count << " listed as " << outcome << '\n';
}

}  // namespace
}  // namespace bvhbench
