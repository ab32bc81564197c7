// SPDX-License-Identifier: MIT
#include "cluster/point_routes.h"

#include <algorithm>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// A vertex, and its place in a list of a rank.
struct Entry {
    uint vertex, place;
};

/// A vertex that a rank gives.
struct Giver {
    uint vertex, rank, place;
};

/// Tells a rank to send the point at `from`, of those that it has, to a rank, which puts it at `to`.
struct Order {
    uint from, rank, to;
};

/// Sends each vertex, with its place, to the rank that keeps the list of such vertices. Returns what this rank keeps, by rank.
std::vector<std::vector<Entry>> at_keepers(std::span<const uint> vertices, Ranks& ranks)
{
    std::vector<std::vector<Entry>> to(ranks.count());
    for (std::size_t k = 0; k < vertices.size(); ++k)
        to[vertices[k] % ranks.count()].push_back({vertices[k], static_cast<uint>(k)});
    return exchanged(ranks, std::move(to));
}

/// Returns who gives each vertex, ascending: of equal vertices the first one is of the lowest rank.
std::vector<Giver> sorted(const std::vector<std::vector<Entry>>& given)
{
    std::vector<Giver> all;
    for (uint rank = 0; rank < given.size(); ++rank)
        for (const Entry& one : given[rank])
            all.push_back({one.vertex, rank, one.place});
    std::ranges::stable_sort(all, {}, &Giver::vertex);
    return all;
}

}  // namespace

PointRoutes::PointRoutes(std::span<const uint> given, const Share& share, Ranks& ranks)
    : share_points_(share.points.size()), leaving_(ranks.count())
{
    const std::vector<Giver> givers = sorted(at_keepers(given, ranks));
    const std::vector<std::vector<Entry>> wanted = at_keepers(share.vertices, ranks);
    std::vector<std::vector<Order>> orders(ranks.count());
    for (uint rank = 0; rank < wanted.size(); ++rank)
        for (const Entry& one : wanted[rank]) {
            const auto giver = std::ranges::lower_bound(givers, one.vertex, {}, &Giver::vertex);
            if (giver == givers.end() || giver->vertex != one.vertex)
                throw BadUsage("no rank gives vertex " + std::to_string(one.vertex));
            orders[giver->rank].push_back({giver->place, rank, one.place});
        }
    std::vector<std::vector<uint>> places(ranks.count());
    for (const std::vector<Order>& of_keeper : exchanged(ranks, std::move(orders)))
        for (const Order& order : of_keeper) {
            leaving_[order.rank].push_back(order.from);
            places[order.rank].push_back(order.to);
        }
    arriving_ = exchanged(ranks, std::move(places));
}

std::vector<Point> PointRoutes::sent(std::span<const Point> points, Ranks& ranks) const
{
    std::vector<std::vector<Point>> to(leaving_.size());
    for (std::size_t rank = 0; rank < to.size(); ++rank) {
        to[rank].reserve(leaving_[rank].size());
        for (const uint place : leaving_[rank])
            to[rank].push_back(points[place]);
    }
    const std::vector<std::vector<Point>> from = exchanged(ranks, std::move(to));
    std::vector<Point> of_share(share_points_);
    for (std::size_t rank = 0; rank < from.size(); ++rank)
        for (std::size_t k = 0; k < from[rank].size(); ++k)
            of_share[arriving_[rank][k]] = from[rank][k];
    return of_share;
}

}  // namespace bvhbench
