# SPDX-License-Identifier: Apache-2.0
# Dear ImGui with its GLFW and OpenGL 3 back ends, from the source archive of imgui-bundle on PyPI (Debian's own Dear
# ImGui is 1.86, without docking). -DNEPHROID_IMGUI_BUNDLE=DIR or the environment variable of that name gives an
# unpacked copy instead (pip_fetch.cmake), so that several build folders share one.
#   nephroid_imgui          the library itself, no display needed: what panels and their tests link
#   nephroid_imgui_backend  GLFW and OpenGL: what the window links
#   nephroid_ui_font        the font of the window, as bytes (third_party/embedded_font.h)
#   nephroid_implot         ImPlot: plots in panels
#   nephroid_imguizmo       ImGuizmo: handles to move, turn and scale things in the View
#   nephroid_fuzzy_search   the search of the command palette
set(imgui_version 1.93.0)

find_package(OpenGL QUIET COMPONENTS OpenGL GLX)
find_package(glfw3 3.3 QUIET)
if(NOT OpenGL_FOUND OR NOT glfw3_FOUND)
  message(FATAL_ERROR
    "The window needs OpenGL and GLFW 3.3; install libglfw3-dev and libgl-dev, or configure with -DNEPHROID_UI=OFF.")
endif()

nephroid_pip_archive(imgui_bundle PACKAGE imgui-bundle VERSION ${imgui_version} SIZE "54 MB"
  ARCHIVE imgui_bundle-${imgui_version}.tar.gz FOLDER imgui_bundle-${imgui_version}
  SHA256 10ad1dab8258a6787b4f07bb926b08d0efc648a7906242568c8dd778c5e719bf
  HOLDS external/imgui/imgui/imgui.h OVERRIDE NEPHROID_IMGUI_BUNDLE OR_ELSE
  ", or build without the window: -DNEPHROID_UI=OFF")
set(imgui ${imgui_bundle}/external/imgui/imgui)
file(STRINGS ${imgui}/imgui.h imgui_version_line REGEX "define IMGUI_VERSION +\"")
if(NOT imgui_version_line MATCHES "\"${imgui_version}\"")
  message(WARNING "The window is written for Dear ImGui ${imgui_version}; ${imgui_bundle} has: ${imgui_version_line}")
endif()

# SYSTEM includes and no nephroid_settings: third-party code is compiled without our warnings.
add_library(nephroid_imgui STATIC
  ${imgui}/imgui.cpp ${imgui}/imgui_draw.cpp ${imgui}/imgui_stacklayout.cpp ${imgui}/imgui_tables.cpp
  ${imgui}/imgui_widgets.cpp ${imgui}/misc/cpp/imgui_stdlib.cpp)
target_include_directories(nephroid_imgui SYSTEM PUBLIC ${imgui} ${imgui}/misc/cpp)
# The demo is half of the library's build time, and the debug windows need it.
target_compile_definitions(nephroid_imgui PUBLIC IMGUI_DISABLE_DEMO_WINDOWS IMGUI_DISABLE_DEBUG_TOOLS
  IMGUI_DISABLE_OBSOLETE_FUNCTIONS IMGUI_DEFINE_MATH_OPERATORS)

# Our plots are of doubles; the plotters of nine other number types would be most of the build time.
set(implot ${imgui_bundle}/external/implot/implot)
add_library(nephroid_implot STATIC ${implot}/implot.cpp ${implot}/implot_items.cpp)
target_include_directories(nephroid_implot SYSTEM PUBLIC ${implot})
target_compile_definitions(nephroid_implot PRIVATE "IMPLOT_CUSTOM_NUMERIC_TYPES=(double)")
target_compile_options(nephroid_implot PRIVATE $<$<CONFIG:Release>:-O1>) # 20 core-seconds, not 35
target_link_libraries(nephroid_implot PUBLIC nephroid_imgui)

set(imguizmo ${imgui_bundle}/external/ImGuizmo/ImGuizmo/src)
add_library(nephroid_imguizmo STATIC ${imguizmo}/ImGuizmo.cpp)
target_include_directories(nephroid_imguizmo SYSTEM PUBLIC ${imguizmo})
target_link_libraries(nephroid_imguizmo PUBLIC nephroid_imgui)

# How well words fit what is typed: of the command palette of the bundle only its search.
set(command_palette ${imgui_bundle}/external/imgui-command-palette/imgui-command-palette)
add_library(nephroid_fuzzy_search STATIC ${command_palette}/imcmd_fuzzy_search.cpp)
target_include_directories(nephroid_fuzzy_search SYSTEM PUBLIC ${command_palette})

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
