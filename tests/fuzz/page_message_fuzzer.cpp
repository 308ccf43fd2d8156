// A fuzzer of the messages that pages send to the local server.
#include "core/check.h"
#include "tests/fuzz/seeds.h"
#include "view/page_message.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    // Seeds hold their first byte separately. Here, this byte is part of the text.
    cascade::fuzz::write_seeds(
        *count, *arguments,
        {{"text", '{', R"("id": 1, "do": "text", "text": "stage one: turing_spots { }"})"},
         {"set", '{', R"("id": 2, "do": "set", "name": "ka", "expression": "1/80"})"},
         {"paint", '{', R"("do": "paint", "item": "b", "expression": "8", "joins_last": true})"},
         {"stage", '{', R"("do": "go_to_stage", "stage": 2})"},
         {"names", '{', R"("id": 3, "do": "names", "text": "stage one: "})"},
         {"measure", '{', R"("do": "measure", "x": "a", "y": "b"})"},
         {"picture", '{',
          R"("do": "picture", "show": "", "palette": "grey", "scale": 2, "low": 0})"},
         {"step", '{', R"("do": "step", "count": 100})"}});
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto message = cascade::parse_page_message({reinterpret_cast<const char*>(data), size});
    CHECK(message || !message.error().message.empty(), "every refusal says why");
    return 0;
}
