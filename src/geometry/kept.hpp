// SPDX-License-Identifier: MIT
/// Where a point goes, said once for maps, corrections by hand and the topics of the live filter.
#pragma once

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// What holds a point in the end.
enum class Kept {
    in_map,   ///< the static map
    removed,  ///< the dynamic points
    nowhere   ///< neither: it is unknown, and unknown points are not wanted
};

/// `stays`: a dynamic point that was still in its place when the place was last seen
/// (Verdict::stays).
inline Kept where(Label label, bool stays, bool keep_unknown) {
    if (label == Label::dynamic && !stays) return Kept::removed;
    return label != Label::unknown || keep_unknown ? Kept::in_map : Kept::nowhere;
}

}  // namespace dynamic_filter
