# The page in a browser; skipped where Chromium or packages of viewer/node_modules are missing.
add_test(NAME viewer COMMAND ${CMAKE_CURRENT_LIST_DIR}/run.sh ${CMAKE_BINARY_DIR}/viewer.html)
set_tests_properties(viewer PROPERTIES COST 300)  # the longest of the default ones: first
set_tests_properties(viewer PROPERTIES SKIP_RETURN_CODE 77 ENVIRONMENT
  "DF_COMMAND=$<TARGET_FILE:dynamicfilter>;VIEWER_SCREENSHOTS=${CMAKE_BINARY_DIR}/viewer-screenshots")
