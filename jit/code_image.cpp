// Links object files to images, and loads those.
//
// The linker knows what the code generator writes for kernels: sections of code and of constants,
// and references between them of 32 bits, relative to the place of the reference ("System V
// Application Binary Interface, AMD64 Architecture Processor Supplement", 4.4.1: S + A − P). It
// refuses all else.
#include "jit/code_image.h"

#include <elf.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <system_error>
#include <vector>

namespace cascade {
namespace {

/// An object file, read without trust in what it says.
class ObjectFile {
public:
    explicit ObjectFile(std::string_view bytes) : bytes_(bytes) {}

    bool read_sections() {
        const auto header = at<Elf64_Ehdr>(0);
        if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0) return false;
        if (header->e_ident[EI_CLASS] != ELFCLASS64 || header->e_ident[EI_DATA] != ELFDATA2LSB ||
            header->e_type != ET_REL || header->e_machine != EM_X86_64 ||
            header->e_shentsize != sizeof(Elf64_Shdr)) {
            return false;
        }
        for (std::uint64_t k = 0; k < header->e_shnum; ++k) {
            const auto section = at<Elf64_Shdr>(header->e_shoff + k * sizeof(Elf64_Shdr));
            if (!section) return false;
            if (section->sh_type != SHT_NOBITS && section->sh_type != SHT_NULL &&
                !content(*section)) {
                return false;
            }
            sections.push_back(*section);
        }
        if (header->e_shstrndx >= sections.size()) return false;
        names_ = *content(sections[header->e_shstrndx]);
        return true;
    }

    template <typename Record>
    std::optional<Record> at(std::uint64_t offset) const {
        if (offset > bytes_.size() || bytes_.size() - offset < sizeof(Record)) return std::nullopt;
        Record record;
        std::memcpy(&record, bytes_.data() + offset, sizeof record);
        return record;
    }
    std::optional<std::string_view> content(const Elf64_Shdr& section) const {
        if (section.sh_offset > bytes_.size() ||
            bytes_.size() - section.sh_offset < section.sh_size) {
            return std::nullopt;
        }
        return bytes_.substr(section.sh_offset, section.sh_size);
    }
    std::string_view name_of(const Elf64_Shdr& section) const {
        return text(names_, section.sh_name);
    }
    /// The text that ends with a zero.
    static std::string_view text(std::string_view texts, std::uint64_t offset) {
        if (offset >= texts.size()) return {};
        texts.remove_prefix(offset);
        return texts.substr(0, texts.find('\0'));
    }

    std::vector<Elf64_Shdr> sections;

private:
    std::string_view bytes_;
    std::string_view names_;
};

class Linker {
public:
    explicit Linker(const ObjectFile& file) : file_(file), places_(file.sections.size(), nowhere) {}

    std::optional<CodeImage> link(std::string_view name) {
        if (!place_sections() || !read_symbols(name) || !entry_) return std::nullopt;
        for (const Elf64_Shdr& section : file_.sections) {
            if (section.sh_type == SHT_REL) return std::nullopt;
            if (section.sh_type == SHT_RELA && !relocate(section)) return std::nullopt;
        }
        image_.entry = *entry_;
        return std::move(image_);
    }

private:
    static constexpr std::uint64_t nowhere = std::numeric_limits<std::uint64_t>::max();
    static constexpr std::uint64_t largest_image = std::uint64_t{1} << 28;

    /// Tables for unwinding the stack serve nobody: kernels throw nothing and call nothing.
    bool is_loaded(const Elf64_Shdr& section) const {
        return (section.sh_flags & SHF_ALLOC) != 0 && file_.name_of(section) != ".eh_frame";
    }

    bool place_sections() {
        for (std::size_t k = 0; k < file_.sections.size(); ++k) {
            const Elf64_Shdr& section = file_.sections[k];
            if (!is_loaded(section)) continue;
            const bool is_zeros = section.sh_type == SHT_NOBITS;
            if (section.sh_type != SHT_PROGBITS && !is_zeros) return false;
            if ((section.sh_flags & SHF_TLS) != 0 || section.sh_size > largest_image) return false;
            const std::uint64_t alignment = section.sh_addralign > 0 ? section.sh_addralign : 1;
            if (alignment > CodeImage::alignment || (alignment & (alignment - 1)) != 0)
                return false;
            std::string& bytes = image_.bytes;
            bytes.resize((bytes.size() + alignment - 1) / alignment * alignment, '\0');
            places_[k] = bytes.size();
            if (is_zeros) bytes.append(section.sh_size, '\0');
            else bytes += *file_.content(section);
            if (bytes.size() > largest_image) return false;
        }
        return true;
    }

