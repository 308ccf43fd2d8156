#include "tests/support/case_file.h"

#include "core/check.h"

#include <cstring>

namespace cascade::test {

CaseFile::CaseFile(const std::string& path) : file_(std::fopen(path.c_str(), "wb")) {
    CHECK(file_, "test: the file of cases can be written");
}

CaseFile::~CaseFile() { CHECK(std::fclose(file_) == 0, "test: the cases are written"); }

void CaseFile::write(std::uint32_t number) {
    CHECK(std::fwrite(&number, sizeof(number), 1, file_) == 1, "test: the cases are written");
}

void CaseFile::write(const std::vector<std::uint8_t>& bytes) {
    write(static_cast<std::uint32_t>(bytes.size()));
    CHECK(std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size(),
          "test: the cases are written");
}

void CaseFile::write(const std::vector<std::uint32_t>& words) {
    std::vector<std::uint8_t> bytes(4 * words.size());
    if (!words.empty()) std::memcpy(bytes.data(), words.data(), bytes.size());
    write(bytes);
}

}  // namespace cascade::test
