// SPDX-License-Identifier: MIT
#include "run/remarks.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dynamic_filter::app {
namespace remarks_test {

const Remarks kRemarks = {{RemarkKind::alarm, "the ground is gone"},
                          {RemarkKind::note, "poses from poses.txt"},
                          {RemarkKind::rejected, "000003: truncated"},
                          {RemarkKind::mended, "poses were in centimetres"},
                          {RemarkKind::note, "10 Hz assumed"}};

TEST(Remarks, AreListedKindByKindInTheirOrder) {
    EXPECT_EQ(to_text(kRemarks),
              "note     poses from poses.txt\n"
              "note     10 Hz assumed\n"
              "mended   poses were in centimetres\n"
              "rejected 000003: truncated\n"
              "alarm    the ground is gone\n");
    EXPECT_EQ(texts_of(kRemarks, RemarkKind::note),
              (std::vector<std::string>{"poses from poses.txt", "10 Hz assumed"}));
    EXPECT_TRUE(texts_of(kRemarks, RemarkKind::lost).empty());
}

TEST(Remarks, OnlyNotesAndWhatWasMendedAreHarmless) {
    for (const RemarkKind kind :
         {RemarkKind::note, RemarkKind::warning, RemarkKind::mended, RemarkKind::lost,
          RemarkKind::rejected, RemarkKind::dropped, RemarkKind::alarm}) {
        const bool is_harmless = kind == RemarkKind::note || kind == RemarkKind::mended;
        EXPECT_EQ(are_harmless({{RemarkKind::note, "a"}, {kind, "b"}}), is_harmless)
            << name_of(kind);
        EXPECT_EQ(remark_kind_of(name_of(kind)), kind);
    }
    EXPECT_TRUE(are_harmless({}));
    EXPECT_THROW(remark_kind_of("remark"), std::invalid_argument);
}

TEST(Remarks, QuietLeavesOutNotesAlone) {
    testing::internal::CaptureStderr();
    tell(kRemarks, "b: ", true);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "warning: b: poses were in centimetres\n"
              "rejected b: 000003: truncated\n"
              "alarm    b: the ground is gone\n");
}

}  // namespace remarks_test
}  // namespace dynamic_filter::app
