// SPDX-License-Identifier: MIT
#include "cluster/comm_ranks.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

namespace bvhbench {
namespace {

int as_count(std::size_t size)
{
    assert(size <= static_cast<std::size_t>(std::numeric_limits<int>::max()));
    return static_cast<int>(size);
}

class MpiRanks : public HostedRanks {
public:
    MpiRanks(MPI_Comm comm, std::size_t most_at_once, uint most_dense)
        : most_at_once_(most_at_once), most_dense_(most_dense)
    {
        MPI_Comm_dup(comm, &comm_);
        MPI_Comm_set_errhandler(comm_, MPI_ERRORS_ARE_FATAL);
        rank_ = rank_of(comm_);
        count_ = count_of(comm_);
        MPI_Comm of_host = MPI_COMM_NULL;
        MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, as_count(rank_), MPI_INFO_NULL, &of_host);
        local_rank_ = rank_of(of_host);
        local_count_ = count_of(of_host);
        MPI_Comm_free(&of_host);
        std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
        int length = 0;
        MPI_Get_processor_name(name.data(), &length);
        host_.assign(name.data(), static_cast<std::size_t>(length));
    }
    ~MpiRanks() override
    {
        int has_ended = 0;
        MPI_Finalized(&has_ended);
        if (has_ended == 0)
            MPI_Comm_free(&comm_);
    }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    uint rank() const override { return rank_; }
    uint count() const override { return count_; }
    uint local_rank() const override { return local_rank_; }
    uint local_count() const override { return local_count_; }
    const std::string& host() const override { return host_; }

    void end_all(int code) override
    {
        MPI_Abort(comm_, code);
        std::abort();
    }

    void wait_for_all() override { MPI_Barrier(comm_); }

    void sum(std::span<std::uint64_t> values) override
    {
        MPI_Allreduce(MPI_IN_PLACE, values.data(), as_count(values.size()), MPI_UINT64_T, MPI_SUM,
                      comm_);
    }

    void least(std::span<float> values) override
    {
        MPI_Allreduce(MPI_IN_PLACE, values.data(), as_count(values.size()), MPI_FLOAT, MPI_MIN,
                      comm_);
    }

    Bytes gathered(std::span<const std::byte> own) override
    {
        Bytes all(own.size() * count_);
        MPI_Allgather(own.data(), as_count(own.size()), MPI_BYTE, all.data(), as_count(own.size()),
                      MPI_BYTE, comm_);
        return all;
    }

    std::vector<std::uint64_t> exchanged(std::span<const std::uint64_t> to) override
    {
        assert(to.size() == count_);
        if (count_ > most_dense_)
            return exchanged_sparsely(to);
        std::vector<std::uint64_t> from(count_);
        MPI_Alltoall(to.data(), 1, MPI_UINT64_T, from.data(), 1, MPI_UINT64_T, comm_);
        return from;
    }

