// SPDX-License-Identifier: MIT
#include "dynamic_filter/settings.hpp"

#include <gtest/gtest.h>

#include <array>

#include <limits>
#include <set>
#include <type_traits>

#include "dynamic_filter/error.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace config_test {

template <class T>
constexpr bool is_number = std::is_same_v<T, int> || std::is_same_v<T, double>;

std::vector<Setting> settings() {
    std::vector<Setting> all;
    Config config;
    visit(config, [&](const Setting& s, auto&) { all.push_back(s); });
    return all;
}

std::string message_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

TEST(Config, VisitsEveryFieldInTheOrderOfTheStruct) {
    Config config;
    const char* before = nullptr;
    const char* const start = reinterpret_cast<const char*>(&config);
    visit(config, [&](const Setting& s, const auto& member) {
        const char* const place = reinterpret_cast<const char*>(&member);
        EXPECT_TRUE(place >= start && place < start + sizeof(Config)) << s.key;
        EXPECT_TRUE(before == nullptr || before < place) << s.key;
        before = place;
    });
}

TEST(Config, KeysAreUniqueAndEverySettingIsExplained) {
    std::set<std::string_view> keys;
    for (const Setting& s : settings()) {
        EXPECT_TRUE(keys.insert(s.key).second) << s.key;
        EXPECT_FALSE(s.help.empty()) << s.key;
    }
    Config config;
    visit(config, [&](const Setting& s, const auto& member) {
        if constexpr (is_number<std::decay_t<decltype(member)>>) {
            EXPECT_LT(s.min, s.max) << s.key;
            EXPECT_FALSE(s.unit.empty()) << s.key;
        }
    });
}

TEST(Config, EveryKeyRoundTripsAndLeavesTheOthersAlone) {
    test::Random random(1);
    for (const Setting& s : settings()) {
        for (int repeat = 0; repeat < 20; ++repeat) {
            Config config, wanted;
            visit(wanted, [&](const Setting& w, auto& member) {
                using T = std::decay_t<decltype(member)>;
                if (w.key != s.key) return;
                if constexpr (is_number<T>) {
                    member = static_cast<T>(random.uniform(w.min, w.max));
                } else {
                    member = static_cast<T>(random.below(2));
                }
            });
            set(config, s.key, get(wanted, s.key));
            for (const Setting& other : settings()) {
                EXPECT_EQ(get(config, other.key), get(wanted, other.key)) << other.key;
            }
            visit(wanted, [&](const Setting& w, const auto& expected) {
                visit(config, [&](const Setting& c, const auto& actual) {
                    if constexpr (std::is_same_v<decltype(expected), decltype(actual)>) {
                        EXPECT_TRUE(c.key != w.key || actual == expected) << c.key;
                    }
                });
            });
        }
    }
}

TEST(Config, EveryChoiceHasItsWord) {
    Config config;
    for (const std::string word : {"map", "visibility", "none"}) {
        set(config, "front_end.reverting", word);
        EXPECT_EQ(get(config, "front_end.reverting"), word);
    }
    EXPECT_EQ(config.front_end.reverting, Reverting::none);
    set(config, "method", "removert");
    EXPECT_EQ(config.method, Method::removert);
    set(config, "front_end.enabled", "false");
    EXPECT_FALSE(config.front_end.enabled);
    set(config, "front_end.enabled", "true");
    EXPECT_TRUE(config.front_end.enabled);
}

TEST(Config, NumbersThatAreWholePrintAsTheirKind) {
    Config config;
    set(config, "front_end.tau", "2");
    EXPECT_EQ(get(config, "front_end.tau"), "2.0");
    set(config, "front_end.tau", "2.5");
    EXPECT_EQ(get(config, "front_end.tau"), "2.5");
    set(config, "submap.keyframes", "7");
    EXPECT_EQ(get(config, "submap.keyframes"), "7");
}

TEST(Config, AnUnknownKeyNamesTheNearestOne) {
    Config config;
    const auto says = [&](std::string_view key, std::string_view nearest) {
        const std::string by_set = message_of([&] { set(config, key, "1"); });
        EXPECT_TRUE(contains(by_set, key) && contains(by_set, nearest)) << by_set;
        EXPECT_EQ(by_set, message_of([&] { get(config, key); }));
    };
    says("back_end.voxel_size", "'map.voxel_size'");  // where it stood once
    says("voxel_size", "'map.voxel_size'");
    says("front_end.tua", "'front_end.tau'");
    says("revert_radius", "'front_end.revert_radius'");
    says("Method", "'method'");
    says("voxel_s", "'map.voxel_size'");  // its beginning
    says("keyframe.distanc", "'keyframe.distance'");
    // One letter wrong or missing anywhere still finds the key.
    for (const Setting& s : settings()) {
        std::string typo(s.key);
        typo[typo.size() / 2] = '#';
        says(typo, "'" + std::string(s.key) + "'");
        typo.erase(typo.size() / 2, 1);
        says(typo, "'" + std::string(s.key) + "'");
    }
}

TEST(Config, ABadValueSaysWhatWasExpected) {
    const auto says = [&](std::string_view key, std::string_view value, std::string_view expected) {
        Config config;
        const std::string message = message_of([&] { set(config, key, value); });
        EXPECT_TRUE(contains(message, key) && contains(message, expected)) << key << "=" << value;
        EXPECT_TRUE(contains(message, "'" + std::string(value) + "'")) << message;
    };
    for (const auto* bad : {"", "x", "1x", " 1", "1 ", "--1", "1,5", "1e999"}) {
        says("map.voxel_size", bad, "a number");
    }
    for (const auto* bad : {"", "1.5", "1e3", "99999999999", "0x10"}) {
        says("submap.keyframes", bad, "a whole number");
    }
    for (const auto* bad : {"", "True", "1", "yes"}) {
        says("back_end.enabled", bad, "one of false, true");
    }
    says("front_end.reverting", "maps", "one of map, visibility, none");
    says("method", "", "one of scans, submaps, removert");
}

