// POSIX file descriptors.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

/// Closes a file descriptor in its destructor. A negative number means that there is no file.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }
    /// Gives up ownership: the caller closes it.
    int release() { return std::exchange(number_, -1); }
    /// Returns false on an error: a network file system may report a full disk only on closing.
    bool close();

private:
    int number_;
};

/// Writes all bytes, in several calls if need be. Returns 0 or the error number.
int write_all(const Descriptor& file, std::string_view bytes);

/// The names in an open folder, in any order. Empty if the folder cannot be read.
std::vector<std::string> names_in(const Descriptor& folder);

}  // namespace cascade
