// SPDX-License-Identifier: MIT
#include "harness/base/python.h"

#include <gtest/gtest.h>

#include <iterator>

#include "geometry/error.h"
#include "tests/folder.h"

namespace bvhbench {
namespace {

/// Provides a folder with scripts whose path has characters that a shell would interpret.
class Python : public testing::Test {
protected:
    void SetUp() override { setenv("BVHBENCH_HOME", folder_.c_str(), 1); }
    void TearDown() override { unsetenv("BVHBENCH_HOME"); }
    void write(const char* text) const { made_.file("plots/__main__.py", text); }

    const Folder made_{"it's \"a\" name; $(exit 1) `exit 1` & * "};
    const std::filesystem::path& folder_ = made_.path();
};

TEST_F(Python, NamesReachTheScriptAsTheyAreWhateverAShellWouldMakeOfThem)
{
    write("import sys\nopen(sys.argv[4] + '/drawn', 'w').write('\\n'.join(sys.argv[1:]))\n");
    EXPECT_EQ(draw(folder_ / "r 1.json", folder_, false), "");
    std::ifstream file(folder_ / "drawn");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}),
              "plot\n" + (folder_ / "r 1.json").string() + "\n--out\n" + folder_.string());
}

TEST_F(Python, TablesArePrintedOfADocumentThatIsInNoFile)
{
    write(R"(import sys
assert sys.argv[1] == 'show' and open(sys.argv[2]).read() == 'a document', sys.argv
)");
    EXPECT_NO_THROW(print_tables("a document", {}));
    CommonOptions quiet;
    quiet.quiet = true;
    EXPECT_NO_THROW(print_tables("another", quiet));
    testing::internal::CaptureStderr();
    EXPECT_THROW(print_tables("another", {}), Unavailable);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("AssertionError"), std::string::npos);
    std::filesystem::remove(folder_ / "plots" / "__main__.py");
    EXPECT_THROW(print_tables("a document", {}), Unavailable);
}

TEST_F(Python, ErrorsAreTold)
{
    write("raise ValueError('three legs')\n");
    testing::internal::CaptureStderr();
    EXPECT_NE(draw("r.json", folder_, false)
                  .find("__main__.py ended with exit code 1; where Python and matplotlib are"),
              std::string::npos);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("three legs"), std::string::npos);
}

}  // namespace
}  // namespace bvhbench
