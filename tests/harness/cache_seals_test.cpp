// SPDX-License-Identifier: MIT
#include "harness/cache_seals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>

#include "harness/pocl_cache.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t plenty = 1u << 30;

/// A cache folder with programs of one kernel of a thousand bytes, removed at the end.
class CacheSeals : public testing::Test {
protected:
    CacheSeals()
        : folder_(fs::path(testing::TempDir()) / ("bvhbench-seals-" + std::to_string(getpid())))
    {
        fs::create_directories(folder_);
    }
    ~CacheSeals() override { fs::remove_all(folder_); }

    fs::path program(const std::string& name) const { return folder_ / name; }

    fs::path add(const std::string& name, char content = 'x') const
    {
        fs::create_directories(program(name) / "k" / "1-1-1");
        std::ofstream(program(name) / "program.bc") << "BC";
        std::ofstream(program(name) / "last_accessed");
        const fs::path kernel = program(name) / "k" / "1-1-1" / "k.so";
        std::ofstream(kernel) << std::string(1000, content);
        return kernel;
    }

    fs::path folder_;
};

TEST_F(CacheSeals, KeepWhatIsAsItWasSealed)
{
    add("AA/ONE");
    const fs::path kernel = add("BB/TWO");
    seal(folder_);
    std::ofstream(program("AA/ONE") / "last_accessed") << "at every use";
    fs::remove(kernel);  // is compiled again when it is wanted
    EXPECT_TRUE(remove_broken(folder_, plenty));
    EXPECT_TRUE(fs::exists(program("AA/ONE") / "program.bc"));
    EXPECT_TRUE(fs::exists(program("BB/TWO") / "program.bc"));
}

TEST_F(CacheSeals, RemoveAProgramOfWhichOneByteIsAnother)
{
    add("AA/ONE");
    const fs::path kernel = add("BB/TWO");
    seal(folder_);
    for (const std::streamoff at : {0, 500, 999}) {
        std::fstream(kernel, std::ios::in | std::ios::out | std::ios::binary).seekp(at).put('y');
        EXPECT_TRUE(remove_broken(folder_, plenty));
        EXPECT_FALSE(fs::exists(program("BB/TWO"))) << at;
        EXPECT_TRUE(fs::exists(program("AA/ONE"))) << at;
        add("BB/TWO");
        seal(folder_);
    }
}

TEST_F(CacheSeals, RemoveWhatHasNoSeal)
{
    add("AA/ONE");
    seal(folder_);
    add("BB/TWO");
    std::ofstream(program("AA/ONE") / "k" / "1-1-1" / "another.so") << "x";
    std::ofstream(folder_ / "BB" / "FILE");
    std::ofstream(folder_ / "tempfile_1");  // PoCL's, and no program
    EXPECT_TRUE(remove_broken(folder_, plenty));
    EXPECT_FALSE(fs::exists(program("AA/ONE")));
    EXPECT_FALSE(fs::exists(program("BB/TWO")));
    EXPECT_FALSE(fs::exists(program("BB/FILE")));
    EXPECT_TRUE(fs::exists(folder_ / "tempfile_1"));
}

TEST_F(CacheSeals, SealAnewWhatWasRemovedAndMadeAgain)
{
    const fs::path kernel = add("AA/ONE");
    seal(folder_);
    std::ofstream(kernel) << "cut";
    EXPECT_TRUE(remove_broken(folder_, plenty));
    add("AA/ONE", 'y');
    seal(folder_);
    EXPECT_TRUE(remove_broken(folder_, plenty));
    EXPECT_TRUE(fs::exists(kernel));
}

TEST_F(CacheSeals, RemoveWhatWasUsedLongestAgoBeyondTheBound)
{
    const char* names[] = {"AA/NEW", "BB/OLDEST", "CC/OLD"};
    const int hours[] = {0, 2, 1};
    for (int i = 0; i < 3; ++i) {
        add(names[i]);
        fs::last_write_time(program(names[i]) / "last_accessed",
                            fs::file_time_type::clock::now() - std::chrono::hours(hours[i]));
    }
    seal(folder_);
    EXPECT_TRUE(remove_broken(folder_, 2100));
    EXPECT_TRUE(fs::exists(program("AA/NEW")));
    EXPECT_TRUE(fs::exists(program("CC/OLD")));
    EXPECT_FALSE(fs::exists(program("BB/OLDEST")));
}

TEST_F(CacheSeals, SayWhenSomethingCannotBeLookedAt)
{
    EXPECT_FALSE(remove_broken(folder_ / "nowhere", plenty));
}

TEST_F(CacheSeals, AFolderMustHaveRoom)
{
    EXPECT_EQ(folder_problem(folder_ / "new", 1), "");
    EXPECT_TRUE(fs::is_empty(folder_ / "new"));
    EXPECT_NE(folder_problem(folder_, std::uintmax_t{1} << 62).find(" bytes are free, and "),
              std::string::npos);
    std::ofstream(folder_ / "file");
    EXPECT_EQ(folder_problem(folder_ / "file", 1), "Not a directory");
}

}  // namespace
}  // namespace bvhbench
