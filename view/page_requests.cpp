// The numbers of a page's requests increase. So a request has been carried out before if its number
// is not above the number of the last request carried out.
#include "view/page_requests.h"

#include <algorithm>

namespace cascade {
namespace {

constexpr std::size_t most_names = 64, most_answers = 256;

}  // namespace

struct PageRequests::Page {
    PageId connection = 0;
    std::uint64_t last = 0;  ///< The number of the last request that was carried out.
    std::map<std::uint64_t, std::string> answers;  ///< The answers to the newest requests.
};

void PageRequests::name(PageId connection, const std::string& name) {
    const std::lock_guard lock(mutex_);
    auto& page = named_[name];
    if (!page) {
        page = std::make_shared<Page>();
        names_.push_back(name);
        if (names_.size() > most_names) {
            named_.erase(names_.front());
            names_.pop_front();
        }
    }
    page->connection = connection;
    connected_[connection] = page;
}

void PageRequests::close(PageId connection) {
    const std::lock_guard lock(mutex_);
    connected_.erase(connection);
}

PageRequests::Begun PageRequests::begin(PageId connection, std::uint64_t id) {
    const std::lock_guard lock(mutex_);
    auto& page = connected_[connection];
    if (!page) {
        page = std::make_shared<Page>();
        page->connection = connection;
    }
    Begun begun{page, id == 0 || id > page->last, std::nullopt};
    page->last = std::max(page->last, id);
    if (begun.is_new) return begun;
    if (const auto found = page->answers.find(id); found != page->answers.end()) {
        begun.answer = found->second;
    }
    return begun;
}

PageId PageRequests::finish(Page& page, std::uint64_t id, const std::string& answer) {
    const std::lock_guard lock(mutex_);
    page.answers[id] = answer;
    if (page.answers.size() > most_answers) page.answers.erase(page.answers.begin());
    return page.connection;
}

}  // namespace cascade
