// SPDX-License-Identifier: MIT
#include "harness/base/terminal.h"

#include <gtest/gtest.h>

namespace bvhbench {
namespace {

TEST(Printable, SpellsOutWhatATerminalObeys)
{
    EXPECT_EQ(printable("a\tb\n\x1b[31m"), "a\tb\n\\x1b[31m");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m\xc2\x85"),
              "\\x9b31m\\x85");
    EXPECT_EQ(printable("\xe2\x80\xae"
                        "c\xe2\x81\xa6"
                        "d"),
              "\\u202ec\\u2066d");
    EXPECT_EQ(printable("\x9b"
                        "31m\xc0\x9b"),
              "\\x9b31m\\x1b");
}

TEST(Printable, KeepsTextAndBytesThatNoTerminalObeys)
{
    for (const char* text : {"", "äß€𝕊", "\xe4", "\xe2\x80", "caf\xc3"})
        EXPECT_EQ(printable(text), text == std::string("\xe2\x80") ? "\xe2\\x80" : text);
}

TEST(SoFar, HasTheTimeToGoOnceSomethingIsDone)
{
    EXPECT_EQ(so_far("the oracle", 3, 0, 0), "the oracle, 3 s");
    EXPECT_EQ(so_far("the oracle", 10, 100, 400),
              "the oracle, about 30 s left, 100 of 400 are done");
    EXPECT_EQ(so_far("the oracle", 10, 1, 61), "the oracle, about 10 min left, 1 of 61 are done");
}

}  // namespace
}  // namespace bvhbench
