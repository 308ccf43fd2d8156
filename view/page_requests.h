// Records which requests of each page were carried out. A page that loses its connection repeats
// its unanswered requests over a new connection. No request is carried out twice.
#pragma once

#include "view/local_server.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace cascade {

/// Any thread may call the functions of this class.
class PageRequests {
public:
    struct Page;

    /// Gives the page on a connection the name that the page has chosen for itself. A page without
    /// a name is identified by its connection.
    void name(PageId connection, const std::string& name);
    void close(PageId connection);

    struct Begun {
        std::shared_ptr<Page> page;
        /// Whether the caller must carry out the request and then call finish().
        bool is_new = true;
        /// The stored answer, if the request was carried out before.
        std::optional<std::string> answer;
    };
    /// Begins a request. The numbers `id` of a page's requests must increase. A request with the
    /// number 0 always counts as new.
    Begun begin(PageId connection, std::uint64_t id);
    /// Stores the answer to a request, and returns the page's present connection, to which the
    /// answer must be sent.
    PageId finish(Page& page, std::uint64_t id, const std::string& answer);

private:
    std::mutex mutex_;
    std::map<PageId, std::shared_ptr<Page>> connected_;
    std::map<std::string, std::shared_ptr<Page>> named_;
    std::deque<std::string> names_;  ///< The names that pages have chosen, the oldest first.
};

}  // namespace cascade
