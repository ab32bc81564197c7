// SPDX-License-Identifier: MIT
#include "cluster/contacts.h"

#include <algorithm>

namespace bvhbench {
namespace {

constexpr std::size_t first_halo_room = 1024;  ///< triangles; grows

/// Writes the entries from `first` on.
template <class T>
void write_from(std::size_t first, const std::vector<T>& all, const Buffer<T>& buffer, Queue& queue)
{
    if (first < all.size())
        queue.cl().enqueueWriteBuffer(buffer.cl(), CL_TRUE, first * sizeof(T),
                                      (all.size() - first) * sizeof(T), &all[first]);
}

}  // namespace

RankContacts::RankContacts(Programs& programs, const PairTest& test)
    : programs_(programs), own_(programs, test), halo_(programs, test)
{}

void RankContacts::take(const Share& share, Queue& queue)
{
    own_points_ = share.points.size();
    own_faces_ = share.faces.size();
    points_ = share.points;
    faces_ = share.faces;
    has_own_ = has_halo_ = false;
    if (own_faces_ == 0)
        return;
    own_.reserve(own_points_, own_faces_);
    halo_.reserve(0, first_halo_room);
    upload_all(first_halo_room, queue);
}

/// Uploads the mesh, with room for a halo of so many triangles behind the rank's own.
void RankContacts::upload_all(std::size_t halo_room, Queue& queue)
{
    const std::size_t points = points_.size(), faces = faces_.size();
    points_.resize(own_points_ + 3 * halo_room);
    faces_.resize(own_faces_ + halo_room);
    input_ = {};
    input_ = upload(programs_.device(), queue, points_, faces_);
    points_.resize(points);
    faces_.resize(faces);
}

void RankContacts::bring(const Share& share, std::span<const HaloTriangle> halo,
                         std::span<const HaloCorners> corners, Queue& queue)
{
    points_.resize(own_points_);
    faces_.resize(own_faces_);
    for (std::size_t k = 0; k < halo.size(); ++k) {
        const Face scene = halo[k].vertices;
        uint placed[3] = {scene.a, scene.b, scene.c};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto own = std::ranges::lower_bound(share.vertices, placed[corner]);
            const bool is_own = own != share.vertices.end() && *own == placed[corner];
            placed[corner] =
                static_cast<uint>(is_own ? own - share.vertices.begin() : std::ssize(points_));
            if (!is_own)
                points_.push_back(corners[k].at[corner]);
        }
        faces_.push_back({placed[0], placed[1], placed[2]});
    }
    if (faces_.size() > input_.device_faces.size())
        upload_all(halo.size() + halo.size() / 8, queue);
    write_from(own_points_, points_, input_.device_points, queue);
    write_from(own_faces_, faces_, input_.device_faces, queue);
    input_.points = points_;
    input_.faces = faces_;
}

void RankContacts::find(const DevicePairs* own, const DevicePairs* with_halo, Queue& queue)
{
    has_own_ = own != nullptr;
    has_halo_ = with_halo != nullptr;
    if (has_own_)
        own_.decide(input_, *own, queue);
    if (has_halo_)
        halo_.decide(input_, *with_halo, queue);
}

std::vector<Pair> RankContacts::contacts(const Queue& queue) const
{
    std::vector<Pair> all;
    if (has_own_)
        all = own_.pairs(queue);
    if (has_halo_) {
        const std::vector<Pair> more = halo_.pairs(queue);
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

std::uint64_t RankContacts::count(const Queue& queue) const
{
    return (has_own_ ? own_.count(queue) : 0) + (has_halo_ ? halo_.count(queue) : 0);
}

}  // namespace bvhbench
