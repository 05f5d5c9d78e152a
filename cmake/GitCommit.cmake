# SPDX-License-Identifier: Apache-2.0
# Writes a header with `git describe` of the sources, only when it changed: cmake -DSOURCE=... -DOUTPUT=... -P
# GitCommit.cmake
execute_process(COMMAND git describe --always --dirty --tags WORKING_DIRECTORY ${SOURCE}
  OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  set(commit "")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define NEPHROID_COMMIT \"${commit}\"\n")
