# SPDX-License-Identifier: Apache-2.0
# Writes a C++ file with every kernel source as a raw string literal. cmake -DOUTPUT=... -DSOURCES="a;b" -P EmbedKernels.cmake
set(text "// Generated from kernels/. Do not edit.\n#include \"compute/embedded.h\"\nnamespace nephroid::compute {\n")
string(APPEND text "const std::vector<EmbeddedSource>& embedded_sources()\n{\n  static const std::vector<EmbeddedSource> sources{\n")
foreach(source IN LISTS SOURCES)
  get_filename_component(name ${source} NAME)
  file(READ ${source} content)
  string(APPEND text "    {\"${name}\", R\"kernel(${content})kernel\"},\n")
endforeach()
string(APPEND text "  };\n  return sources;\n}\n}\n")
file(WRITE ${OUTPUT} "${text}")
