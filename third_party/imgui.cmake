# SPDX-License-Identifier: Apache-2.0
# Dear ImGui with its GLFW and OpenGL 3 back ends, from the source archive of imgui-bundle on PyPI (Debian's own Dear ImGui
# is 1.86, without docking). Fetched once at configure time by version and hash into the build folder; -DNEPHROID_IMGUI_BUNDLE=DIR
# or the environment variable of that name gives an unpacked copy instead, so that several build folders share one.
#   nephroid_imgui          the library itself, no display needed: what panels and their tests link
#   nephroid_imgui_backend  GLFW and OpenGL: what the window links
#   nephroid_ui_font        the font of the window, as bytes (third_party/embedded_font.h)
#   nephroid_implot         ImPlot: plots in panels
# ImGuizmo and the command palette lie beside it under external/: a panel that needs one adds a library here.
set(imgui_version 1.93.0)
set(imgui_sha256 10ad1dab8258a6787b4f07bb926b08d0efc648a7906242568c8dd778c5e719bf)
set(imgui_archive_name imgui_bundle-${imgui_version}.tar.gz)

find_package(OpenGL QUIET COMPONENTS OpenGL GLX)
find_package(glfw3 3.3 QUIET)
if(NOT OpenGL_FOUND OR NOT glfw3_FOUND)
  message(FATAL_ERROR "The window needs OpenGL and GLFW 3.3; install libglfw3-dev and libgl-dev, or configure with -DNEPHROID_UI=OFF.")
endif()

# Downloads the archive into folder with pip: it is on PyPI only, and pip knows the mirrors this system is set up for.
function(nephroid_fetch_imgui folder)
  file(MAKE_DIRECTORY ${folder})
  set(archive ${folder}/${imgui_archive_name})
  if(EXISTS ${archive})
    file(SHA256 ${archive} found)
    if(found STREQUAL imgui_sha256)
      return()
    endif()
    file(REMOVE ${archive})
  endif()
  set(way_on "put an unpacked imgui-bundle ${imgui_version} somewhere and configure with -DNEPHROID_IMGUI_BUNDLE=DIR, or build without the window: -DNEPHROID_UI=OFF")
  find_program(NEPHROID_PYTHON NAMES python3 DOC "A Python with pip, to fetch imgui-bundle")
  if(NEPHROID_PYTHON)
    execute_process(COMMAND ${NEPHROID_PYTHON} -m pip --version RESULT_VARIABLE no_pip OUTPUT_QUIET ERROR_QUIET)
  endif()
  if(NOT NEPHROID_PYTHON OR NOT no_pip EQUAL 0)
    message(FATAL_ERROR "imgui-bundle ${imgui_version} cannot be fetched: no python3 with pip; install python3-pip and configure again, or ${way_on}.")
  endif()
  message(STATUS "Fetching imgui-bundle ${imgui_version} (54 MB) with pip")
  file(WRITE ${folder}/requirements.txt "imgui-bundle==${imgui_version} --hash=sha256:${imgui_sha256}\n")
  # --no-binary for this package alone: with :all: pip would also build its own build tools from source, for ten minutes.
  execute_process(COMMAND ${NEPHROID_PYTHON} -m pip download --disable-pip-version-check --no-input --no-deps
                          --no-binary imgui-bundle --require-hashes --dest ${folder} --requirement ${folder}/requirements.txt
                  RESULT_VARIABLE failed OUTPUT_VARIABLE log ERROR_VARIABLE log TIMEOUT 900)
  if(NOT failed EQUAL 0 OR NOT EXISTS ${archive})
    file(WRITE ${folder}/pip.log "${log}")
    string(REGEX MATCHALL "[^\n]*ERROR[^\n]*" reason "${log}")
    message(FATAL_ERROR "imgui-bundle ${imgui_version} cannot be fetched with pip (${reason}; all of it in ${folder}/pip.log); "
                        "check the network and configure again, or ${way_on}.")
  endif()
endfunction()

