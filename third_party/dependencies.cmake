# SPDX-License-Identifier: Apache-2.0
# Every dependency is found here, once. Versions and licences: third_party/README.md.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(OpenCL REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(embree REQUIRED) # 3 or 4
find_package(assimp REQUIRED)
find_package(pugixml REQUIRED)
find_package(ZLIB REQUIRED)
find_package(date REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(CLI11 REQUIRED)
find_package(MPI QUIET COMPONENTS CXX) # without it a run is one process
# STEP files. The toolkits' names are those of 7.6 or of 7.8 and later.
find_package(OpenCASCADE QUIET COMPONENTS FoundationClasses ModelingData ModelingAlgorithms DataExchange)
if(TARGET TKSTEP OR TARGET TKDESTEP)
  set(NEPHROID_OPENCASCADE ON)
  add_library(nephroid_opencascade INTERFACE)
  target_include_directories(nephroid_opencascade SYSTEM INTERFACE ${OpenCASCADE_INCLUDE_DIR})
  target_link_libraries(nephroid_opencascade INTERFACE $<IF:$<TARGET_EXISTS:TKDESTEP>,TKDESTEP,TKSTEP> TKXSBase
    TKShHealing TKTopAlgo TKGeomAlgo TKBRep TKG3d TKG2d TKMath TKernel)
else()
  message(STATUS "OpenCascade is not found: no STEP files (libocct-data-exchange-dev)")
endif()
# OpenImageIO's own CMake package fails on Debian 12 without openimageio-tools; pkg-config works.
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(lcms2 REQUIRED IMPORTED_TARGET lcms2)
pkg_check_modules(qrencode REQUIRED IMPORTED_TARGET libqrencode)
# What draws the charts of a report: a script that becomes part of every page.
find_file(NEPHROID_CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js REQUIRED)
if(NEPHROID_PYTHON_MODULE)
  if(NOT SKBUILD) # Debian's numpy is the system's Python's
    set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of the module and its tests")
  endif()
  find_package(Python 3.10 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 REQUIRED)
endif()
if(NEPHROID_TESTS)
  find_package(GTest REQUIRED)
  find_package(Boost CONFIG REQUIRED) # headers only: Boost.Math
  include(GoogleTest)
endif()
if(NEPHROID_TESTS AND NEPHROID_BENCH)
  find_package(benchmark REQUIRED)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/pip_fetch.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/flip.cmake)
if(NEPHROID_UI)
  include(${CMAKE_CURRENT_LIST_DIR}/imgui.cmake)
endif()
