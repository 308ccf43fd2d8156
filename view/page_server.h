// A session in a browser: pages' requests go to the session, and its snapshots go to the pages.
#pragma once

#include "run/session/live_run.h"
#include "view/local_server.h"

#include <filesystem>
#include <memory>
#include <string>

namespace cascade {

/// Serves one session to the open pages, which all see and steer the same one.
class PageServer {
public:
    /// Begins a session of a run and opens its page. With `offers_library`, pages receive the
    /// systems of the library, so that a user can pick one. Models that pages load are kept in
    /// `models`, to which the script has access; without this folder there are none.
    static Result<std::unique_ptr<PageServer>> start(std::unique_ptr<LiveRun> run, PageFiles files,
                                                     bool offers_library = false,
                                                     std::filesystem::path models = {});
    /// Closes all pages and ends the session.
    ~PageServer();

    std::uint16_t port() const;
    std::string address() const;  ///< Same as LocalServer::address().

private:
    struct State;
    explicit PageServer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace cascade
