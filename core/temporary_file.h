// New files under names of their own, which take their final name when they are complete.
//
// A name is drawn by the system's random numbers and not made of a process's number: containers
// that share a folder all call their process 1, and a file that a killed one left would stand in
// the way of the next. While its writer lives, a temporary file is locked (flock), so that what
// killed processes left can be told from what is being written.
#pragma once

#include "core/descriptor.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace cascade {

/// 32 hexadecimal digits that nobody can guess.
std::string random_digits();

/// The descriptor of a folder, good for naming files in it and nothing else; negative, with errno,
/// where there is no such folder.
int open_folder(const std::filesystem::path& folder);

class TemporaryFile {
public:
    static constexpr std::string_view usual_ending = ".tmp";

    /// Makes an empty file in an open folder. The umask holds for its mode.
    explicit TemporaryFile(const Descriptor& folder, mode_t mode = 0666,
                           std::string_view ending = usual_ending);
    /// Removes the file, unless it was given a name or is to stay.
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    /// Why there is none; 0 where it was made.
    int error() const { return error_; }
    const Descriptor& file() const { return file_; }
    const std::string& name() const { return name_; }

    /// Writes everything and brings it to the disk. Returns 0 or the error.
    int write(std::string_view bytes);
    /// Closes it; it takes this name in the folder, in place of any other file. Returns 0 or the
    /// error.
    int rename_to(const std::string& name);
    /// Closes it; it outlives this object under its own name. Returns 0 or the error.
    int stay();

private:
    const Descriptor& folder_;
    std::string name_;
    Descriptor file_;
    bool is_ours_ = false;  ///< It is there, and nobody was told its name.
    int error_ = 0;
};

/// Is it a name that a TemporaryFile of this ending has?
bool is_temporary_name(std::string_view name,
                       std::string_view ending = TemporaryFile::usual_ending);

/// Removes temporary files of this user that killed processes left in a folder: those of the usual
/// ending that nobody has locked and nobody has written to for an hour.
void remove_dead_temporaries(const Descriptor& folder);
void remove_dead_temporaries(const std::filesystem::path& folder);

}  // namespace cascade
