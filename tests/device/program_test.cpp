// SPDX-License-Identifier: MIT
#include "device/program.h"

#include "tests/device/testing.h"

namespace bvhbench {
namespace {

class Compiling : public OnDeviceWithKernels {};

TEST(Sources, IncludeEachFileOnceAndKeepItsLines)
{
    const Folder folder;
    folder.file("a.h", "int a;\n");
    folder.file("b.h", "#include \"a.h\"\nint b;\n");
    folder.file("k.cl", "#include \"a.h\"\n#include \"b.h\"\nint k;\n");
    folder.file("gone.cl", "#include \"gone.h\"\n");
    const Sources sources = Sources::tree(folder.path());
    EXPECT_EQ(sources.flatten({"k.cl"}),
              "#line 1 \"k.cl\"\n#line 1 \"a.h\"\nint a;\n#line 2 \"k.cl\"\n#line 1 \"b.h\"\n"
              "#line 2 \"b.h\"\nint b;\n#line 3 \"k.cl\"\nint k;\n");
    // A header put before a file that does not include it.
    EXPECT_EQ(sources.flatten({"b.h", "k.cl"}),
              "#line 1 \"b.h\"\n#line 1 \"a.h\"\nint a;\n#line 2 \"b.h\"\nint b;\n"
              "#line 1 \"k.cl\"\n#line 2 \"k.cl\"\n#line 3 \"k.cl\"\nint k;\n");
    EXPECT_EQ(refusal_of([&] { sources.flatten({"gone.cl"}); }),
              "kernel source 'gone.h' is not there");
}

TEST(Sources, AreEmbeddedInTheProgram)
{
    EXPECT_EQ(Sources::embedded().origin(), "embedded");
    EXPECT_TRUE(contains(Sources::embedded().flatten({"device/limits.cl"}), "kernel void"));
}

TEST_F(Compiling, CompileOnceForTheSameTextAndDefines)
{
    folder.file("k.cl", "kernel void k(global uint* out) { out[0] = VALUE; }\n");
    programs.kernel("k.cl", "k", {{"VALUE", 1}});
    const std::int64_t once = programs.compile_ns();
    EXPECT_GT(once, 0);
    programs.kernel("k.cl", "k", {{"VALUE", 1}});
    EXPECT_EQ(programs.compile_ns(), once);
    programs.kernel("k.cl", "k", {{"VALUE", 2}});
    EXPECT_GT(programs.compile_ns(), once);
}

TEST_F(Compiling, FailWithTheFileTheLineAndTheOptions)
{
    folder.file("k.cl", "kernel void k()\n{\n    nonsense();\n}\n");
    try {
        programs.kernel("k.cl", "k", {{"GROUP_SIZE", 64}});
        FAIL() << "it built";
    } catch (const BuildFailure& failure) {
        const std::string message = failure.what();
        EXPECT_TRUE(contains(message, "k.cl did not build with -cl-std=CL1.2"));
        EXPECT_NE(message.find("GROUP_SIZE=64u"), std::string::npos) << message;
        // NVIDIA's driver (580.159) ignores #line directives and counts the directive itself as line 1.
        const bool has_line = message.find("k.cl:3") != std::string::npos ||
                              message.find("<kernel>:4") != std::string::npos;
        EXPECT_TRUE(has_line) << message;
    }
}

TEST_F(Compiling, DeclareBuiltInFunctionsThemselvesOnPoclAlone)
{
    folder.file("k.cl",
                "#ifdef BVHBENCH_DEVICE_BUILTINS_CLH\nkernel void ours() {}\n#else\n"
                "kernel void theirs() {}\n#endif\n");
    const cl::Platform platform(device.cl.getInfo<CL_DEVICE_PLATFORM>());
    const bool is_pocl =
        platform.getInfo<CL_PLATFORM_VERSION>().find("PoCL 3.1") != std::string::npos;
    Programs three(device, "CL3.0");
    EXPECT_NO_THROW(programs.kernel("k.cl", is_pocl ? "ours" : "theirs"));
    EXPECT_NO_THROW(is_pocl ? three.kernel("k.cl", "theirs") : cl::Kernel());
}

TEST_F(Compiling, BuildWithFunctionsThatAreNotDeclaredToo)
{
    folder.file("k.cl",
                "kernel void k(global float* out) { out[0] = sqrt(out[0]) + mad24(2, 3, 4); }\n");
    cl::Kernel kernel = programs.kernel("k.cl", "k");
    auto out = buffer<float>(1);
    const float nine = 9;
    out.upload(queue.cl(), {&nine, 1});
    set_arguments(kernel, out);
    queue.begin("k");
    queue.launch(kernel, 1, 1, 8);
    queue.finish();
    EXPECT_EQ(out.download(queue.cl()).front(), 13.0f);
}

}  // namespace
}  // namespace bvhbench
