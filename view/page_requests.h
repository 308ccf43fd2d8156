// Records which requests of each page were obeyed. A page that has lost its connection sends
// unanswered requests again over another one. No request is obeyed twice.
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

/// Any thread may call every function.
class PageRequests {
public:
    struct Page;

    /// Identifies a page by its chosen name, over this connection from now on. Without a call, a
    /// page is its connection.
    void name(PageId connection, const std::string& name);
    void close(PageId connection);

    struct Begun {
        std::shared_ptr<Page> page;
        bool is_new = true;                 ///< Obey it, and call finish().
        std::optional<std::string> answer;  ///< If the request was obeyed before.
    };
    /// Begins a request. A page's ids grow. 0 is always new.
    Begun begin(PageId connection, std::uint64_t id);
    /// Stores an answer, and returns the page's present connection, which must receive it.
    PageId finish(Page& page, std::uint64_t id, const std::string& answer);

private:
    std::mutex mutex_;
    std::map<PageId, std::shared_ptr<Page>> connected_;
    std::map<std::string, std::shared_ptr<Page>> named_;
    std::deque<std::string> names_;  ///< Oldest first.
};

}  // namespace cascade