set(imgui_bundle ${NEPHROID_IMGUI_BUNDLE})
if(NOT imgui_bundle AND DEFINED ENV{NEPHROID_IMGUI_BUNDLE})
  set(imgui_bundle $ENV{NEPHROID_IMGUI_BUNDLE})
endif()
if(NOT imgui_bundle)
  set(imgui_folder ${PROJECT_BINARY_DIR}/third_party)
  set(imgui_bundle ${imgui_folder}/imgui_bundle-${imgui_version})
  if(NOT EXISTS ${imgui_bundle}/unpacked)
    nephroid_fetch_imgui(${imgui_folder})
    file(REMOVE_RECURSE ${imgui_bundle})
    file(ARCHIVE_EXTRACT INPUT ${imgui_folder}/${imgui_archive_name} DESTINATION ${imgui_folder})
    file(TOUCH ${imgui_bundle}/unpacked)
  endif()
endif()
set(imgui ${imgui_bundle}/external/imgui/imgui)
if(NOT EXISTS ${imgui}/imgui.h)
  message(FATAL_ERROR "NEPHROID_IMGUI_BUNDLE=${imgui_bundle} is no unpacked imgui-bundle: external/imgui/imgui/imgui.h is not in it; "
                      "give the folder that imgui_bundle-${imgui_version}.tar.gz unpacks to.")
endif()
file(STRINGS ${imgui}/imgui.h imgui_version_line REGEX "define IMGUI_VERSION +\"")
if(NOT imgui_version_line MATCHES "\"${imgui_version}\"")
  message(WARNING "The window is written for Dear ImGui ${imgui_version}; ${imgui_bundle} has: ${imgui_version_line}")
endif()

# SYSTEM includes and no nephroid_settings: third-party code is compiled without our warnings.
add_library(nephroid_imgui STATIC
  ${imgui}/imgui.cpp ${imgui}/imgui_draw.cpp ${imgui}/imgui_stacklayout.cpp ${imgui}/imgui_tables.cpp ${imgui}/imgui_widgets.cpp)
target_include_directories(nephroid_imgui SYSTEM PUBLIC ${imgui})
# The demo is half of the library's build time, and the debug windows need it.
target_compile_definitions(nephroid_imgui PUBLIC IMGUI_DISABLE_DEMO_WINDOWS IMGUI_DISABLE_DEBUG_TOOLS IMGUI_DISABLE_OBSOLETE_FUNCTIONS)

# Our plots are of doubles; the plotters of nine other number types would be most of the build time.
set(implot ${imgui_bundle}/external/implot/implot)
add_library(nephroid_implot STATIC ${implot}/implot.cpp ${implot}/implot_items.cpp)
target_include_directories(nephroid_implot SYSTEM PUBLIC ${implot})
target_compile_definitions(nephroid_implot PRIVATE "IMPLOT_CUSTOM_NUMERIC_TYPES=(double)")
target_link_libraries(nephroid_implot PUBLIC nephroid_imgui)

add_library(nephroid_imgui_backend STATIC
  ${imgui}/backends/imgui_impl_glfw.cpp ${imgui}/backends/imgui_impl_opengl3.cpp)
target_include_directories(nephroid_imgui_backend SYSTEM PUBLIC ${imgui}/backends)
target_link_libraries(nephroid_imgui_backend PUBLIC nephroid_imgui glfw OpenGL::GL ${CMAKE_DL_LIBS})

set(font ${imgui_bundle}/external/nanovg/nanovg/example/Roboto-Regular.ttf)
set(font_source ${PROJECT_BINARY_DIR}/third_party/embedded_font.cpp)
add_custom_command(OUTPUT ${font_source}
  COMMAND ${CMAKE_COMMAND} -DINPUT=${font} -DOUTPUT=${font_source} -P ${CMAKE_CURRENT_LIST_DIR}/embed_font.cmake
  DEPENDS ${font} ${CMAKE_CURRENT_LIST_DIR}/embed_font.cmake VERBATIM)
add_library(nephroid_ui_font STATIC ${font_source})
target_include_directories(nephroid_ui_font PUBLIC ${PROJECT_SOURCE_DIR})
