# SPDX-License-Identifier: Apache-2.0
# Writes a C++ file whose function gives text files as raw strings; nephroid_embed in NephroidTargets.cmake calls it.
# Variables: OUTPUT; SOURCES, a list; HEADER, which declares SPACE::TYPE {name, text} and SPACE::FUNCTION; NAME_PART,
# what of a file's name is kept: NAME, NAME_WLE, or the folder that names are relative to.
set(text "// Generated from the files named below. Do not edit.\n#include \"${HEADER}\"\nnamespace ${SPACE} {\n")
string(APPEND text "const std::vector<${TYPE}>& ${FUNCTION}()\n{\n  static const std::vector<${TYPE}> files{\n")
foreach(source IN LISTS SOURCES)
  if(IS_ABSOLUTE ${NAME_PART})
    file(RELATIVE_PATH name ${NAME_PART} ${source})
  else()
    get_filename_component(name ${source} ${NAME_PART})
  endif()
  file(READ ${source} content)
  string(APPEND text "    {\"${name}\", R\"embedded(${content})embedded\"},\n")
endforeach()
string(APPEND text "  };\n  return files;\n}\n}\n")
file(WRITE ${OUTPUT} "${text}")