TEST(Config, ABadValueChangesNothing) {
    for (const auto* bad : {"0.5x", "0.5 ", "0.5,5"}) {
        Config config;
        const std::string before = get(config, "front_end.revert_dist_max");
        EXPECT_THROW(set(config, "front_end.revert_dist_max", bad), ConfigError);
        EXPECT_EQ(get(config, "front_end.revert_dist_max"), before) << bad;
    }
}

/// Calls f(setting, number) for those of a method.
template <class F>
void visit_numbers(Config& config, const F& f) {
    visit(config, [&](const Setting& s, auto& member) {
        if constexpr (is_number<std::decay_t<decltype(member)>>) {
            if (in_force(config, s)) f(s, member);
        }
    });
}

constexpr std::array kMethods{Method::scans, Method::submaps, Method::removert};

TEST(Config, BoundsAreInclusive) {
    for (const Method method : kMethods) {
        Config low, high;
        low.method = high.method = method;
        visit_numbers(low, [](const Setting& s, auto& m) {
            m = static_cast<std::decay_t<decltype(m)>>(s.min);
        });
        visit_numbers(high, [](const Setting& s, auto& m) {
            m = static_cast<std::decay_t<decltype(m)>>(s.max);
        });
        EXPECT_TRUE(violations(low).empty());
        EXPECT_TRUE(violations(high).empty());
        EXPECT_NO_THROW(validate(low));
    }
}

TEST(Config, AllViolationsAreReportedAtOnce) {
    for (const auto& [method, direction] : {std::pair{Method::scans, -1},
                                            {Method::scans, 1},
                                            {Method::submaps, -1},
                                            {Method::submaps, 1}}) {
        Config config;
        config.method = method;
        std::vector<std::string_view> keys;
        const double beyond = direction;
        visit_numbers(config, [&](const Setting& s, auto& member) {
            member =
                static_cast<std::decay_t<decltype(member)>>((beyond < 0 ? s.min : s.max) + beyond);
            keys.push_back(s.key);
        });
        const auto found = violations(config);
        ASSERT_EQ(found.size(), keys.size());
        const std::string message = message_of([&] { validate(config); });
        for (std::size_t i = 0; i < keys.size(); ++i) {
            EXPECT_EQ(found[i].rfind(keys[i], 0), 0U) << found[i];
            EXPECT_TRUE(contains(message, found[i])) << found[i];
        }
    }
}

TEST(Config, NotANumberIsOutOfEveryBound) {
    Config config = preset("paper");
    config.front_end.tau = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(violations(config).size(), 1U);
    config.front_end.tau = std::numeric_limits<double>::infinity();
    EXPECT_EQ(violations(config).size(), 1U);
}

TEST(Config, SwitchingBothEndsOffIsAViolation) {
    Config config = preset("paper");
    config.front_end.enabled = false;
    EXPECT_TRUE(violations(config).empty());
    config.back_end.enabled = false;
    EXPECT_EQ(violations(config).size(), 1U);
    EXPECT_THROW(validate(config), ConfigError);
    config.front_end.enabled = true;
    EXPECT_TRUE(violations(config).empty());
}

TEST(Config, PresetsAreValidAndUnknownOnesNameTheChoices) {
    for (const auto* name : {"default", "paper"}) EXPECT_NO_THROW(validate(preset(name))) << name;
    for (const auto* name : {"", "Default", "erasor"}) {
        const std::string message = message_of([&] { preset(name); });
        EXPECT_TRUE(contains(message, "default") && contains(message, "paper")) << message;
    }
}

TEST(Config, AChangedSettingOfAnotherMethodIsAViolationThatNamesTheMethod) {
    Config config;
    config.back_end.max_submaps = 5;
    ASSERT_EQ(violations(config).size(), 1U);
    EXPECT_TRUE(contains(violations(config)[0], "'back_end.max_submaps'"));
    EXPECT_TRUE(contains(violations(config)[0], "'submaps'"));
    config.method = Method::submaps;
    EXPECT_TRUE(violations(config).empty());
    config.scans.max_keyframes = 5;
    EXPECT_EQ(violations(config).size(), 1U);
    EXPECT_TRUE(contains(violations(config)[0], "'scans'"));
}

TEST(Config, APresetMayBeUsedWithEveryMethod) {
    for (const auto* name : {"default", "paper"}) {
        for (const Method method : kMethods) {
            Config config = preset(name);
            config.method = method;
            EXPECT_TRUE(violations(config).empty()) << name;
        }
    }
}

TEST(Config, EverySettingBelongsToAMethodAndIsRefusedInTheOthers) {
    for (const Method method : kMethods) {
        Config config;
        config.method = method;
        int in = 0, out = 0;
        visit(config, [&](const Setting& s, const auto&) {
            EXPECT_NE(s.methods, 0U) << s.key;
            EXPECT_NE(s.help, "") << s.key;
            const std::string refusal = message_of([&] { require_in_force(config, s.key); });
            EXPECT_EQ(refusal.empty(), in_force(config, s)) << s.key;
            ++(in_force(config, s) ? in : out);
        });
        EXPECT_GT(in, 5);
        EXPECT_GT(out, 5);
    }
}

}  // namespace config_test
}  // namespace dynamic_filter
