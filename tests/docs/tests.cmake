# Every command of the pages, as it stands there; what takes long is apart.
set(pages ${CMAKE_CURRENT_LIST_DIR}/pages_test.sh ${PROJECT_SOURCE_DIR} $<TARGET_FILE:dynamicfilter>)
add_test(NAME docs/pages COMMAND ${pages} README.md docs/tutorial.md docs/how-it-works.md docs/paper.md docs/scores.md docs/editing.md docs/city.md docs/upkeep.md docs/rigs.md docs/arenas.md
         docs/online.md docs/parameters.md docs/poses.md docs/troubleshooting.md)
add_test(NAME docs/pages_of_results COMMAND ${pages} docs/results.md)
add_test(NAME docs/links COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/links_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME docs/figures COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/figures_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME docs/parameters COMMAND sh -c
         "'${DF_PYTHON}' docs/_ext/parameters.py '$<TARGET_FILE:dynamicfilter>' | diff - docs/parameters.md")
set_tests_properties(docs/parameters PROPERTIES WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
add_test(NAME docs/site COMMAND ${DF_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/site_test.py ${PROJECT_SOURCE_DIR} ${CMAKE_BINARY_DIR})
set_tests_properties(docs/pages PROPERTIES COST 100)  # the longest after the viewer
set_tests_properties(docs/site docs/pages_of_results PROPERTIES LABELS slow)
set_tests_properties(docs/site PROPERTIES SKIP_RETURN_CODE 77)
