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

/// What is said on standard error, and by the Unavailable that is thrown.
template <class Call>
std::string sentence(Call call)
{
    testing::internal::CaptureStderr();
    std::string said = "nothing was thrown";
    try {
        call();
    } catch (const Unavailable& error) {
        said = error.what();
    }
    return testing::internal::GetCapturedStderr() + said;
}

TEST(Plot, APythonThatLacksAModuleIsASentenceAndOtherErrorsAreTold)
{
    const fs::path folder = fs::temp_directory_path() / ("no module " + std::to_string(getpid()));
    fs::create_directories(folder / "plots");
    for (const char* script : {"all.py", "one.py"})
        std::ofstream(folder / "plots" / script) << "def f():\n    import no_such_module\nf()\n";
    std::ofstream(folder / "plots" / "broken.py") << "raise ValueError('three legs')\n";
    setenv("BVHBENCH_HOME", folder.c_str(), 1);
    const std::string lacks = "python3 has no module no_such_module";
    testing::internal::CaptureStderr();
    EXPECT_NE(draw("one.py", "r.json", folder).find(lacks + "; where Python and"),
              std::string::npos);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    for (const std::string& said : {sentence([&] { draw_all({"r.json"}, folder); }),
                                    sentence([] { run_plots_script("one.py", {}); })}) {
        EXPECT_TRUE(said.ends_with(lacks)) << said;
        EXPECT_EQ(said.find("Traceback"), std::string::npos) << said;
    }

    testing::internal::CaptureStderr();
    EXPECT_NE(draw("broken.py", "r.json", folder).find("broken.py ended with 1"),
              std::string::npos);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("three legs"), std::string::npos);
    unsetenv("BVHBENCH_HOME");
    fs::remove_all(folder);
}

}  // namespace
}  // namespace bvhbench
