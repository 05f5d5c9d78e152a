# SPDX-License-Identifier: Apache-2.0
# How this project makes its libraries and tests: compile settings live here and nowhere else.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# Settings for our own code only: third-party code is compiled without them.
add_library(nephroid_settings INTERFACE)
# With clang a unit has no -Wshadow: it would warn of what another file of the unit keeps to itself. g++ 14 takes what
# an empty std::optional or std::any may hold for uninitialized.
target_compile_options(nephroid_settings INTERFACE -Wall -Wextra
  $<$<NOT:$<AND:$<CXX_COMPILER_ID:Clang>,$<BOOL:${NEPHROID_UNITY}>>>:-Wshadow> -Wpedantic
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<BOOL:${NEPHROID_WERROR}>:-Werror>)
target_include_directories(nephroid_settings INTERFACE ${PROJECT_SOURCE_DIR}/app ${PROJECT_SOURCE_DIR})
target_compile_definitions(nephroid_settings INTERFACE GLM_FORCE_XYZW_ONLY GLM_FORCE_CTOR_INIT)
if(NEPHROID_SANITIZE)
  add_compile_options(-fsanitize=${NEPHROID_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=${NEPHROID_SANITIZE})
endif()

# nephroid_unity(TARGET MOST file...): compiles the files of a folder as one, at most so many in a unit. Most of a
# file's time goes into templates that its neighbours make as well. -DNEPHROID_UNITY=OFF compiles each by itself.
function(nephroid_unity target most)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${NEPHROID_UNITY} UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER ${folder} folder)
    math(EXPR count_${folder} "${count_${folder}} + 0")
    math(EXPR unit "${count_${folder}} / ${most}")
    math(EXPR count_${folder} "${count_${folder}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${unit})
  endforeach()
endfunction()

# Reading, saying, drawing, and what runs once: -O1 compiles it in two thirds to three quarters of the time, and nobody
# waits for it when it runs.
set(nephroid_computes_little check cli compute engine export import job optics plan preset report run spectral ui)

# nephroid_library(NAME [FOLDERS folder...] [LIBS lib...]): every .cpp of the current folder, and of these folders in
# it, as the static library nephroid_NAME.
function(nephroid_library name)
  cmake_parse_arguments(arg "" "" "FOLDERS;LIBS" ${ARGN})
  set(folders . ${arg_FOLDERS})
  list(TRANSFORM folders PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(TRANSFORM folders APPEND /*.cpp OUTPUT_VARIABLE patterns)
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  if(sources)
    add_library(nephroid_${name} STATIC ${sources})
    nephroid_unity(nephroid_${name} 12 ${sources})
    target_link_libraries(nephroid_${name} PUBLIC nephroid_settings ${arg_LIBS})
    if(name IN_LIST nephroid_computes_little)
      target_compile_options(nephroid_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
  else()
    add_library(nephroid_${name} INTERFACE)
    target_link_libraries(nephroid_${name} INTERFACE nephroid_settings ${arg_LIBS})
  endif()
endfunction()

# nephroid_tests(LIB...): every *_test.cpp of the current folder, as the program GROUP_tests; GROUP is the folder's
# name. It links LIB and all of app/, so adding a test is adding a file. nephroid_test_program: the program that tests
# run, if it is not nephroid. ctest runs a suite of GoogleTest at a time, since starting OpenCL takes longer than many a
# test.
function(nephroid_tests)
  get_filename_component(group ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(program ${group}_tests)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  add_executable(${program} ${sources})
  nephroid_unity(${program} 8 ${sources})
  target_link_libraries(${program} PRIVATE nephroid_settings nephroid_cli ${ARGN} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${program} PRIVATE
    NEPHROID_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    NEPHROID_PROGRAM="$<TARGET_FILE:$<IF:$<BOOL:${nephroid_test_program}>,${nephroid_test_program},nephroid>>"
    $<$<BOOL:${NEPHROID_UI}>:NEPHROID_UI>)
  # tests compute little themselves and take long to compile: -O0 in two thirds of the time of -O1
  target_compile_options(${program} PRIVATE -O0)
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/suites.cmake
    CONTENT "set(group ${group})
set(program [[$<TARGET_FILE:${program}>]])
include([[${PROJECT_SOURCE_DIR}/cmake/TestSuites.cmake]])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/suites.cmake)
endfunction()

# nephroid_embed(OUTPUT HEADER SPACE TYPE FUNCTION NAME_PART file...): a .cpp that holds the files as strings
# (EmbedFiles.cmake).
function(nephroid_embed output header space type function name_part)
  set(script ${PROJECT_SOURCE_DIR}/cmake/EmbedFiles.cmake)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${header} -DSPACE=${space} -DTYPE=${type}
            -DFUNCTION=${function} -DNAME_PART=${name_part} "-DSOURCES=${ARGN}" -P ${script}
    DEPENDS ${ARGN} ${script} VERBATIM)
endfunction()
