// Which requests of each page were obeyed. A page that has lost its connection sends again what was
// not answered, over another connection; nothing is obeyed twice.
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

/// Every function may be called from any thread.
class PageRequests {
public:
    struct Page;

    /// A page by the name that it has chosen, over a connection from now on. Without a call a page
    /// is its connection.
    void name(PageId connection, const std::string& name);
    void close(PageId connection);

    struct Begun {
        std::shared_ptr<Page> page;
        bool is_new = true;                 ///< Obey it, and call finish().
        std::optional<std::string> answer;  ///< Of a request that was obeyed before.
    };
    /// A request; ids of a page grow. 0 is always new.
    Begun begin(PageId connection, std::uint64_t id);
    /// Keeps an answer, and returns the page's present connection, to which it is to be sent.
    PageId finish(Page& page, std::uint64_t id, const std::string& answer);

private:
    std::mutex mutex_;
    std::map<PageId, std::shared_ptr<Page>> connected_;
    std::map<std::string, std::shared_ptr<Page>> named_;
    std::deque<std::string> names_;  ///< The oldest first.
};

}  // namespace cascade
