// File descriptors of POSIX systems.
#pragma once

#include <string_view>

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
    /// Closing can be the moment at which a network file system reports a full disk.
    bool close();

private:
    int number_;
};

/// Returns 0 or the error. A write may take a part only.
int write_all(const Descriptor& file, std::string_view bytes);

}  // namespace cascade
