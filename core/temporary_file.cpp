// Creates files with O_EXCL, locks them with flock(), and calls fsync() before renaming. A file's
// writer counts as dead if the file can be locked and is older than an hour.
#include "core/temporary_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <ctime>
#include <fcntl.h>
#include <fmt/format.h>
#include <random>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cascade {
namespace {

constexpr std::string_view beginning = ".cascade-";
constexpr std::size_t digit_count = 32;

/// A younger file may have a living writer although the file is not locked, because files are
/// locked only a moment after their creation and some network file systems support no locks.
constexpr std::time_t youngest_dead = 60 * 60;

int make_new(const Descriptor& folder, const std::string& name, mode_t mode) {
    int number = -1;
    do {
        number = ::openat(folder.number(), name.c_str(),
                          O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    } while (number < 0 && errno == EINTR);
    return number;
}

/// Removes a file of this user if its writer is dead.
void remove_if_dead(const Descriptor& folder, const char* name) {
    const Descriptor file(
        ::openat(folder.number(), name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0) return;
    if (!S_ISREG(status.st_mode) || status.st_uid != ::geteuid()) return;
    if (status.st_mtime > std::time(nullptr) - youngest_dead) return;
    if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) return;
    ::unlinkat(folder.number(), name, 0);
}

/// An entry in the list of files that remove_all() removes. Constructors and destructors write the
/// list and a signal handler reads it, so it is global and takes no lock.
struct Slot {
    enum State : int { free, taken, whole };
    std::atomic<int> state{free};
    std::atomic<int> folder{-1};
    std::array<char, beginning.size() + digit_count + 24> name{};
};
std::array<Slot, 64> slots;
static_assert(std::atomic<int>::is_always_lock_free);

/// Returns the index of a new entry; negative if all entries are in use or the name is too long.
int enter(int folder, std::string_view name) {
    for (std::size_t k = 0; k < slots.size() && name.size() < slots[k].name.size(); ++k) {
        int state = Slot::free;
        if (!slots[k].state.compare_exchange_strong(state, Slot::taken)) continue;
        slots[k].folder = folder;
        slots[k].name.fill('\0');
        std::copy(name.begin(), name.end(), slots[k].name.begin());
        slots[k].state = Slot::whole;
        return static_cast<int>(k);
    }
    return -1;
}

using Words = std::array<std::uint32_t, 4>;

std::string digits_of(const Words& words) {
    return fmt::format("{:08x}{:08x}{:08x}{:08x}", words[0], words[1], words[2], words[3]);
}

}  // namespace

std::optional<std::string> secret_digits() {
    Words words{};
    const ssize_t size = sizeof words;
    if (::getrandom(words.data(), sizeof words, 0) != size) return std::nullopt;
    return digits_of(words);
}

std::string random_digits() {
    if (auto secret = secret_digits()) return *std::move(secret);
    Words words{};
    std::random_device device;
    std::generate(words.begin(), words.end(), [&] { return device(); });
    return digits_of(words);
}

int open_folder(const std::filesystem::path& folder) {
    return ::open(folder.empty() ? "." : folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
}

TemporaryFile::TemporaryFile(const Descriptor& folder, mode_t mode, std::string_view ending)
    : folder_(folder),
      name_(fmt::format("{}{}{}", beginning, random_digits(), ending)),
      file_(make_new(folder, name_, mode)) {
    if (!file_.is_open()) {
        error_ = errno;
        return;
    }
    is_ours_ = true;
    slot_ = enter(folder_.number(), name_);
    (void)::flock(file_.number(), LOCK_EX | LOCK_NB);  // Some file systems cannot lock.
}

TemporaryFile::~TemporaryFile() {
    if (is_ours_) ::unlinkat(folder_.number(), name_.c_str(), 0);
    disown();
}

void TemporaryFile::disown() {
    is_ours_ = false;
    if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state = Slot::free;
    slot_ = -1;
}

void TemporaryFile::remove_all() noexcept {
    for (const Slot& slot : slots) {
        if (slot.state == Slot::whole) ::unlinkat(slot.folder, slot.name.data(), 0);
    }
}

int TemporaryFile::write(std::string_view bytes) {
    if (error_ != 0) return error_;
    if (const int error = write_all(file_, bytes)) return error;
    // Without fsync(), a crash of the machine could leave an empty file under the new name.
    return ::fsync(file_.number()) == 0 || errno == EINVAL ? 0 : errno;
}

int TemporaryFile::rename_to(const std::string& name) {
    if (error_ != 0) return error_;
    if (!file_.close()) return errno;
    return take_name(name);
}

int TemporaryFile::take_name(const std::string& name) {
    if (error_ != 0) return error_;
    if (::renameat(folder_.number(), name_.c_str(), folder_.number(), name.c_str()) != 0)
        return errno;
    // Once the file has its final name, nobody removes it as a leftover, and its readers may want
    // to lock it.
    (void)::flock(file_.number(), LOCK_UN);
    disown();
    return 0;
}

int TemporaryFile::stay() {
    if (error_ != 0) return error_;
    if (!file_.close()) return errno;
    disown();
    return 0;
}

bool is_temporary_name(std::string_view name, std::string_view ending) {
    if (name.size() != beginning.size() + digit_count + ending.size()) return false;
    if (!name.starts_with(beginning) || !name.ends_with(ending)) return false;
    const std::string_view digits = name.substr(beginning.size(), digit_count);
    return digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

void remove_dead_temporaries(const Descriptor& folder) {
    for (const std::string& name : names_in(folder)) {
        if (is_temporary_name(name)) remove_if_dead(folder, name.c_str());
    }
}

void remove_dead_temporaries(const std::filesystem::path& folder) {
    const Descriptor opened(open_folder(folder));
    if (opened.is_open()) remove_dead_temporaries(opened);
}

}  // namespace cascade
