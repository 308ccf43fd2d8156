// Functions for all fuzzers: writing seeds to the corpus, and a temporary folder for files.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::fuzz {

/// An initial input: the byte that chooses a reader, and the data for this reader.
struct Seed {
    std::string name;
    char choice = 0;
    std::string bytes;
};

inline void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Writes the seeds to the first folder among the arguments of libFuzzer, if there is one.
inline void write_seeds(int count, char** arguments, const std::vector<Seed>& seeds) {
    for (int k = 1; k < count; ++k) {
        const std::filesystem::path folder = arguments[k];
        if (!std::filesystem::is_directory(folder)) continue;
        for (const Seed& seed : seeds) write_bytes(folder / seed.name, seed.choice + seed.bytes);
        return;
    }
}

/// A folder in memory, removed at the end of the process.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string pattern = "/dev/shm/cascade-fuzz-XXXXXX";
        path_ = ::mkdtemp(pattern.data());
    }
    ~ScratchFolder() {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace cascade::fuzz
