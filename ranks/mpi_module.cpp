// The module that uses MPI (ranks/messenger.h). Uses functions of MPI 3 that Open MPI and MPICH
// both have.
#include "core/version.h"
#include "ranks/messenger.h"

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace cascade {
namespace {

/// Lengths of MPI's messages are of type int, so longer messages are sent in pieces.
constexpr std::size_t most_bytes = std::size_t{1} << 30;

/// Calls `use` for each piece of at most `most_bytes`.
template <typename Use>
void for_pieces(std::span<std::byte> bytes, const Use& use) {
    for (std::size_t begin = 0; begin < bytes.size(); begin += most_bytes) {
        use(bytes.subspan(begin, std::min(most_bytes, bytes.size() - begin)));
    }
}

int length(std::span<const std::byte> bytes) { return static_cast<int>(bytes.size()); }

class MpiMessenger final : public Messenger {
public:
    MpiMessenger() {
        int level = 0;
        // One thread at a time calls MPI.
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
        MPI_Comm_dup(MPI_COMM_WORLD, &all_);
        MPI_Comm_rank(all_, &rank_);
        MPI_Comm_size(all_, &count_);
    }

    int rank() const override { return rank_; }
    int count() const override { return count_; }

    void exchange(std::span<const Message> out, std::span<const Message> in) override {
        requests_.clear();
        for (const Message& each : in) {
            for_pieces(each.bytes, [&](std::span<std::byte> piece) {
                MPI_Irecv(piece.data(), length(piece), MPI_BYTE, each.rank, 0, all_,
                          &requests_.emplace_back());
            });
        }
        for (const Message& each : out) {
            for_pieces(each.bytes, [&](std::span<std::byte> piece) {
                MPI_Isend(piece.data(), length(piece), MPI_BYTE, each.rank, 0, all_,
                          &requests_.emplace_back());
            });
        }
        MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    }

    void complete(std::span<const std::span<std::byte>> blocks) override {
        std::byte* const begin = blocks.front().data();
        const auto bytes =
            static_cast<std::size_t>(blocks.back().data() + blocks.back().size() - begin);
        if (bytes > most_bytes) {
            for (int rank = 0; rank < count_; ++rank) {
                send_from(rank, blocks[static_cast<std::size_t>(rank)]);
            }
            return;
        }
        lengths_.clear();
        offsets_.clear();
        for (const std::span<std::byte> block : blocks) {
            lengths_.push_back(length(block));
            offsets_.push_back(static_cast<int>(block.data() - begin));
        }
        MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, begin, lengths_.data(), offsets_.data(),
                       MPI_BYTE, all_);
    }

    void broadcast(std::span<std::byte> bytes) override { send_from(0, bytes); }

    void finish() override { MPI_Finalize(); }

    [[noreturn]] void abort(int status) override {
        MPI_Abort(MPI_COMM_WORLD, status);
        std::_Exit(status);
    }

private:
    void send_from(int rank, std::span<std::byte> bytes) {
        for_pieces(bytes, [&](std::span<std::byte> piece) {
            MPI_Bcast(piece.data(), length(piece), MPI_BYTE, rank, all_);
        });
    }

    MPI_Comm all_ = MPI_COMM_NULL;
    int rank_ = 0, count_ = 1;
    std::vector<MPI_Request> requests_;
    std::vector<int> lengths_, offsets_;
};

}  // namespace
}  // namespace cascade

extern "C" __attribute__((visibility("default"))) cascade::Messenger* cascade_messenger(
    const char* version) {
    if (cascade::version() != version) return nullptr;
    // Never destroyed, because other objects may use it until the process ends.
    static auto* const messenger = new cascade::MpiMessenger();
    return messenger;
}
