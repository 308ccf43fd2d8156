// Messages between the ranks of a run: processes that share its steps, perhaps on several machines.
//
// The calls of exchange(), complete(), broadcast() and finish() are collective: all ranks make them
// in the same order. Messages are only copied and never added, because the order in which an MPI
// library adds numbers depends on the library and on the number of ranks.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

class Messenger {
public:
    /// A message to or from another rank.
    struct Message {
        int rank = 0;
        std::span<std::byte> bytes;  ///< The bytes to send, or the memory for received bytes.
    };

    /// A message that another rank has posted.
    struct Letter {
        int from = 0;
        std::vector<std::byte> bytes;
    };

    virtual ~Messenger() = default;
    Messenger() = default;
    Messenger(const Messenger&) = delete;
    Messenger& operator=(const Messenger&) = delete;

    virtual int rank() const = 0;   ///< The number of this process, counted from 0.
    virtual int count() const = 0;  ///< The number of processes.

    /// Sends and receives messages. Messages between two ranks arrive in the order in which both
    /// list them, and have the same lengths on both sides.
    virtual void exchange(std::span<const Message> out, std::span<const Message> in) = 0;
    /// Completes a piece of memory that consists of a block for each rank. Before the call, each
    /// rank has set its own block. Afterwards every rank has all blocks. The blocks must follow
    /// each other in memory.
    virtual void complete(std::span<const std::span<std::byte>> blocks) = 0;
    /// Copies bytes of rank 0 to all ranks.
    virtual void broadcast(std::span<std::byte> bytes) = 0;

    /// Sends a message without waiting until it is received. Any rank may call it at any time.
    virtual void post(int rank, std::vector<std::byte> bytes) = 0;
    /// Returns the next posted message of any rank. Empty if none has arrived. Messages of one rank
    /// arrive in the order in which the rank has posted them. Every posted message must be received
    /// before finish().
    virtual std::optional<Letter> receive() = 0;

    /// Ends the communication. Waits until all ranks have called this function.
    virtual void finish() = 0;
    /// Ends all ranks at once, and gives the launcher this exit status, which must be from 1 to
    /// 255. Any rank may call it at any time.
    [[noreturn]] virtual void abort(int status) = 0;
};

/// The name of the MPI module's only symbol. It is a function that takes the version of its caller
/// and returns the messenger of this process, or null if the module has another version. The first
/// call initialises MPI.
inline constexpr const char* messenger_symbol = "cascade_messenger";
using MessengerEntry = Messenger*(const char* version);

}  // namespace cascade
