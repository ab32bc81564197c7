// SPDX-License-Identifier: MIT
#include "library_cluster/together.h"

#include <algorithm>
#include <new>
#include <string>
#include <vector>

#include "library/device.h"

namespace bvhbench::oibvh {
namespace {

enum class Kind { none, bad_input, unavailable, opencl };

/// What is told of a rank's failure besides its sentence.
struct Mark {
    Kind kind = Kind::none;
    cl_int code = 0;  ///< of OpenCL
};

struct Failure {
    Mark mark;
    std::string sentence;
};

/// Returns the exception being handled.
Failure failure()
{
    try {
        rethrow_as_error();
    } catch (const BadInput& error) {
        return {{Kind::bad_input}, error.what()};
    } catch (const OpenClFailure& error) {
        return {{Kind::opencl, error.code()}, error.what()};
    } catch (const std::bad_alloc&) {
        return {{Kind::unavailable}, "the host has too little memory"};
    } catch (const std::exception& error) {
        return {{Kind::unavailable}, error.what()};
    }
}

[[noreturn]] void throw_error(const Failure& failure)
{
    switch (failure.mark.kind) {
        case Kind::bad_input:
            throw BadInput(failure.sentence);
        case Kind::opencl:
            throw OpenClFailure(failure.sentence, failure.mark.code);
        default:
            throw Unavailable(failure.sentence);
    }
}

/// Throws the failure of the lowest rank that failed, with its rank unless all ranks failed alike.
[[noreturn]] void throw_alike(const Failure& own, Ranks& ranks)
{
    const std::vector<Mark> marks = gathered<Mark>(ranks, std::span<const Mark>(&own.mark, 1));
    const std::vector<char> text(own.sentence.begin(), own.sentence.end());
    const std::vector<std::vector<char>> texts = exchanged(ranks, std::vector(ranks.count(), text));
    const auto first =
        std::ranges::find_if(marks, [](const Mark& mark) { return mark.kind != Kind::none; });
    const auto rank = static_cast<std::size_t>(first - marks.begin());
    const std::string sentence(texts[rank].begin(), texts[rank].end());
    const bool is_of_all =
        std::ranges::all_of(texts, [&](const auto& other) { return other == texts[rank]; });
    throw_error({*first, is_of_all ? sentence : "rank " + std::to_string(rank) + ": " + sentence});
}

}  // namespace

void together(AgreeingRanks& ranks, const std::function<void()>& work)
{
    Failure own;
    try {
        work();
        if (!ranks.any_failed(false))
            return;
    } catch (const OtherRankFailed&) {
    } catch (...) {
        own = failure();
        ranks.any_failed(true);
    }
    throw_alike(own, ranks);
}

}  // namespace bvhbench::oibvh
