// SPDX-License-Identifier: MIT
#include "page/listener.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {
namespace listener_test {

std::string error_of(const std::string& address, std::uint16_t port) {
    try {
        close(listen_at(address, port, "--port"));
    } catch (const OutputError& error) {
        return error.what();
    }
    return "";
}

TEST(Listener, AddressesOfBothKindsAreNamedAsInAUrl) {
    EXPECT_EQ(address_text("127.0.0.1", 80), "127.0.0.1:80");
    EXPECT_EQ(address_text("::1", 80), "[::1]:80");
}

TEST(Listener, ListensAtAFreePortAndNobodyWaits) {
    const int listener = listen_at("127.0.0.1", 0, "--port");
    const std::uint16_t port = port_of(listener);
    EXPECT_NE(port, 0);
    EXPECT_LT(accept_at(listener), 0) << "returns at once";
    const std::string error = error_of("127.0.0.1", port);
    EXPECT_NE(error.find("choose another --port"), std::string::npos) << error;
    EXPECT_NE(error.find("127.0.0.1:" + std::to_string(port)), std::string::npos) << error;
    close(listener);
    EXPECT_EQ(error_of("127.0.0.1", port), "");
}

TEST(Listener, WhatIsNoAddressOfThisMachineIsAnError) {
    EXPECT_NE(error_of("192.0.2.1", 0).find("choose an address of this machine"),
              std::string::npos);
    EXPECT_NE(error_of("no address", 0).find("expected an address of this machine"),
              std::string::npos);
}

}  // namespace listener_test
}  // namespace dynamic_filter::app
