# The viewer's page, where npm gave what it is made of (script/bootstrap). The command works without.
find_program(NODE node)
set(viewer ${PROJECT_SOURCE_DIR}/viewer)
if(NODE AND EXISTS ${viewer}/node_modules/.package-lock.json)
  set(page ${CMAKE_BINARY_DIR}/viewer.html)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${viewer}/src/*)
  add_custom_command(OUTPUT ${page}
    COMMAND ${NODE} build.mjs ${page} WORKING_DIRECTORY ${viewer}
    DEPENDS ${sources} ${viewer}/build.mjs ${viewer}/package-lock.json VERBATIM)
  set_source_files_properties(view/viewer_page.cpp PROPERTIES OBJECT_DEPENDS ${page}
    COMPILE_DEFINITIONS "DYNAMIC_FILTER_VIEWER_PAGE=\"${page}\"")
else()
  message(WARNING "viewer/node_modules is missing: built without report.html and the live view")
endif()