    void exchange(std::span<const std::span<const std::byte>> to,
                  std::span<const std::span<std::byte>> from) override
    {
        assert(to.size() == count_ && from.size() == count_);
        std::vector<MPI_Request> requests;
        const auto in_pieces = [&](auto bytes, const auto& begin) {
            for (std::size_t first = 0; first < bytes.size(); first += most_at_once_)
                begin(bytes.data() + first, as_count(std::min(most_at_once_, bytes.size() - first)),
                      &requests.emplace_back());
        };
        for (uint k = 1; k < count_; ++k) {
            const uint source = (rank_ + count_ - k) % count_;
            in_pieces(from[source], [&](std::byte* at, int size, MPI_Request* request) {
                MPI_Irecv(at, size, MPI_BYTE, as_count(source), 0, comm_, request);
            });
        }
        for (uint k = 1; k < count_; ++k) {
            const uint target = (rank_ + k) % count_;
            in_pieces(to[target], [&](const std::byte* at, int size, MPI_Request* request) {
                MPI_Isend(at, size, MPI_BYTE, as_count(target), 0, comm_, request);
            });
        }
        MPI_Waitall(as_count(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    }

private:
    static constexpr int data_tag = 0;  ///< of messages in pieces
    static constexpr int size_tag = 1;  ///< and one more in every other exchange

    /// Sends only the numbers that are not 0. A rank enters the barrier when all that it sent has arrived, so when all ranks have
    /// entered it nothing is on its way [Hoefler2010]. A fast rank may then be in the next exchange already: its tag differs.
    std::vector<std::uint64_t> exchanged_sparsely(std::span<const std::uint64_t> to)
    {
        const int tag = size_tag + static_cast<int>(sparse_exchanges_++ % 2);
        std::vector<std::uint64_t> from(count_);
        from[rank_] = to[rank_];
        std::vector<MPI_Request> sends;
        for (uint rank = 0; rank < count_; ++rank)
            if (rank != rank_ && to[rank] != 0)
                MPI_Issend(&to[rank], 1, MPI_UINT64_T, as_count(rank), tag, comm_,
                           &sends.emplace_back());
        MPI_Request barrier = MPI_REQUEST_NULL;
        for (int has_entered = 0, is_over = 0; is_over == 0;) {
            int is_there = 0;
            MPI_Status status;
            MPI_Iprobe(MPI_ANY_SOURCE, tag, comm_, &is_there, &status);
            if (is_there != 0)
                MPI_Recv(&from[static_cast<uint>(status.MPI_SOURCE)], 1, MPI_UINT64_T,
                         status.MPI_SOURCE, tag, comm_, MPI_STATUS_IGNORE);
            if (has_entered != 0) {
                MPI_Test(&barrier, &is_over, MPI_STATUS_IGNORE);
                continue;
            }
            MPI_Testall(as_count(sends.size()), sends.data(), &has_entered, MPI_STATUSES_IGNORE);
            if (has_entered != 0)
                MPI_Ibarrier(comm_, &barrier);
        }
        return from;
    }

    static uint rank_of(MPI_Comm comm)
    {
        int rank = 0;
        MPI_Comm_rank(comm, &rank);
        return static_cast<uint>(rank);
    }
    static uint count_of(MPI_Comm comm)
    {
        int count = 0;
        MPI_Comm_size(comm, &count);
        return static_cast<uint>(count);
    }

    MPI_Comm comm_ = MPI_COMM_NULL;
    std::size_t most_at_once_;
    uint most_dense_;
    uint sparse_exchanges_ = 0;
    uint rank_ = 0, count_ = 0, local_rank_ = 0, local_count_ = 0;
    std::string host_;
};

/// MPI from its start to its end.
struct MpiRun {
    MpiRun() { MPI_Init(nullptr, nullptr); }
    ~MpiRun() { MPI_Finalize(); }
    MpiRun(const MpiRun&) = delete;
    MpiRun& operator=(const MpiRun&) = delete;
};

/// All processes of an MPI that this object starts and ends.
class AllRanks final : MpiRun, public MpiRanks {
public:
    AllRanks(std::size_t most_at_once, uint most_dense)
        : MpiRanks(MPI_COMM_WORLD, most_at_once, most_dense)
    {}
};

}  // namespace

std::unique_ptr<HostedRanks> ranks_of(MPI_Comm comm)
{
    return std::make_unique<MpiRanks>(comm, usual_most_at_once, usual_most_dense);
}

std::string mpi_absent() { return {}; }

std::string mpi_version()
{
    std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
    int length = 0;
    MPI_Get_library_version(text.data(), &length);
    const std::string all(text.data(), static_cast<std::size_t>(length));
    return all.substr(0, all.find(','));
}

std::unique_ptr<HostedRanks> start_mpi(std::size_t most_at_once, uint most_dense)
{
    return std::make_unique<AllRanks>(most_at_once, most_dense);
}

}  // namespace bvhbench
