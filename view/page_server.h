// Shows a session in a browser. Passes requests of pages to the session, and its snapshots to the
// pages.
#pragma once

#include "run/session/live_run.h"
#include "view/local_server.h"

#include <filesystem>
#include <memory>
#include <string>

namespace cascade {

/// Serves one session to all open pages. Every page shows and controls this session.
class PageServer {
public:
    /// Starts a session of a run and a server for its page. If `offers_library` is true, pages also
    /// receive the systems of the library, so that users can choose one. Models that users load are
    /// stored in the folder `models`, which the script must be permitted to read. If `models` is
    /// empty, no models can be loaded.
    static Result<std::unique_ptr<PageServer>> start(std::unique_ptr<LiveRun> run, PageFiles files,
                                                     bool offers_library = false,
                                                     std::filesystem::path models = {});
    /// Closes all pages and ends the session.
    ~PageServer();

    std::uint16_t port() const;
    std::string address() const;  ///< See LocalServer::address().

private:
    struct State;
    explicit PageServer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace cascade
