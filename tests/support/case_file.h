// Writes test cases that a Node.js script runs.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace cascade::test {

/// A file of numbers of 32 bits, little endian, and of lists of bytes, each preceded by its length.
class CaseFile {
public:
    explicit CaseFile(const std::string& path);
    ~CaseFile();
    CaseFile(const CaseFile&) = delete;

    void write(std::uint32_t number);
    void write(const std::vector<std::uint8_t>& bytes);
    void write(const std::vector<std::uint32_t>& words);
    void write(const std::string& text) {
        write(std::vector<std::uint8_t>(text.begin(), text.end()));
    }
    int cases = 0;

private:
    std::FILE* file_;
};

}  // namespace cascade::test
