# SPDX-License-Identifier: Apache-2.0
# FLIP, the error metric for pictures, as its authors wrote it: one C++ header in the source archive of flip-evaluator
# on PyPI.
# -DNEPHROID_FLIP=DIR or the environment variable of that name gives an unpacked copy, so that several build folders
# share one.
#   nephroid_flip   the header: what app/measure/flip.cpp links
nephroid_pip_archive(flip PACKAGE flip-evaluator VERSION 1.7 SIZE "0.2 MB"
  ARCHIVE flip_evaluator-1.7.tar.gz FOLDER flip-evaluator-1.7 HOLDS src/cpp/FLIP.h
  SHA256 88204ec5000fa90b26e00f6f21e8d73f18e5afac7e8a23cb0803b117b3da081b
  OVERRIDE NEPHROID_FLIP)
add_library(nephroid_flip INTERFACE)
# SYSTEM: third-party code is compiled without our warnings.
target_include_directories(nephroid_flip SYSTEM INTERFACE ${flip}/src/cpp)
