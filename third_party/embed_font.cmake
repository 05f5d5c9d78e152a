# SPDX-License-Identifier: Apache-2.0
# Writes a C++ file with the bytes of a font. cmake -DINPUT=FONT.ttf -DOUTPUT=FILE.cpp -P embed_font.cmake
file(READ ${INPUT} hex HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
string(REGEX REPLACE
  "([^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n][^\n])" "\\1\n"
  bytes "${bytes}")
file(WRITE ${OUTPUT} "// Generated from ${INPUT}. Do not edit.
#include \"third_party/embedded_font.h\"
namespace nephroid {
namespace {
const unsigned char bytes[] = {\n${bytes}\n};
} // namespace
std::span<const unsigned char> embedded_font() { return bytes; }
} // namespace nephroid
")
