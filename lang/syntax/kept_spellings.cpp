// Stores spellings in a hash table that only grows, so threads need no lock.
#include "lang/syntax/kept_spellings.h"

#include <array>
#include <atomic>
#include <functional>

namespace cascade {

namespace {

struct Entry {
    std::string text;
    Entry* next = nullptr;
};

constexpr std::size_t bucket_count = 1 << 16;

}  // namespace

std::string_view kept_spelling(const std::string& text) {
    static std::array<std::atomic<Entry*>, bucket_count> buckets{};
    std::atomic<Entry*>& bucket = buckets[std::hash<std::string>()(text) % bucket_count];
    Entry* fresh = nullptr;
    Entry* seen = nullptr;  // The first entry that has already been compared.
    for (Entry* first = bucket.load(std::memory_order_acquire);;) {
        for (const Entry* entry = first; entry != seen; entry = entry->next) {
            if (entry->text != text) continue;
            delete fresh;
            return entry->text;
        }
        seen = first;
        if (fresh == nullptr) fresh = new Entry{text, nullptr};
        fresh->next = first;
        if (bucket.compare_exchange_weak(first, fresh, std::memory_order_acq_rel)) {
            return fresh->text;
        }
    }
}

bool is_spelling_of_number(std::string_view text) {
    return !text.empty() && (text[0] == '.' || (text[0] >= '0' && text[0] <= '9'));
}

}  // namespace cascade
