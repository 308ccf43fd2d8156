// File descriptors of POSIX systems.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

/// A file descriptor that closes itself. A negative number is none.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }
    /// Leaves the closing to the caller.
    int release() { return std::exchange(number_, -1); }
    /// Closing can be the moment at which a network file system reports a full disk.
    bool close();

private:
    int number_;
};

/// Returns 0 or the error. A write may take a part only.
int write_all(const Descriptor& file, std::string_view bytes);

/// The names in an open folder, in any order; none where it cannot be read.
std::vector<std::string> names_in(const Descriptor& folder);

}  // namespace cascade
