// SPDX-License-Identifier: MIT
// All tests in one process, which is to say in one browser.
import "./build_checks.mjs";
import "./report_checks.mjs";
import "./explain_checks.mjs";
import "./playback_checks.mjs";
import "./look_checks.mjs";
import "./compare_checks.mjs";
import "./live_checks.mjs";
import "./big_checks.mjs";
import "./command_checks.mjs";
import "./edit_checks.mjs";
import "./city_checks.mjs";
