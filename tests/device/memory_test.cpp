// SPDX-License-Identifier: MIT
#include <numeric>

#include "device/arena.h"
#include "tests/device/testing.h"

namespace bvhbench {
namespace {

/// A plan of arena pieces, as builders write one.
struct Pieces {
    Buffer<cl_uint> a, b;
    Buffer<cl_uchar> c;
};
Pieces take(Arena& arena)
{
    return {arena.take<cl_uint>(1000, Use::tree), arena.take<cl_uint>(3, Use::scratch),
            arena.take<cl_uchar>(5, Use::tree)};
}

using ArenaOfADevice = OnDevice;

TEST_F(ArenaOfADevice, PredictsWhatItHandsOut)
{
    Arena measuring = Arena::measuring(device);
    EXPECT_EQ(take(measuring).a.cl()(), nullptr) << "measuring allocates nothing";
    EXPECT_EQ(measuring.used().tree_bytes, 4005u);
    EXPECT_GE(measuring.used().scratch_bytes, 12u);

    Arena arena = Arena::reserved(device, measuring.used());
    take(arena);
    EXPECT_EQ(arena.used(), measuring.used());
    EXPECT_THROW(arena.take<cl_uchar>(1, Use::scratch), std::logic_error);
}

TEST_F(ArenaOfADevice, HandsOutPiecesThatDoNotOverlap)
{
    Arena measuring = Arena::measuring(device);
    take(measuring);
    Arena arena = Arena::reserved(device, measuring.used());
    Pieces pieces = take(arena);

    std::vector<cl_uint> values(1000);
    std::iota(values.begin(), values.end(), 7u);
    pieces.a.upload(queue.cl(), values);
    pieces.b.upload(queue.cl(), std::vector<cl_uint>{1, 2, 3});
    pieces.c.upload(queue.cl(), std::vector<cl_uchar>(5, cl_uchar{9}));
    EXPECT_EQ(pieces.a.download(queue.cl()), values);
    EXPECT_EQ(pieces.b.download(queue.cl()), (std::vector<cl_uint>{1, 2, 3}));
    EXPECT_EQ(pieces.c.download(queue.cl()), std::vector<cl_uchar>(5, cl_uchar{9}));
}

TEST_F(ArenaOfADevice, HasRoomForNoMoreThanAnAllocationHoldsUnlessItIsNeeded)
{
    device.allocation_limit = 4000;
    EXPECT_EQ(device.room_for(100, 16), 100u);
    EXPECT_EQ(device.room_for(1000, 16), 250u) << "a guess is cut";
    EXPECT_EQ(device.room_for(1000, 16, 300), 300u)
        << "a need is not: it is refused when it is taken";
    EXPECT_EQ(device.room_for(std::uint64_t{1} << 40, 1), 4000u);
}

TEST_F(ArenaOfADevice, AllocatesPieceByPieceWhatTheDeviceDoesNotAtOnce)
{
    device.allocation_limit = 4000;
    Arena measuring = Arena::measuring(device);
    take(measuring);
    ASSERT_GT(measuring.used().total(), device.most_at_once());
    Arena arena = Arena::reserved(device, measuring.used());
    Pieces pieces = take(arena);
    EXPECT_EQ(arena.used(), measuring.used());
    EXPECT_EQ(*device.taken, measuring.used().total());

    pieces.a.upload(queue.cl(), std::vector<cl_uint>(1000, 7));
    pieces.b.upload(queue.cl(), std::vector<cl_uint>{1, 2, 3});
    EXPECT_EQ(pieces.a.download(queue.cl()), std::vector<cl_uint>(1000, 7));
    EXPECT_EQ(pieces.b.download(queue.cl()), (std::vector<cl_uint>{1, 2, 3}));

    device.allocation_limit = 3999;
    Arena small = Arena::reserved(device, measuring.used());
    expect_sentence(refusal_of([&] { take(small); }),
                    {"4000 bytes are needed in one piece", "gives 3999"});
}

TEST_F(ArenaOfADevice, GivesEmptyPiecesWithoutMemory)
{
    Arena arena = Arena::reserved(device, {});
    const Buffer<cl_uint> none = arena.take<cl_uint>(0, Use::tree);
    EXPECT_EQ(none.size(), 0u);
    EXPECT_TRUE(none.download(queue.cl()).empty());
}

}  // namespace
}  // namespace bvhbench
