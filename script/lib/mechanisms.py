"""What the default preset is made of, each as the edit of the sources that takes it away.

They are no settings on purpose. When the code of one changes, its edit is no longer found and the table says so:
copy the new text here. An edit is (file, text that occurs there once, what replaces it).
"""
SIGHT = "src/back_end/sight_kernel.cpp"
EVIDENCE = "src/back_end/evidence.cpp"
MAP = "src/back_end/evidence_map.cpp"
VOTE = "src/back_end/vote_kernel.cpp"

MECHANISMS = {
    "company's vote": [
        (VOTE, "return sum(company) /", "return 0.0F * sum(company) /")],
    "neighbourhood's vote": [
        (VOTE, "2.0F * sum(around) /", "0.0F * sum(around) /")],
    "runs: plain n_free > n_occ instead": [
        (EVIDENCE, "by_switches(e.switches) * returns(e.seen) * owned * owned + kOffset;",
         "0.0F * by_switches(0) * owned + e.seen + kOffset;")],
    "lines left-right": [
        (SIGHT, "all_behind &= ~spans | left_right.before;", "(void)spans, (void)left_right;")],
    "surface between rings occupies": [
        (SIGHT, "touched | (judged & ~all_behind & on_surface);", "touched;")],
    "margins grow with range": [
        ("include/dynamic_filter/back_end/line_of_sight.hpp", "per_metre = 0.007F;", "per_metre = 0.0F;")],
    "new voxels ask earlier keyframes": [
        (MAP, "for (const auto& [observer, weight] : asked) {", "for (const auto& [observer, weight] : {asked.back()}) {")],
    "contact": [
        ("src/back_end/contact.cpp", "if (!moving) return std::nullopt;", "if (true) return std::nullopt;")],
}
