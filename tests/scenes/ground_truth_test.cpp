// SPDX-License-Identifier: MIT
#include "scenes/ground_truth.h"

#include "helpers.h"
#include "scenes/generate/derived.h"

namespace bvhbench {
namespace {

/// A tetrahedron without its base, in a given number of frames, as a folder of numbered files.
class Sequence : public Folder {
public:
    explicit Sequence(int frames = 2)
    {
        for (int k = 0; k < frames; ++k)
            file(std::to_string(k + 5) + ".obj",
                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    }

    std::optional<GroundTruth> truth() const
    {
        const Scene scene = load_scene(path().string(), {});
        return ground_truth_of(scene, unique_edges(scene));
    }

    /// Returns the message with which it is refused, after the folder's name.
    std::string refusal() const
    {
        const std::string text = refusal_of<Unavailable>([&] { truth(); }),
                          folder = path().string() + "/";
        EXPECT_TRUE(text.empty() || text.starts_with(path().string())) << text;
        EXPECT_EQ(text.find('\n'), text.npos);
        return text.starts_with(folder) ? text.substr(folder.size()) : text;
    }
};

// Edges are ordered by larger, then smaller vertex: 0-1, 0-2, 1-2, 0-3, 1-3, 2-3. Faces follow the four vertices.
TEST(GroundTruth, IsReadAsPlacesAmongVerticesAndFacesAndAmongEdges)
{
    const Sequence sequence;
    EXPECT_FALSE(sequence.truth());
    sequence.file("gt_vf.csv", "0,1,1\n3,2,0\n");
    sequence.file("gt_ee.csv", "0,1,3,2,1\r\n2,1,3,0,0\r\n");
    const GroundTruth truth = sequence.truth().value();
    EXPECT_EQ(truth.from_frame, 0u);
    EXPECT_EQ(truth.vertex_face, (GroundTruth::Pairs{{0, 5}, {3, 6}}));
    EXPECT_EQ(truth.edge_edge, (GroundTruth::Pairs{{0, 5}, {2, 3}}));
    EXPECT_EQ(truth.touching_vertex_face, (GroundTruth::Pairs{{0, 5}}));
    EXPECT_EQ(truth.touching_edge_edge, (GroundTruth::Pairs{{0, 5}}));
    EXPECT_FALSE(truth.swept_vertex_face || truth.swept_edge_edge);
}

TEST(GroundTruth, IsOfTheStepThatMetaNamesAndIsHeldToItsCounts)
{
    const Sequence sequence(3);
    sequence.file("gt_vf.csv", "0,1,1\n3,2,0\n");
    EXPECT_TRUE(contains(sequence.refusal(), "says between which of its 3 frames"));
    const auto meta = [&](const std::string& more, const std::string& to = "7") {
        sequence.file("meta.json",
                      R"({"ccd": {"from_frame": "6", "to_frame": ")" + to + '"' + more + "}}");
    };
    meta(R"(, "vf_listed": 2, "vf_true": 1, "ee_listed": 0, "swept_vf": 10, "swept_ee": 30)");
    const GroundTruth truth = sequence.truth().value();
    EXPECT_EQ(truth.from_frame, 1u);
    EXPECT_EQ(truth.swept_vertex_face, 10u);
    EXPECT_EQ(truth.swept_edge_edge, 30u);
    meta(R"(, "vf_listed": 3)");
    EXPECT_EQ(sequence.refusal(), "gt_vf.csv has 2 pairs, and meta.json beside it says 3");
    meta(R"(, "vf_true": 2)");
    EXPECT_EQ(sequence.refusal(),
              "gt_vf.csv has 1 pairs that collide, and meta.json beside it says 2");
    meta(R"(, "ee_listed": 1)");
    EXPECT_EQ(sequence.refusal(), "gt_ee.csv has 0 pairs, and meta.json beside it says 1");
    meta("", "5");
    EXPECT_EQ(sequence.refusal(), "meta.json has a 'ccd' whose frames do not follow each other");
    meta("", "8");
    EXPECT_EQ(sequence.refusal(), "meta.json has a 'ccd' whose 'to_frame' is no label of a frame");
    meta(R"(, "swept_vf": "many")");
    EXPECT_EQ(sequence.refusal(), "meta.json has no count 'swept_vf' where one goes");
    sequence.file("meta.json", R"({"ccd": 3})");
    EXPECT_EQ(sequence.refusal(), "meta.json has a 'ccd' that is no object");
    sequence.file("meta.json", "{");
    EXPECT_EQ(sequence.refusal(), "meta.json is not JSON");
}

TEST(GroundTruth, RefusesALineThatItDoesNotUnderstandByItsNumber)
{
    const Sequence sequence;
    const auto vf = [&](const std::string& lines) {
        sequence.file("gt_vf.csv", lines);
        return sequence.refusal();
    };
    EXPECT_EQ(vf("0,1,1\n0,1\n"), "gt_vf.csv line 2: there are 2 numbers where 3 go: '0,1'");
    EXPECT_EQ(vf("0,1,1,1\n"), "gt_vf.csv line 1: there are 4 numbers where 3 go: '0,1,1,1'");
    EXPECT_EQ(vf("0,1,1\n\n0,1,1\n"), "gt_vf.csv line 2: there are 1 numbers where 3 go: ''");
    EXPECT_EQ(vf("4,1,1\n"), "gt_vf.csv line 1: '4' is no vertex, which are 0 to 3");
    EXPECT_EQ(vf("0,3,1\n"), "gt_vf.csv line 1: '3' is no face, which are 0 to 2");
    EXPECT_EQ(vf("-1,1,1\n"), "gt_vf.csv line 1: '-1' is no vertex, which are 0 to 3");
    EXPECT_EQ(vf("99999999999999999999,1,1\n"),
              "gt_vf.csv line 1: '99999999999999999999' is no vertex, which are 0 to 3");
    EXPECT_EQ(vf("vertex,face,collides\n"),
              "gt_vf.csv line 1: 'vertex' is no vertex, which are 0 to 3");
    EXPECT_EQ(vf("0,1,2\n"),
              "gt_vf.csv line 1: '2' is no verdict on a collision, which are 0 to 1");
    EXPECT_EQ(vf("0,1,1\n0,1,\n"),
              "gt_vf.csv line 2: '' is no verdict on a collision, which are 0 to 1");
    vf("");
    sequence.file("gt_ee.csv", "0,1,2,3,1\n0,0,2,3,1\n");
    EXPECT_EQ(sequence.refusal(), "gt_ee.csv line 2: there is no edge from 0 to 0");
}

TEST(GroundTruth, DoesNotHoldForFramesBetweenOrOtherTriangles)
{
    const Sequence sequence;
    sequence.file("gt_vf.csv", "0,1,1\n");
    const Scene scene = load_scene(sequence.path().string(), {});
    EXPECT_TRUE(ground_truth_of(scene, unique_edges(scene)));
    const Scene between = with_frames_between(scene, 1);
    EXPECT_FALSE(ground_truth_of(between, unique_edges(between)));
    const Scene finer = load_scene("refine:" + sequence.path().string() + ":12", {});
    EXPECT_FALSE(ground_truth_of(finer, unique_edges(finer)));
}

}  // namespace
}  // namespace bvhbench
