# SPDX-License-Identifier: Apache-2.0
# Read by ctest before it starts: every suite of the GoogleTest program `program` is a test GROUP.SUITE, labelled
# `group`.
if(NOT EXISTS ${program})
  add_test(${group}.not_built ${program})
  set_tests_properties(${group}.not_built PROPERTIES LABELS ${group})
  return()
endif()
# Seconds that the longest suites took in one run of CI, on two busy cores and with kernels to compile. ctest starts
# what costs most first, so that none of these is left running alone at the end.
set(seconds images.All/ShippedPreset 251 environment.EnvironmentRun 182 hostile.CheckVerb 157 hostile.Ranks 156
  physics.Kernels/CheckFault 146 inverse.InverseRun 145 hostile.Resumed 143 environment.EnvironmentRefined 142
  ui.ParametersSchemaTest 138 images.Presets/ErrorEstimate 113 physics.TilesAndPoints 117 hostile.Animations 99
  hostile.Runs 88 ui.FailingMemory 85 physics.RoughnessTextures 77 physics.Layers/SampledPixels 75
  environment.EnvironmentView 71 physics.Lamps 68 physics.NormalMaps 65 hostile.Measured 62)
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
    set(cost 1)
    list(FIND seconds ${group}.${suite} at)
    if(NOT at EQUAL -1)
      math(EXPR at "${at} + 1")
      list(GET seconds ${at} cost)
    endif()
    set_tests_properties(${group}.${suite} PROPERTIES TIMEOUT 1800 LABELS ${group} COST ${cost})
    set(suite "")
  endif()
endforeach()
