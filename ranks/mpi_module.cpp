// The module that uses MPI (ranks/messenger.h). Uses functions of MPI 3 that Open MPI and MPICH
// both have.
#include "core/version.h"
#include "ranks/messenger.h"

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <list>
#include <utility>
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

/// The tags of exchanged and of posted messages. They let each kind be received separately.
constexpr int exchanged = 0, posted = 1;

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
                MPI_Irecv(piece.data(), length(piece), MPI_BYTE, each.rank, exchanged, all_,
                          &requests_.emplace_back());
            });
        }
        for (const Message& each : out) {
            for_pieces(each.bytes, [&](std::span<std::byte> piece) {
                MPI_Isend(piece.data(), length(piece), MPI_BYTE, each.rank, exchanged, all_,
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

    void post(int rank, std::vector<std::byte> bytes) override {
        drop_sent();
        Posted& last = on_their_way_.emplace_back(std::move(bytes), MPI_REQUEST_NULL);
        MPI_Isend(last.bytes.data(), length(last.bytes), MPI_BYTE, rank, posted, all_,
                  &last.request);
    }

    std::optional<Letter> receive() override {
        drop_sent();
        int has_come = 0, bytes = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, posted, all_, &has_come, &status);
        if (has_come == 0) return std::nullopt;
        MPI_Get_count(&status, MPI_BYTE, &bytes);
        Letter letter{status.MPI_SOURCE, std::vector<std::byte>(static_cast<std::size_t>(bytes))};
        MPI_Recv(letter.bytes.data(), bytes, MPI_BYTE, letter.from, posted, all_,
                 MPI_STATUS_IGNORE);
        return letter;
    }

    void finish() override {
        for (Posted& each : on_their_way_) MPI_Wait(&each.request, MPI_STATUS_IGNORE);
        MPI_Finalize();
    }

    [[noreturn]] void abort(int status) override {
        MPI_Abort(MPI_COMM_WORLD, status);
        std::_Exit(status);
    }

private:
    /// A message that MPI may still be reading.
    struct Posted {
        std::vector<std::byte> bytes;
        MPI_Request request;

        Posted(std::vector<std::byte> text, MPI_Request sent)
            : bytes(std::move(text)), request(sent) {}
    };

    void drop_sent() {
        on_their_way_.remove_if([](Posted& each) {
            int is_sent = 0;
            MPI_Test(&each.request, &is_sent, MPI_STATUS_IGNORE);
            return is_sent != 0;
        });
    }

    void send_from(int rank, std::span<std::byte> bytes) {
        for_pieces(bytes, [&](std::span<std::byte> piece) {
            MPI_Bcast(piece.data(), length(piece), MPI_BYTE, rank, all_);
        });
    }

    MPI_Comm all_ = MPI_COMM_NULL;
    int rank_ = 0, count_ = 1;
    std::vector<MPI_Request> requests_;
    std::vector<int> lengths_, offsets_;
    std::list<Posted> on_their_way_;
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
