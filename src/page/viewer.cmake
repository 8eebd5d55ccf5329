# The viewer's page, if script/bootstrap has fetched what it is made of. The command works without it.
find_program(PYTHON3 python3)
set(viewer ${PROJECT_SOURCE_DIR}/viewer)
file(GLOB esbuild ${viewer}/node_modules/@esbuild/*/bin/esbuild)
if(PYTHON3 AND esbuild)
  set(page ${CMAKE_BINARY_DIR}/viewer.html)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${viewer}/src/*)
  add_custom_command(OUTPUT ${page}
    COMMAND ${PYTHON3} build.py ${page} WORKING_DIRECTORY ${viewer}
    DEPENDS ${sources} ${viewer}/build.py ${viewer}/package-lock.json VERBATIM)
  set_source_files_properties(page/viewer_page.cpp PROPERTIES OBJECT_DEPENDS ${page}
    COMPILE_DEFINITIONS "DYNAMIC_FILTER_VIEWER_PAGE=\"${page}\"")
else()
  message(WARNING "viewer/node_modules is missing: the command is built without report.html and the live view; script/bootstrap fetches it")
endif()
