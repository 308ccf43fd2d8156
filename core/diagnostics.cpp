// Collects diagnostics.
#include "core/diagnostics.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cascade {

void Diagnostics::error(Span span, std::string message, std::string hint) {
    add({Severity::error, span, std::move(message), std::move(hint), {}});
}

void Diagnostics::warning(Span span, std::string message, std::string hint) {
    add({Severity::warning, span, std::move(message), std::move(hint), {}});
}

void Diagnostics::add(Diagnostic diagnostic) {
    std::size_t& count = diagnostic.severity == Severity::error ? error_count_ : warning_count_;
    if (count < most_kept) {
        const Span& span = diagnostic.span;
        const bool is_new =
            seen_
                .emplace(diagnostic.severity, span.source, span.begin, span.end, diagnostic.message)
                .second;
        if (!is_new) return;
        list_.push_back(std::move(diagnostic));
    }
    ++count;
}

std::vector<Diagnostic> Diagnostics::sorted() const {
    std::vector<std::size_t> order(list_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [this](std::size_t k) {  // Equal positions keep the order of insertion.
        const Span& span = list_[k].span;
        return std::make_tuple(span.source, span.begin, span.end, k);
    };
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::vector<Diagnostic> result;
    result.reserve(order.size());
    for (const std::size_t k : order) result.push_back(list_[k]);
    return result;
}

}  // namespace cascade
