// SPDX-License-Identifier: MIT
// Fault catalogue 54: what comes from outside cannot get at more than is offered, nor fill memory.
#include "page/http_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <tuple>
#include <vector>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {
namespace http_server_test {

class Client {
public:
    explicit Client(std::uint16_t port) : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        connected_ =
            connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
        const timeval patience{20, 0};
        setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    ~Client() { close(descriptor_); }
    [[nodiscard]] bool connected() const { return connected_; }
    void say(const std::string& text) const {
        ASSERT_EQ(send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL),
                  static_cast<ssize_t>(text.size()));
    }
    /// Until the server closes.
    [[nodiscard]] std::string hear() const {
        std::string all;
        char bytes[65536];
        while (true) {
            const ssize_t n = recv(descriptor_, bytes, sizeof bytes, 0);
            if (n <= 0) return all;
            all.append(bytes, static_cast<std::size_t>(n));
        }
    }

private:
    int descriptor_;
    bool connected_ = false;
};

class Server : public testing::Test {
protected:
    std::string ask(const std::string& target) const {
        const Client client(server_.port());
        client.say(request(target));
        return client.hear();
    }
    [[nodiscard]] std::string request(const std::string& target) const {
        return fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n\r\n", target, server_.port());
    }
    static HttpAnswer answer(const HttpRequest& request) {
        const auto& [path, query] = std::tie(request.path, request.query);
        static const auto big = std::make_shared<const std::string>(30'000'000, 'x');
        if (path == "/big") return {200, "text/plain", big};
        if (path != "/page") return {};
        return {200, "text/html", std::make_shared<const std::string>("<p>" + query)};
    }
    HttpServer server_{0, answer, {.to_ask = std::chrono::milliseconds(300)}};
};

TEST_F(Server, AnswersWhatIsOffered) {
    const std::string heard = ask("/page?a=b");
    EXPECT_TRUE(heard.starts_with("HTTP/1.1 200 OK\r\n")) << heard;
    EXPECT_NE(heard.find("Content-Length: 6\r\n"), std::string::npos);
    EXPECT_TRUE(heard.ends_with("\r\n\r\n<p>a=b")) << heard;
    EXPECT_EQ(server_.url(), fmt::format("http://127.0.0.1:{}/", server_.port()));
}

TEST_F(Server, HeadHasNoBody) {
    const Client client(server_.port());
    client.say(fmt::format("HEAD /page HTTP/1.1\r\nHost: localhost:{}\r\n\r\n", server_.port()));
    EXPECT_TRUE(client.hear().ends_with("\r\n\r\n"));
}

TEST_F(Server, LargeAnswersComeWhole) { EXPECT_GT(ask("/big").size(), 30'000'000U); }

TEST_F(Server, NothingElseIsThere) {
    for (const char* target : {"/", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
                               "//etc/passwd", "/page/../../secret", "/page%00"}) {
        EXPECT_TRUE(ask(target).starts_with("HTTP/1.1 404 ")) << target;
    }
}

TEST_F(Server, ARequestThatDoesNotEndIsRefused) {
    const Client client(server_.port());
    client.say("GET /page HTTP/1.1\r\nX: " + std::string(9000, 'x'));
    EXPECT_TRUE(client.hear().starts_with("HTTP/1.1 431 "));
}

TEST_F(Server, ABodyIsRefusedBeforeItComes) {
    const Client client(server_.port());
    client.say(
        fmt::format("GET /page HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nContent-Length: 1000000000"
                    "\r\n\r\n",
                    server_.port()));
    EXPECT_TRUE(client.hear().starts_with("HTTP/1.1 413 "));
}

TEST_F(Server, PiecesOfARequestAreJoined) {
    const Client client(server_.port());
    const std::string all = request("/page?q");
    for (const char c : all) client.say(std::string(1, c));
    EXPECT_TRUE(client.hear().ends_with("<p>q"));
}

// Those that say nothing, and those that do not read, are given up after their time; those behind
// them are served then.
TEST_F(Server, ManyDeadClientsDelayOthersByTheirTimeAtMost) {
    std::vector<std::unique_ptr<Client>> dead;
    for (int i = 0; i < 70; ++i) {
        dead.push_back(std::make_unique<Client>(server_.port()));
        ASSERT_TRUE(dead.back()->connected());
        if (i % 2 == 0) dead.back()->say("GET /pa");
    }
    EXPECT_TRUE(ask("/page?still").ends_with("<p>still"));
}

/// A server with the limits of the product, which wait 5 s for a request.
TEST(HttpServer, ClientsThatNeverFinishTheirRequestKeepNobodyOut) {
    const auto page = [](const HttpRequest&) {
        return HttpAnswer{200, "text/html", std::make_shared<const std::string>("<p>here")};
    };
    const HttpServer server(0, page);
    std::vector<std::unique_ptr<Client>> dead;
    for (int i = 0; i < 300; ++i) {
        dead.push_back(std::make_unique<Client>(server.port()));
        ASSERT_TRUE(dead.back()->connected());
        dead.back()->say("GET /pa");
    }
    const auto start = std::chrono::steady_clock::now();
    const Client last(server.port());
    last.say(fmt::format("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n\r\n", server.port()));
    EXPECT_TRUE(last.hear().ends_with("<p>here"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4));
    EXPECT_EQ(dead.front()->hear(), "") << "the oldest gave way";
}

TEST_F(Server, ClientsThatLeaveDoNoHarm) {
    for (int i = 0; i < 200; ++i) {
        const Client client(server_.port());
        client.say(request("/big"));
    }
    EXPECT_TRUE(ask("/page?still").ends_with("<p>still"));
}

TEST_F(Server, APortInUseIsAClearError) {
    try {
        const HttpServer second(server_.port(), answer);
        FAIL();
    } catch (const OutputError& error) {
        EXPECT_NE(std::string(error.what()).find("choose another --port"), std::string::npos);
    }
}

}  // namespace http_server_test
}  // namespace dynamic_filter::app
