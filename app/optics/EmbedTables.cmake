# SPDX-License-Identifier: Apache-2.0
# Writes a C++ file with every colour table as a raw string literal. cmake -DOUTPUT=... -DSOURCES="a;b" -P EmbedTables.cmake
set(text "// Generated from app/optics/data/. Do not edit.\n#include \"optics/tables.h\"\nnamespace nephroid::optics {\n")
string(APPEND text "const std::vector<EmbeddedTable>& embedded_tables()\n{\n  static const std::vector<EmbeddedTable> tables{\n")
foreach(source IN LISTS SOURCES)
  get_filename_component(name ${source} NAME_WLE)
  file(READ ${source} content)
  string(APPEND text "    {\"${name}\", R\"table(${content})table\"},\n")
endforeach()
string(APPEND text "  };\n  return tables;\n}\n}\n")
file(WRITE ${OUTPUT} "${text}")
