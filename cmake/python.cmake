# Whether the Python package is built. AUTO: if pybind11 and Python's headers are there.
set(DYNAMIC_FILTER_PYTHON AUTO CACHE STRING "Build the Python package (ON, OFF, AUTO)")
set_property(CACHE DYNAMIC_FILTER_PYTHON PROPERTY STRINGS AUTO ON OFF)

set(DF_BUILD_PYTHON OFF)
if(DYNAMIC_FILTER_PYTHON)
  # The system's Python, if there is one, as that is the one for which Debian has packages.
  find_program(Python3_EXECUTABLE python3 PATHS /usr/bin NO_DEFAULT_PATH)
  if(DYNAMIC_FILTER_PYTHON STREQUAL AUTO)
    find_package(Python3 COMPONENTS Interpreter Development.Module QUIET)
    find_package(pybind11 2.10 QUIET)
  else()
    find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
    find_package(pybind11 2.10 REQUIRED)
  endif()
  if(Python3_Development.Module_FOUND AND pybind11_FOUND)
    set(DF_BUILD_PYTHON ON)
    set(CMAKE_POSITION_INDEPENDENT_CODE ON)  # the module holds the libraries
  else()
    message(STATUS "No Python package: pybind11-dev or python3-dev is missing")
  endif()
endif()
