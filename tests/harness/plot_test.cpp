// SPDX-License-Identifier: MIT
#include "harness/plot.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "geometry/error.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

TEST(Plot, NamesReachTheScriptAsTheyAreWhateverAShellWouldMakeOfThem)
{
    const fs::path folder = fs::temp_directory_path() /
                            ("it's \"a\" name; $(exit 1) `exit 1` & * " + std::to_string(getpid()));
    fs::create_directories(folder / "plots");
    std::ofstream(folder / "plots" / "one.py")
        << "import sys\nopen(sys.argv[3] + '/drawn', 'w').write('\\n'.join(sys.argv[1:]))\n";
    setenv("BVHBENCH_HOME", folder.c_str(), 1);
    EXPECT_EQ(draw("one.py", folder / "r 1.json", folder), "drawn into " + folder.string());
    unsetenv("BVHBENCH_HOME");
    std::ifstream file(folder / "drawn");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}),
              (folder / "r 1.json").string() + "\n--out\n" + folder.string());
    fs::remove_all(folder);
}

TEST(Plot, AScriptEndsWithItsOwnStatusAndOneThatIsNotThereIsNamed)
{
    const fs::path folder = fs::temp_directory_path() / ("plots of " + std::to_string(getpid()));
    fs::create_directories(folder / "plots");
    std::ofstream(folder / "plots" / "two.py") << "import sys\nsys.exit(40 + len(sys.argv))\n";
    setenv("BVHBENCH_HOME", folder.c_str(), 1);
    EXPECT_EQ(run_plots_script("two.py", {"a b", "--"}), 43);
    try {
        run_plots_script("none.py", {});
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Unavailable& error) {
        EXPECT_NE(std::string(error.what()).find("none.py is not there"), std::string::npos);
    }
    unsetenv("BVHBENCH_HOME");
    fs::remove_all(folder);
}

}  // namespace
}  // namespace bvhbench
