// SPDX-License-Identifier: MIT
#include "harness/base/python.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "geometry/error.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

/// Provides a folder with scripts whose path has characters that a shell would interpret.
class Python : public testing::Test {
protected:
    void SetUp() override
    {
        fs::create_directories(folder_ / "plots");
        setenv("BVHBENCH_HOME", folder_.c_str(), 1);
    }
    void TearDown() override
    {
        unsetenv("BVHBENCH_HOME");
        fs::remove_all(folder_);
    }
    void write(const char* script, const char* text) const
    {
        std::ofstream(folder_ / "plots" / script) << text;
    }

    const fs::path folder_ =
        fs::temp_directory_path() /
        ("it's \"a\" name; $(exit 1) `exit 1` & * " + std::to_string(getpid()));
};

TEST_F(Python, NamesReachTheScriptAsTheyAreWhateverAShellWouldMakeOfThem)
{
    write("one.py",
          "import sys\nopen(sys.argv[3] + '/drawn', 'w').write('\\n'.join(sys.argv[1:]))\n");
    EXPECT_EQ(draw("one.py", folder_ / "r 1.json", folder_, false),
              "drawn into " + folder_.string());
    std::ifstream file(folder_ / "drawn");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}),
              (folder_ / "r 1.json").string() + "\n--out\n" + folder_.string());
}

TEST_F(Python, TablesArePrintedOfADocumentThatIsInNoFile)
{
    write("__main__.py", R"(import sys
assert sys.argv[1] == 'show' and open(sys.argv[2]).read() == 'a document', sys.argv
)");
    EXPECT_NO_THROW(print_tables("a document", {}));
    CommonOptions quiet;
    quiet.quiet = true;
    EXPECT_NO_THROW(print_tables("another", quiet));
    testing::internal::CaptureStderr();
    EXPECT_THROW(print_tables("another", {}), Unavailable);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("AssertionError"), std::string::npos);
    fs::remove(folder_ / "plots" / "__main__.py");
    EXPECT_THROW(print_tables("a document", {}), Unavailable);
}

TEST_F(Python, APythonThatLacksAModuleIsASentenceAndOtherErrorsAreTold)
{
    write("one.py", "def f():\n    import no_such_module\nf()\n");
    write("broken.py", "raise ValueError('three legs')\n");
    testing::internal::CaptureStderr();
    EXPECT_NE(draw("one.py", "r.json", folder_, false)
                  .find("python3 has no module no_such_module; where Python and"),
              std::string::npos);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    testing::internal::CaptureStderr();
    EXPECT_NE(draw("broken.py", "r.json", folder_, false).find("broken.py ended with exit code 1"),
              std::string::npos);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("three legs"), std::string::npos);
}

}  // namespace
}  // namespace bvhbench
