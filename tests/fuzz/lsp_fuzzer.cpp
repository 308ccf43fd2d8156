// A fuzzer of the streams that editors send to the language server: frames, JSON, and changes of a
// script.
#include "core/check.h"
#include "lsp/frames.h"
#include "lsp/server.h"
#include "tests/fuzz/seeds.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace {

const std::string opened =
    R"({"method":"textDocument/didOpen","params":{"textDocument":{"uri":"file:///s.cascade",)"
    R"("version":1,"text":"system s { u: 1; u' = -u }\nstage one: s { }"}}})";

std::string about(const std::string& method, const std::string& more) {
    return R"({"id":1,"method":"textDocument/)" + method +
           R"(","params":{"textDocument":{"uri":"file:///s.cascade"})" + more + "}}";
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    const std::string place = R"(,"position":{"line":0,"character":11})";
    // Seeds hold their first byte separately. Here, this byte is part of the stream.
    const auto rest = [](const std::string& body) { return cascade::lsp::framed(body).substr(1); };
    cascade::fuzz::write_seeds(
        *count, *arguments,
        {{"hover", 'C', rest(about("hover", place))},
         {"completion", 'C', rest(about("completion", place))},
         {"rename", 'C', rest(about("rename", place + R"(,"newName":"v")"))},
         {"tokens", 'C', rest(about("semanticTokens/full", ""))},
         {"change", 'C',
          rest(about("didChange", R"(,"contentChanges":[{"range":{"start":{"line":0,)"
                                  R"("character":3},"end":{"line":1,"character":0}},)"
                                  R"("text":"{"}])"))},
         {"two", 'C', rest(about("formatting", "")) + cascade::lsp::framed("{}")}});
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    cascade::lsp::LanguageServer server;
    server.receive(R"({"id":0,"method":"initialize","params":{}})");
    server.receive(opened);
    cascade::lsp::FrameReader frames;
    frames.add({reinterpret_cast<const char*>(data), size});
    while (const auto frame = frames.next()) {
        if (!frame->is_too_large) server.receive(frame->body);
        if (server.has_ended()) return 0;
    }
    for (const std::string& message : server.publish())
        CHECK(message.starts_with('{') && message.ends_with('}'), "messages are JSON objects");
    return 0;
}
