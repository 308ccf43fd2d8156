// A session that pages control through their sockets.
#include "view/page_server.h"

#include "unit/view/raw_client.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstring>

namespace cascade {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class PageServerTest : public testing::Test {
protected:
    void SetUp() override {
        SimulationOptions options;
        options.backend = "interp";
        options.threads = 1;
        RunControl control;
        auto run = LiveRun::begin(
            load_script("spots.cascade",
                        "domain { grid: 8, 8 }\nstage one: turing_spots { iterations: 1000000 }\n",
                        "."),
            options, control);
        ASSERT_TRUE(run.has_value()) << run.error().messages(false);
        auto started = PageServer::start(std::move(*run), {}, true);
        ASSERT_TRUE(started.has_value()) << started.error().message;
        server_ = std::move(*started);
    }

    void open(RawClient& client) {
        const std::string host = fmt::format("127.0.0.1:{}", server_->port());
        const std::string token = server_->address().substr(server_->address().find('=') + 1);
        ASSERT_TRUE(client.send(socket_request(host, token, "http://" + host)));
        ASSERT_THAT(client.read_until("\r\n\r\n"), HasSubstr(" 101 "));
    }

    void say(RawClient& client, const std::string& text) {
        EXPECT_TRUE(client.send_frame(RawClient::text, text));
    }

    /// Returns the next text message of a kind.
    Json hear(RawClient& client, const std::string& kind) {
        while (true) {
            const RawClient::Frame frame = client.read_frame();
            if (frame.opcode == 0) return {};
            if (frame.opcode != RawClient::text) continue;
            Json text = Json::parse(frame.payload);
            if (text["kind"] == kind) return text;
        }
    }

    /// Requests the next snapshot and returns its header.
    Json look(RawClient& client) {
        say(client, R"({"do": "next_snapshot"})");
        return header(client);
    }

    /// The header of the next binary frame.
    Json header(RawClient& client) {
        RawClient::Frame frame;
        do {
            frame = client.read_frame();
        } while (frame.opcode == RawClient::text);
        std::uint32_t size = 0;
        if (frame.payload.size() < sizeof size) return {};
        std::memcpy(&size, frame.payload.data(), sizeof size);
        return Json::parse(frame.payload.substr(sizeof size, size));
    }

    std::unique_ptr<PageServer> server_;
};

TEST_F(PageServerTest, PagesSeeAndSteerOneSession) {
    RawClient first(server_->port()), second(server_->port());
    open(first);
    open(second);
    EXPECT_EQ(hear(first, "palettes")["palettes"][0]["name"], "grey");
    EXPECT_EQ(look(first)["steps"], 0);

    const Json systems = hear(second, "systems")["systems"];
    const auto brusselator = std::find_if(systems.begin(), systems.end(), [](const Json& system) {
        return system["name"] == "brusselator";
    });
    EXPECT_EQ(hear(second, "script")["name"], "spots.cascade");
    ASSERT_NE(brusselator, systems.end());
    EXPECT_THAT((*brusselator)["words"].get<std::string>(), HasSubstr("prigogine"));
    EXPECT_THAT((*brusselator)["script"].get<std::string>(), HasSubstr("stage "));

    say(first, R"({"id": 1, "do": "step", "count": 10})");
    EXPECT_EQ(hear(first, "answer")["is_done"], true);
    Json seen = look(first);
    while (seen["steps"] != 10) seen = look(first);
    EXPECT_EQ(look(second)["steps"], 10);

    say(second, R"({"id": 2, "do": "run"})");
    EXPECT_EQ(hear(second, "answer")["id"], 2);
    while (seen["steps"].get<int>() < 200) seen = look(first);
    EXPECT_EQ(seen["is_going_on"], true);
    say(first, R"({"id": 3, "do": "pause"})");
    EXPECT_EQ(hear(first, "answer")["id"], 3);
    while (seen["is_going_on"] == true) seen = look(first);

    // A changed number sends the new script to all pages.
    say(first, R"({"id": 4, "do": "set", "name": "ka", "expression": "0.01"})");
    EXPECT_EQ(hear(first, "answer")["is_done"], true);
    // The next snapshot may have been made before the change.
    const Json script = seen["script"];
    while (seen["script"] == script) seen = look(first);
    EXPECT_EQ(hear(second, "script")["name"], "spots.cascade");

    say(first, R"({"id": 5, "do": "log"})");
    EXPECT_THAT(hear(first, "log")["text"].get<std::string>(), HasSubstr("\nset ka=0.01\n"));
}

TEST_F(PageServerTest, SendsTheSurfaceOfAModel) {
    RawClient page(server_->port());
    open(page);
    EXPECT_EQ(look(page)["surface"], 0);
    const std::string text = "domain { surface: sphere; cells: 200 }\\nstage one: turing_spots { }";
    say(page, R"({"id": 1, "do": "text", "text": ")" + text + "\"}");
    EXPECT_EQ(hear(page, "answer")["is_done"], true);
    Json seen = look(page);
    while (seen["surface"] == 0) seen = look(page);
    EXPECT_EQ(seen["is_model"], true);
    for (int k = 0; k < 2; ++k) {
        say(page, R"({"do": "surface"})");
        const Json surface = header(page);
        EXPECT_EQ(surface["kind"], "surface");
        EXPECT_EQ(surface["number"], seen["surface"]);
        EXPECT_GT(surface["vertices"], 200);
    }
}

TEST_F(PageServerTest, AnswersWhatIsWrong) {
    RawClient page(server_->port());
    open(page);
    const auto answer = [&](const std::string& text) {
        say(page, text);
        const Json heard = hear(page, "answer");
        EXPECT_EQ(heard["is_done"], false) << text;
        return heard["messages"].empty() ? "" : heard["messages"][0]["message"].get<std::string>();
    };
    EXPECT_EQ(answer("what?"), "the message is not a JSON object");
    EXPECT_THAT(answer(R"({"id": 1, "do": "set", "name": "kk", "expression": "1"})"),
                HasSubstr("kk"));
    EXPECT_NE(answer(R"({"id": 2, "do": "paint", "item": "a", "expression": "1 +"})"), "");
    EXPECT_NE(answer(R"({"id": 3, "do": "text", "text": "stage"})"), "");
    EXPECT_NE(answer(R"({"id": 4, "do": "undo"})"), "");
    EXPECT_NE(answer(R"({"id": 5, "do": "go_to_stage", "stage": 9})"), "");
    EXPECT_NE(answer(R"({"id": 6, "do": "show", "expression": "nothing"})"), "");
    EXPECT_EQ(look(page)["steps"], 0);
}

TEST_F(PageServerTest, EndsWhileItIsBusy) {
    RawClient page(server_->port());
    open(page);
    say(page, R"({"do": "run"})");
    for (int k = 0; k < 100; ++k) {
        say(page, R"({"do": "set", "name": "ka", "expression": "0.01", "joins_last": true})");
        say(page, R"({"do": "next_snapshot"})");
    }
    server_.reset();
    while (page.read_frame().opcode == RawClient::text) {
    }
}

}  // namespace
}  // namespace cascade
