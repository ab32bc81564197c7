// SPDX-License-Identifier: MIT
#include "builders/input.h"

#include <vector>

#include "tests/refusal.h"

namespace bvhbench {
namespace {

struct TwoTriangles {
    std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    std::vector<Face> faces = {{0, 1, 2}, {1, 3, 2}};
};

std::string refusal(const Device& device, const TwoTriangles& mesh,
                    const std::vector<FaceRange>& objects = {})
{
    const Queue queue(device);
    return refusal_of([&] { upload(device, queue, mesh.points, mesh.faces, objects); });
}

TEST(Input, IsRefusedInOneSentenceWhereAPartIsMoreThanAnAllocation)
{
    Device device = open_device("");
    const TwoTriangles mesh;  // points of 48 bytes, faces of 24, owners of 8
    device.allocation_limit = 48;
    EXPECT_EQ(refusal(device, mesh), "");
    EXPECT_EQ(*device.taken, 0u);
    device.allocation_limit = 47;
    EXPECT_EQ(refusal(device, mesh), "out of device memory: 48 bytes are needed in one piece, " +
                                         device.name() + " gives 47");
    EXPECT_EQ(*device.taken, 0u);
}

TEST(Input, OfSeveralObjectsSaysWhoseATriangleIs)
{
    const Device device = open_device("");
    const Queue queue(device);
    const TwoTriangles mesh;
    const std::vector<FaceRange> objects = {{0, 1}, {1, 1}};
    const Input input = upload(device, queue, mesh.points, mesh.faces, objects);
    EXPECT_EQ(input.device_owners.download(queue.cl()), (std::vector<uint>{0, 1}));
    EXPECT_EQ(input.objects, objects);
    EXPECT_EQ(*device.taken, 48u + 24u + 8u);
}

}  // namespace
}  // namespace bvhbench
