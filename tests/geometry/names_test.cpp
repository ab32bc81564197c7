// SPDX-License-Identifier: MIT
#include "geometry/names.h"

#include <gtest/gtest.h>

namespace bvhbench {
namespace {

constexpr std::string_view known[] = {"karras", "oibvh-multi", "oibvh-single", "kd", "torus:N"};

TEST(Names, NearestIsWhatAFewEditsLeadTo)
{
    const auto nearest = [](std::string_view name) { return nearest_name(name, known); };
    EXPECT_EQ(nearest("kaaras"), "karras");
    EXPECT_EQ(nearest("karas"), "karras");
    EXPECT_EQ(nearest("oibvh-sinlge"), "oibvh-single");
    EXPECT_EQ(nearest("oibvh-mutli"), "oibvh-multi");
    EXPECT_EQ(nearest("tors:100000"), "torus:N") << "sizes are not compared";
    EXPECT_EQ(nearest("dk"), "kd") << "a swap is one edit";
    for (const char* far : {"", "x", "embree", "brute", "oibvh"})
        EXPECT_EQ(nearest(far), "") << far;
    EXPECT_EQ(nearest_name("karras", {}), "");
}

TEST(Names, ASentenceHasTheNamesAndTheNearest)
{
    EXPECT_EQ(there_are("kaaras", std::span(known).first(2)),
              "; there are: karras, oibvh-multi; did you mean 'karras'?");
    const std::vector<std::string_view> many(13, "karras");
    EXPECT_EQ(there_are("karas", many), "; did you mean 'karras'?");
    EXPECT_EQ(there_are("x", std::span(known).first(2), "or all"),
              "; there are: karras, oibvh-multi, or all");
    const std::string_view summaries[] = {"LBVH [Karras2012]", "of several", "LBVH"};
    EXPECT_EQ(there_are("lbvh", std::span(known).first(3), {}, summaries),
              "; there are: karras, oibvh-multi, oibvh-single; did you mean one of: karras, "
              "oibvh-single");
    EXPECT_EQ(there_are("Karras, 2012", std::span(known).first(3), {}, summaries),
              "; there are: karras, oibvh-multi, oibvh-single; did you mean one of: karras");
    struct Entry {
        std::string_view name;
    };
    const Entry entries[] = {{"leaf"}, {"group"}};
    EXPECT_EQ(&find_called(entries, "group", "collider"), &entries[1]);
    EXPECT_EQ(find_name(entries, "gruop"), nullptr);
    EXPECT_THROW(find_called(entries, "gruop", "collider"), BadUsage);
}

}  // namespace
}  // namespace bvhbench
