// SPDX-License-Identifier: MIT
/// What a run has to say about a recording and its result, from whatever part of the program it
/// comes: one list, which the console, run.log, metrics.json, the report and the exit code are made
/// of.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

/// In the order in which they are listed.
enum class RemarkKind {
    note,      ///< what was assumed or chosen
    warning,   ///< a mistake in the recording that is still there
    mended,    ///< a mistake in the recording that the run has put right
    lost,      ///< what of the recording cannot be read, or is not known
    rejected,  ///< a scan that cannot be used
    dropped,   ///< online: a scan that came while the filter was too busy
    alarm,     ///< what a run over a sound recording does not do
};

struct Remark {
    RemarkKind kind = RemarkKind::note;
    std::string text;  ///< a sentence for the user

    bool operator==(const Remark&) const = default;
};

using Remarks = std::vector<Remark>;

void add(Remarks& remarks, RemarkKind kind, std::span<const std::string> texts);

/// The notes and the losses of a recording.
Remarks remarks_on(const io::Recording& recording);

/// The texts of one kind, in order.
std::vector<std::string> texts_of(const Remarks& remarks, RemarkKind kind);

/// True if nothing makes the result doubtful or incomplete.
bool are_harmless(const Remarks& remarks);

/// Lines "warning  <text>", kind by kind.
std::string to_text(const Remarks& remarks);

/// Prints them for the user, kind by kind; `name` is put before each text. `quiet` leaves the notes
/// out.
void tell(std::span<const Remark> remarks, const std::string& name, bool quiet);

/// The name of a kind, as in run.log.
const char* name_of(RemarkKind kind);
/// Throws std::invalid_argument for another name.
RemarkKind remark_kind_of(const std::string& name);

}  // namespace dynamic_filter::app
