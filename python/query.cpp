// SPDX-License-Identifier: MIT
#include "python/query.h"

namespace bvhbench::python {
namespace {

oibvh::Among among_of(const std::string& word)
{
    if (word == "all")
        return oibvh::Among::all;
    if (word == "between")
        return oibvh::Among::between_objects;
    if (word == "within")
        return oibvh::Among::within_objects;
    throw oibvh::BadInput("a query is among 'all', 'between' or 'within', not '" + word + "'");
}

Numbers rows(std::size_t count) { return Numbers({count, std::size_t{2}}); }

}  // namespace

Numbers array_of(const OpenDevice& on, const oibvh::Pairs& found)
{
    Numbers array = rows(found.count);
    if (found.count == 0)
        return array;
    void* const to = array.mutable_data();
    const cl_int code = without_gil([&] {
        return clEnqueueReadBuffer(on.queue(), found.pairs, CL_TRUE, 0,
                                   found.count * sizeof(oibvh::Pair), to, 0, nullptr, nullptr);
    });
    if (code != CL_SUCCESS)
        throw oibvh::OpenClFailure("the pairs could not be read", code);
    return array;
}

Numbers ask(const OpenDevice& on, oibvh::Tree& tree, const Query& query)
{
    const oibvh::Among among = among_of(query.among);
    const oibvh::Filter filter = {.excluded = values_of<oibvh::Excluded>(query.excluded),
                                  .groups = values_of<std::uint32_t>(query.groups),
                                  .masks = values_of<std::uint32_t>(query.masks)};
    if (query.answer == "first") {
        const std::optional<oibvh::Pair> hit =
            without_gil([&] { return tree.first_contact(among, filter); });
        Numbers array = rows(hit ? 1 : 0);
        if (hit) {
            array.mutable_at(0, 0) = hit->a;
            array.mutable_at(0, 1) = hit->b;
        }
        return array;
    }
    return array_of(on, without_gil([&] {
                        if (query.answer == "within")
                            return tree.find_within(query.distance, among, filter);
                        return query.answer == "contacts" ? tree.find_contacts(among, filter)
                                                          : tree.find_pairs(among, filter);
                    }));
}

}  // namespace bvhbench::python
