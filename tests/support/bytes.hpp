// SPDX-License-Identifier: MIT
/// What the tests of io share: a folder that goes away, bytes, and errors with their text.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::io {

using test::slurp;
using test::TemporaryFolder;

template <typename T>
std::string bytes_of(T value, bool big_endian = false) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

inline std::string floats(std::initializer_list<float> values, bool big_endian = false) {
    std::string bytes;
    for (const float value : values) bytes += bytes_of(value, big_endian);
    return bytes;
}

inline std::vector<double> column(const Cloud& cloud, const std::string& name) {
    const Field* field = cloud.find(name);
    return field == nullptr ? std::vector<double>{} : values(cloud, *field);
}

/// The text of the error of type E that `action` throws.
template <typename E = InputError, typename Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (const E& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

}  // namespace dynamic_filter::io
