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

TEST(Python, NamesReachTheScriptAsTheyAreWhateverAShellWouldMakeOfThem)
{
    const fs::path folder = fs::temp_directory_path() /
                            ("it's \"a\" name; $(exit 1) `exit 1` & * " + std::to_string(getpid()));
    fs::create_directories(folder / "plots");
    std::ofstream(folder / "plots" / "one.py")
        << "import sys\nopen(sys.argv[3] + '/drawn', 'w').write('\\n'.join(sys.argv[1:]))\n";
    setenv("BVHBENCH_HOME", folder.c_str(), 1);
    EXPECT_EQ(draw("one.py", folder / "r 1.json", folder, false), "drawn into " + folder.string());
    unsetenv("BVHBENCH_HOME");
    std::ifstream file(folder / "drawn");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}),
              (folder / "r 1.json").string() + "\n--out\n" + folder.string());
    fs::remove_all(folder);
}

TEST(Python, TablesArePrintedOfADocumentThatIsInNoFile)
{
    const fs::path folder = fs::temp_directory_path() / ("tables of " + std::to_string(getpid()));
    fs::create_directories(folder / "plots");
    std::ofstream(folder / "plots" / "__main__.py")
        << "import sys\nassert sys.argv[1] == 'show' and open(sys.argv[2]).read() == 'a document', "
           "sys.argv\n";
    setenv("BVHBENCH_HOME", folder.c_str(), 1);
    EXPECT_NO_THROW(print_tables("a document"));
    testing::internal::CaptureStderr();
    EXPECT_THROW(print_tables("another"), Unavailable);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("AssertionError"), std::string::npos);
    fs::remove(folder / "plots" / "__main__.py");
    EXPECT_THROW(print_tables("a document"), Unavailable);
    unsetenv("BVHBENCH_HOME");
    fs::remove_all(folder);
}

TEST(Python, APythonThatLacksAModuleIsASentenceAndOtherErrorsAreTold)
{
    const fs::path folder = fs::temp_directory_path() / ("no module " + std::to_string(getpid()));
    fs::create_directories(folder / "plots");
    for (const char* script : {"all.py", "one.py"})
        std::ofstream(folder / "plots" / script) << "def f():\n    import no_such_module\nf()\n";
    std::ofstream(folder / "plots" / "broken.py") << "raise ValueError('three legs')\n";
    setenv("BVHBENCH_HOME", folder.c_str(), 1);
    const std::string lacks = "python3 has no module no_such_module";
    testing::internal::CaptureStderr();
    EXPECT_NE(draw("one.py", "r.json", folder, false).find(lacks + "; where Python and"),
              std::string::npos);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    testing::internal::CaptureStderr();
    EXPECT_NE(draw("broken.py", "r.json", folder, false).find("broken.py ended with 1"),
              std::string::npos);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("three legs"), std::string::npos);
    unsetenv("BVHBENCH_HOME");
    fs::remove_all(folder);
}

}  // namespace
}  // namespace bvhbench
