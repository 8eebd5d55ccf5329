// SPDX-License-Identifier: MIT
#include "run/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "base/say.hpp"

namespace dynamic_filter::app {
namespace {

constexpr std::array kRemarkNames = {"note",     "warning", "mended", "lost",
                                     "rejected", "dropped", "alarm"};

template <typename Use>
void kind_by_kind(std::span<const Remark> remarks, const Use& use) {
    for (std::size_t kind = 0; kind < kRemarkNames.size(); ++kind) {
        for (const Remark& remark : remarks) {
            if (remark.kind == static_cast<RemarkKind>(kind)) use(remark);
        }
    }
}

}  // namespace

const char* name_of(RemarkKind kind) { return kRemarkNames[static_cast<std::size_t>(kind)]; }

RemarkKind remark_kind_of(const std::string& name) {
    const auto* const found = std::find(kRemarkNames.begin(), kRemarkNames.end(), name);
    if (found == kRemarkNames.end()) throw std::invalid_argument("no kind of remark: " + name);
    return static_cast<RemarkKind>(found - kRemarkNames.begin());
}

void add(Remarks& remarks, RemarkKind kind, std::span<const std::string> texts) {
    for (const std::string& text : texts) remarks.push_back({kind, text});
}

Remarks remarks_on(const io::Recording& recording) {
    Remarks remarks;
    add(remarks, RemarkKind::note, recording.info().notes);
    add(remarks, RemarkKind::lost, recording.info().losses);
    return remarks;
}

std::vector<std::string> texts_of(const Remarks& remarks, RemarkKind kind) {
    std::vector<std::string> texts;
    for (const Remark& remark : remarks) {
        if (remark.kind == kind) texts.push_back(remark.text);
    }
    return texts;
}

bool are_harmless(const Remarks& remarks) {
    return std::all_of(remarks.begin(), remarks.end(), [](const Remark& remark) {
        return remark.kind == RemarkKind::note || remark.kind == RemarkKind::mended;
    });
}

std::string to_text(const Remarks& remarks) {
    std::string text;
    kind_by_kind(remarks, [&](const Remark& remark) {
        text += fmt::format("{:<8} {}\n", name_of(remark.kind), remark.text);
    });
    return text;
}

void tell(std::span<const Remark> remarks, const std::string& name, bool quiet) {
    kind_by_kind(remarks, [&](const Remark& remark) {
        if (quiet && remark.kind == RemarkKind::note) return;
        if (remark.kind <= RemarkKind::mended) {
            const bool is_note = remark.kind == RemarkKind::note;
            say(stderr, "{}: {}{}\n", is_note ? "note" : "warning", name, remark.text);
        } else {
            say(stderr, "{:<8} {}{}\n", name_of(remark.kind), name, remark.text);
        }
    });
}

}  // namespace dynamic_filter::app
