# SPDX-License-Identifier: Apache-2.0
# Source archives that are on PyPI only: fetched once at configure time by version and hash with pip, which knows the
# mirrors this system is set up for, and unpacked into the build folder; or an unpacked copy that the builder names.

find_program(NEPHROID_PYTHON NAMES python3 DOC "A Python with pip, to fetch source archives from PyPI")

# nephroid_pip_archive(OUT PACKAGE name VERSION v SHA256 h ARCHIVE name FOLDER name SIZE text OVERRIDE variable HOLDS
# file OR_ELSE words) OUT: variable that becomes the folder of the unpacked archive. FOLDER: what ARCHIVE unpacks to.
# OVERRIDE: CMake or environment variable that names an unpacked copy. HOLDS: a file that tells a right folder from a
# wrong one. OR_ELSE: what else the builder may do where it cannot be fetched.
function(nephroid_pip_archive out)
  cmake_parse_arguments(arg "" "PACKAGE;VERSION;SHA256;ARCHIVE;FOLDER;SIZE;OVERRIDE;HOLDS;OR_ELSE" "" ${ARGN})
  set(unpacked ${${arg_OVERRIDE}})
  if(NOT unpacked AND DEFINED ENV{${arg_OVERRIDE}})
    set(unpacked $ENV{${arg_OVERRIDE}})
  endif()
  if(NOT unpacked)
    set(folder ${PROJECT_BINARY_DIR}/third_party)
    set(unpacked ${folder}/${arg_FOLDER})
    if(NOT EXISTS ${unpacked}/unpacked)
      nephroid_pip_download(${folder}/${arg_ARCHIVE})
      file(REMOVE_RECURSE ${unpacked})
      file(ARCHIVE_EXTRACT INPUT ${folder}/${arg_ARCHIVE} DESTINATION ${folder})
      file(TOUCH ${unpacked}/unpacked)
    endif()
  endif()
  if(NOT EXISTS ${unpacked}/${arg_HOLDS})
    message(FATAL_ERROR "${arg_OVERRIDE}=${unpacked} is no unpacked ${arg_PACKAGE}: ${arg_HOLDS} is not in it; "
                        "give the folder that ${arg_ARCHIVE} unpacks to.")
  endif()
  set(${out} ${unpacked} PARENT_SCOPE)
endfunction()

# For nephroid_pip_archive alone, whose arg_ variables it reads.
function(nephroid_pip_download archive)
  get_filename_component(folder ${archive} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  if(EXISTS ${archive})
    file(SHA256 ${archive} found)
    if(found STREQUAL arg_SHA256)
      return()
    endif()
    file(REMOVE ${archive})
  endif()
  set(what "${arg_PACKAGE} ${arg_VERSION}")
  set(way_on "put an unpacked ${what} somewhere and configure with -D${arg_OVERRIDE}=DIR${arg_OR_ELSE}")
  if(NEPHROID_PYTHON)
    execute_process(COMMAND ${NEPHROID_PYTHON} -m pip --version RESULT_VARIABLE no_pip OUTPUT_QUIET ERROR_QUIET)
  endif()
  if(NOT NEPHROID_PYTHON OR NOT no_pip EQUAL 0)
    message(FATAL_ERROR
      "${what} cannot be fetched: no python3 with pip; install python3-pip and configure again, or ${way_on}.")
  endif()
  message(STATUS "Fetching ${what} (${arg_SIZE}) with pip")
  set(list ${folder}/${arg_PACKAGE}.txt)
  file(WRITE ${list} "${arg_PACKAGE}==${arg_VERSION} --hash=sha256:${arg_SHA256}\n")
  # --no-binary for this package alone: with :all: pip would also build its own build tools from source, for ten
  # minutes.
  execute_process(COMMAND ${NEPHROID_PYTHON} -m pip download --disable-pip-version-check --no-input --no-deps
                          --no-binary ${arg_PACKAGE} --require-hashes --dest ${folder} --requirement ${list}
                  RESULT_VARIABLE failed OUTPUT_VARIABLE log ERROR_VARIABLE log TIMEOUT 900)
  if(NOT failed EQUAL 0 OR NOT EXISTS ${archive})
    file(WRITE ${folder}/pip.log "${log}")
    string(REGEX MATCHALL "[^\n]*ERROR[^\n]*" reason "${log}")
    message(FATAL_ERROR "${what} cannot be fetched with pip (${reason}; all of it in ${folder}/pip.log); "
                        "check the network and configure again, or ${way_on}.")
  endif()
endfunction()
