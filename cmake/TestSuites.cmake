# SPDX-License-Identifier: Apache-2.0
# Read by ctest before it starts: every suite of the GoogleTest program `program` is a test GROUP.SUITE, labelled `group`.
if(NOT EXISTS ${program})
  add_test(${group}.not_built ${program})
  set_tests_properties(${group}.not_built PROPERTIES LABELS ${group})
  return()
endif()
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "#[^\n]*" "" lines "${lines}") # "# GetParam() = ..." may have brackets and semicolons
string(REPLACE "\n" ";" lines "${lines}")
# A line "Prefix/Suite." opens a suite; a line that is indented is a test of it.
set(suite "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.")
    set(suite ${CMAKE_MATCH_1})
  elseif(suite AND line MATCHES "^  " AND NOT line MATCHES "^  DISABLED_" AND NOT suite MATCHES "(^|/)DISABLED_")
    add_test(${group}.${suite} ${program} --gtest_filter=${suite}.*)
    set_tests_properties(${group}.${suite} PROPERTIES TIMEOUT 600 LABELS ${group})
    set(suite "")
  endif()
endforeach()
