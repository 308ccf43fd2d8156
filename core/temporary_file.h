// New files under temporary names, renamed when they are complete.
//
// Names are random: in containers that share a folder, all processes may have the same id, and a
// file left by a killed process would block the next process. A temporary file is locked (flock) as
// long as its writer runs. Files of killed processes are not locked.
#pragma once

#include "core/descriptor.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace cascade {

/// 128 random bits from the system as 32 hexadecimal digits. Empty if the system gives none.
std::optional<std::string> secret_digits();

/// 32 random hexadecimal digits for a name, which only has to be unique. If the system gives no
/// random bits, uses std::random_device.
std::string random_digits();

/// Opens a folder only to reach its files by name. Returns the descriptor; on failure it is
/// negative and errno is set.
int open_folder(const std::filesystem::path& folder);

class TemporaryFile {
public:
    static constexpr std::string_view usual_ending = ".tmp";

    /// Creates an empty file in an open folder. The umask applies to its mode.
    explicit TemporaryFile(const Descriptor& folder, mode_t mode = 0666,
                           std::string_view ending = usual_ending);
    /// Removes the file, unless rename_to(), take_name() or stay() has succeeded.
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    /// The error number of the file's creation; 0 if the file was created.
    int error() const { return error_; }
    const Descriptor& file() const { return file_; }
    const std::string& name() const { return name_; }

    /// Writes all bytes and syncs them to disk. Returns 0 or the error number.
    int write(std::string_view bytes);
    /// Closes the file and renames it to `name` in the folder, replacing any file of that name.
    /// Returns 0 or the error number.
    int rename_to(const std::string& name);
    /// Renames the file as rename_to() does, but leaves it open, without its lock.
    int take_name(const std::string& name);
    /// Closes the file and leaves it under its temporary name. Returns 0 or the error number.
    int stay();
    /// Removes the temporary files of this process, except files that found no room in its list of
    /// fixed length. No TemporaryFile may be used afterwards. A signal handler may call this
    /// function before it ends the program.
    static void remove_all() noexcept;

private:
    void disown();

    const Descriptor& folder_;
    std::string name_;
    Descriptor file_;
    bool is_ours_ = false;  ///< Whether the file exists and must be removed.
    int error_ = 0;
    int slot_ = -1;  ///< The index in the list of remove_all(); negative if not listed.
};

/// Whether a TemporaryFile with this ending could have this name.
bool is_temporary_name(std::string_view name,
                       std::string_view ending = TemporaryFile::usual_ending);

/// Removes the temporary files that killed processes of this user left in a folder: they have the
/// usual ending, are unlocked, and have not been written to for an hour.
void remove_dead_temporaries(const Descriptor& folder);
void remove_dead_temporaries(const std::filesystem::path& folder);

}  // namespace cascade