    bool read_symbols(std::string_view name) {
        for (std::size_t k = 0; k < file_.sections.size(); ++k) {
            const Elf64_Shdr& table = file_.sections[k];
            if (table.sh_type != SHT_SYMTAB) continue;
            if (symbol_table_ != 0 || table.sh_link >= file_.sections.size()) return false;
            symbol_table_ = k;
            const auto names = file_.content(file_.sections[table.sh_link]);
            if (!names) return false;
            for (std::uint64_t n = 0; n < table.sh_size / sizeof(Elf64_Sym); ++n) {
                const auto symbol = file_.at<Elf64_Sym>(table.sh_offset + n * sizeof(Elf64_Sym));
                symbols_.push_back(place_of(*symbol));
                const bool is_function = ELF64_ST_TYPE(symbol->st_info) == STT_FUNC;
                if (is_function && ObjectFile::text(*names, symbol->st_name) == name &&
                    symbols_.back() < image_.bytes.size()) {
                    entry_ = symbols_.back();
                }
            }
        }
        return symbol_table_ != 0;
    }

    /// In the image, or nowhere.
    std::uint64_t place_of(const Elf64_Sym& symbol) const {
        if (symbol.st_shndx >= places_.size())
            return nowhere;  // Also those numbers with a meaning.
        const std::uint64_t start = places_[symbol.st_shndx];
        if (start == nowhere || symbol.st_value > file_.sections[symbol.st_shndx].sh_size) {
            return nowhere;
        }
        return start + symbol.st_value;
    }

    bool relocate(const Elf64_Shdr& table) {
        if (table.sh_info >= places_.size()) return false;
        const Elf64_Shdr& target = file_.sections[table.sh_info];
        if (!is_loaded(target)) return true;
        if (table.sh_link != symbol_table_) return false;
        for (std::uint64_t n = 0; n < table.sh_size / sizeof(Elf64_Rela); ++n) {
            const auto entry = file_.at<Elf64_Rela>(table.sh_offset + n * sizeof(Elf64_Rela));
            const std::uint64_t type = ELF64_R_TYPE(entry->r_info);
            const std::uint64_t symbol = ELF64_R_SYM(entry->r_info);
            if (type != R_X86_64_PC32 && type != R_X86_64_PLT32) return false;
            if (symbol >= symbols_.size() || symbols_[symbol] == nowhere) return false;
            if (target.sh_size < 4 || entry->r_offset > target.sh_size - 4) return false;
            const std::uint64_t place = places_[table.sh_info] + entry->r_offset;
            // All of it is within an image of 2^28 bytes but the addend, which may be anything.
            const auto distance = static_cast<std::int64_t>(
                symbols_[symbol] + static_cast<std::uint64_t>(entry->r_addend) - place);
            if (distance < std::numeric_limits<std::int32_t>::min() ||
                distance > std::numeric_limits<std::int32_t>::max()) {
                return false;
            }
            const auto word = static_cast<std::int32_t>(distance);
            std::memcpy(image_.bytes.data() + place, &word, sizeof word);
        }
        return true;
    }

    const ObjectFile& file_;
    CodeImage image_;
    std::vector<std::uint64_t> places_;   ///< By section.
    std::vector<std::uint64_t> symbols_;  ///< Their places.
    std::size_t symbol_table_ = 0;        ///< Number of its section; section 0 is none.
    std::optional<std::uint64_t> entry_;
};

/// Pages with an image in them.
class MappedFunction final : public LoadedFunction {
public:
    MappedFunction(void* pages, std::size_t size) : pages_(pages), size_(size) {}
    ~MappedFunction() override { ::munmap(pages_, size_); }
    MappedFunction(const MappedFunction&) = delete;
    MappedFunction& operator=(const MappedFunction&) = delete;

private:
    void* pages_;
    std::size_t size_;
};

}  // namespace

std::optional<CodeImage> link_image(std::string_view object, std::string_view name) {
    ObjectFile file(object);
    if (!file.read_sections()) return std::nullopt;
    return Linker(file).link(name);
}

Result<std::unique_ptr<LoadedFunction>> load_image(const CodeImage& image) {
    const auto refused = [] {
        return failure(
            fmt::format("native code could not be loaded: {}",
                        std::generic_category().message(errno)),
            "the system may forbid programs to make code; --backend interp goes without");
    };
    const std::size_t size = image.bytes.size();
    void* pages = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) return refused();
    auto function = std::make_unique<MappedFunction>(pages, size);
    std::memcpy(pages, image.bytes.data(), size);
    if (::mprotect(pages, size, PROT_READ | PROT_EXEC) != 0) return refused();
    function->address = reinterpret_cast<std::uintptr_t>(pages) + image.entry;
    return function;
}

}  // namespace cascade
