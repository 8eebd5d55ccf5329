# The package, as it is built; skipped loudly where it is not.
foreach(unit api arrays clouds examples filter memory odometry programs threads)
  if(DF_BUILD_PYTHON)
    add_test(NAME python/${unit}
      COMMAND ${DF_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/${unit}_test.py)
  else()
    add_test(NAME python/${unit}
      COMMAND sh -c "echo 'skipped: pybind11-dev or python3-dev was missing'; exit 77")
  endif()
  set_tests_properties(python/${unit} PROPERTIES SKIP_RETURN_CODE 77 ENVIRONMENT
    "PYTHONPATH=${CMAKE_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;DYNAMICFILTER_COMMAND=$<TARGET_FILE:dynamicfilter>")
endforeach()

if(DF_BUILD_PYTHON)
  add_test(NAME python/wheel COMMAND ${CMAKE_CURRENT_LIST_DIR}/wheel_test.sh ${PROJECT_SOURCE_DIR} ${DF_PYTHON})
  set_tests_properties(python/wheel PROPERTIES SKIP_RETURN_CODE 77 LABELS slow)
endif()
