# Everything that is not clothlab's own: found in the distribution, or built from the imgui-bundle sources.

# Finds a package, or ends with a sentence that says what to install.
macro(clothlab_find name debian)
    find_package(${name} ${ARGN} QUIET)
    if(NOT ${name}_FOUND)
        message(FATAL_ERROR "${name} ${ARGN} was not found: run cmake/setup.sh, or install ${debian}")
    endif()
endmacro()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
clothlab_find(nlohmann_json nlohmann-json3-dev)
clothlab_find(CLI11 libcli11-dev)
clothlab_find(Eigen3 libeigen3-dev)
clothlab_find(hwy libhwy-dev)
add_library(hwy INTERFACE)
target_link_libraries(hwy INTERFACE hwy::hwy)
find_path(LZ4_INCLUDE_DIR lz4.h)
find_library(LZ4_LIBRARY lz4)
mark_as_advanced(LZ4_INCLUDE_DIR LZ4_LIBRARY)
if(NOT LZ4_INCLUDE_DIR OR NOT LZ4_LIBRARY)
    message(FATAL_ERROR "LZ4 was not found: run cmake/setup.sh, or install liblz4-dev")
endif()
add_library(lz4 INTERFACE)
target_include_directories(lz4 SYSTEM INTERFACE ${LZ4_INCLUDE_DIR})
target_link_libraries(lz4 INTERFACE ${LZ4_LIBRARY})
if(CLOTHLAB_TESTS)
    clothlab_find(Catch2 "catch2 3 (or configure with -DCLOTHLAB_TESTS=OFF)" 3)
    include(Catch)
endif()
if(NOT CLOTHLAB_GUI)
    return()
endif()

clothlab_find(glm libglm-dev)
find_path(STB_INCLUDE_DIR stb/stb_image_write.h)
if(NOT STB_INCLUDE_DIR)
    message(FATAL_ERROR "stb was not found: run cmake/setup.sh, or install libstb-dev")
endif()
add_library(stb INTERFACE)
target_include_directories(stb SYSTEM INTERFACE ${STB_INCLUDE_DIR} ${STB_INCLUDE_DIR}/stb)

set(bundle_default ${CMAKE_SOURCE_DIR}/third_party/imgui-bundle)
if(NOT "$ENV{CLOTHLAB_IMGUI_BUNDLE_DIR}" STREQUAL "")
    set(bundle_default $ENV{CLOTHLAB_IMGUI_BUNDLE_DIR})
endif()
set(CLOTHLAB_IMGUI_BUNDLE_DIR ${bundle_default} CACHE PATH "imgui-bundle's unpacked source release")
set(external ${CLOTHLAB_IMGUI_BUNDLE_DIR}/external)
if(NOT EXISTS ${external}/imgui/imgui/imgui.h)
    message(FATAL_ERROR "imgui-bundle is not in ${CLOTHLAB_IMGUI_BUNDLE_DIR}: run cmake/setup.sh gui, "
        "or point -DCLOTHLAB_IMGUI_BUNDLE_DIR at its unpacked source release, or configure with -DCLOTHLAB_GUI=OFF")
endif()

# Not ours to debug or to fix: optimised in every build, silent, without sanitizers (after the build type's options,
# so they win).
function(clothlab_foreign target)
    target_compile_options(${target} PRIVATE -O2 -w)
    target_compile_features(${target} PUBLIC cxx_std_20)
endfunction()

# --- glad: the OpenGL loader, generated from the Khronos XML that comes with it --------------------------------------

# The distribution's generator first: another Python on PATH may bring a glad of its own, of version 1.
find_program(GLAD_PROGRAM glad PATHS /usr/bin NO_DEFAULT_PATH)
find_program(GLAD_PROGRAM glad)
if(NOT GLAD_PROGRAM)
    message(FATAL_ERROR "glad 2 was not found: run cmake/setup.sh gui, or install python3-glad")
endif()
set(glad ${CMAKE_BINARY_DIR}/glad)
add_custom_command(
    OUTPUT ${glad}/src/gl.c ${glad}/include/glad/gl.h
    # reproducible: take the XML it ships with, ask no network
    COMMAND ${GLAD_PROGRAM} --quiet --reproducible --api gl:core=3.3
        --extensions GL_KHR_debug,GL_EXT_texture_filter_anisotropic --out-path ${glad} c
    COMMENT "Generating the OpenGL 3.3 loader" VERBATIM)
add_library(glad STATIC ${glad}/src/gl.c ${glad}/include/glad/gl.h)
target_include_directories(glad SYSTEM PUBLIC ${glad}/include)
clothlab_foreign(glad)

# --- GLFW ------------------------------------------------------------------------------------------------------------

# Asked for here, because GLFW's own errors do not say what to install.
find_package(PkgConfig QUIET)
if(NOT PkgConfig_FOUND)
    message(FATAL_ERROR "pkg-config was not found: run cmake/setup.sh, or install pkgconf")
endif()
set(missing)
foreach(library IN ITEMS x11 xrandr xinerama xcursor xi xext xkbcommon wayland-client wayland-cursor wayland-egl)
    pkg_check_modules(glfw_needs_${library} QUIET ${library})
    if(NOT glfw_needs_${library}_FOUND)
        list(APPEND missing ${library})
    endif()
endforeach()
find_program(WAYLAND_SCANNER_EXECUTABLE wayland-scanner)
if(NOT WAYLAND_SCANNER_EXECUTABLE)
    list(APPEND missing wayland-scanner)
endif()
if(missing)
    list(JOIN missing ", " missing)
    message(FATAL_ERROR "GLFW needs ${missing}: run cmake/setup.sh gui, or install libx11-dev libxrandr-dev "
        "libxinerama-dev libxcursor-dev libxi-dev libxext-dev libxkbcommon-dev libwayland-dev libwayland-bin")
endif()

foreach(part IN ITEMS DOCS TESTS EXAMPLES)
    set(GLFW_BUILD_${part} OFF)
endforeach()
set(GLFW_INSTALL OFF)
set(GLFW_LIBRARY_TYPE STATIC)
add_subdirectory(${external}/glfw/glfw ${CMAKE_BINARY_DIR}/glfw EXCLUDE_FROM_ALL SYSTEM)
target_compile_options(glfw PRIVATE -O2 -w)
target_compile_definitions(glfw INTERFACE GLFW_INCLUDE_NONE) # glad brings the OpenGL declarations

# --- Dear ImGui ------------------------------------------------------------------------------------------------------

set(imgui ${external}/imgui/imgui)
set(test_engine ${external}/imgui_test_engine/imgui_test_engine)

# One configuration for both builds of ImGui and for everything that includes it. IMGUI_ENABLE_TEST_ENGINE is not part
# of it and need not be: in the headers it adds only enum values and macros of imgui_internal.h, no struct member.
add_library(imgui_headers INTERFACE)
target_include_directories(imgui_headers SYSTEM INTERFACE
    ${imgui} ${imgui}/backends ${imgui}/misc/cpp ${external}/hello_imgui/hello_imgui/src/hello_imgui)
target_compile_definitions(imgui_headers INTERFACE IMGUI_DISABLE_OBSOLETE_FUNCTIONS)

# By pattern: the bundle's fork has files that the official release has not.
file(GLOB imgui_sources CONFIGURE_DEPENDS ${imgui}/imgui*.cpp)
list(APPEND imgui_sources ${imgui}/backends/imgui_impl_glfw.cpp ${imgui}/backends/imgui_impl_opengl3.cpp
    ${imgui}/misc/cpp/imgui_stdlib.cpp)

# Object libraries, so that the programs may choose one of the two after the layers that use ImGui, whatever the
# order in which the linker sees these.
add_library(imgui OBJECT EXCLUDE_FROM_ALL ${imgui_sources})
target_link_libraries(imgui PUBLIC imgui_headers glfw)
clothlab_foreign(imgui)

if(CLOTHLAB_TESTS)
    # The engine's licence is its own: for the test binary only.
    file(GLOB test_engine_sources CONFIGURE_DEPENDS ${test_engine}/imgui_test_engine/*.cpp)
    add_library(imgui_with_test_engine OBJECT EXCLUDE_FROM_ALL ${imgui_sources} ${test_engine_sources})
    # Its parent folder too, for #include "imgui_test_engine/imgui_te_engine.h".
    target_include_directories(imgui_with_test_engine SYSTEM PUBLIC ${test_engine} ${test_engine}/imgui_test_engine)
    target_compile_definitions(imgui_with_test_engine PUBLIC
        IMGUI_ENABLE_TEST_ENGINE IMGUI_TEST_ENGINE_ENABLE_COROUTINE_STDTHREAD_IMPL=1)
    target_link_libraries(imgui_with_test_engine PUBLIC imgui_headers glfw Threads::Threads)
    clothlab_foreign(imgui_with_test_engine)
endif()

add_library(portable_file_dialogs INTERFACE)
target_include_directories(portable_file_dialogs SYSTEM INTERFACE ${external}/portable_file_dialogs/portable_file_dialogs)

# --- ImGuiColorTextEdit: the shader panel's text editor ---------------------------------------------------------------

set(color_text_edit ${external}/ImGuiColorTextEdit/ImGuiColorTextEdit)
if(NOT EXISTS ${color_text_edit}/TextEditor.h)
    message(FATAL_ERROR "${CLOTHLAB_IMGUI_BUNDLE_DIR} has no ImGuiColorTextEdit: run cmake/setup.sh gui, or point "
        "-DCLOTHLAB_IMGUI_BUNDLE_DIR at the unpacked source release imgui-bundle")
endif()
# Like the layers, it knows ImGui's headers only.
add_library(imgui_color_text_edit STATIC EXCLUDE_FROM_ALL ${color_text_edit}/TextEditor.cpp)
target_include_directories(imgui_color_text_edit SYSTEM PUBLIC ${color_text_edit})
target_link_libraries(imgui_color_text_edit PUBLIC imgui_headers)
clothlab_foreign(imgui_color_text_edit)

# --- ImPlot: charts ---------------------------------------------------------------------------------------------------

set(implot ${external}/implot/implot)
if(NOT EXISTS ${implot}/implot.h)
    message(FATAL_ERROR "${CLOTHLAB_IMGUI_BUNDLE_DIR} has no ImPlot: run cmake/setup.sh gui, or point "
        "-DCLOTHLAB_IMGUI_BUNDLE_DIR at the unpacked source release imgui-bundle")
endif()
add_library(implot STATIC EXCLUDE_FROM_ALL ${implot}/implot.cpp ${implot}/implot_items.cpp)
target_include_directories(implot SYSTEM PUBLIC ${implot})
target_link_libraries(implot PUBLIC imgui_headers)
clothlab_foreign(implot)
# Each kind of number makes hundreds of functions; with all of them and -O3 it compiles for two minutes.
target_compile_definitions(implot PUBLIC "IMPLOT_CUSTOM_NUMERIC_TYPES=(float)(double)")
target_compile_options(implot PRIVATE -O1)

# --- fonts -----------------------------------------------------------------------------------------------------------

set(rich_md_fonts ${external}/imgui_rich_md/imgui_rich_md/assets/fonts)
set(hello_fonts ${external}/hello_imgui/hello_imgui/hello_imgui_assets/fonts)
set(fonts)
foreach(font IN ITEMS
        ${rich_md_fonts}/Roboto/Roboto-Regular.ttf ${rich_md_fonts}/Roboto/Roboto-Bold.ttf
        ${CMAKE_SOURCE_DIR}/cmake/LICENSE-Roboto.txt
        ${rich_md_fonts}/Inconsolata-Medium.ttf ${rich_md_fonts}/Inconsolata-LICENSE-OFL.txt
        ${hello_fonts}/Font_Awesome_6_Free-Solid-900.otf ${hello_fonts}/LICENSE-FontAwesome.txt)
    cmake_path(GET font FILENAME name)
    add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/fonts/${name} DEPENDS ${font}
        COMMAND ${CMAKE_COMMAND} -E copy ${font} ${CMAKE_BINARY_DIR}/fonts/${name} COMMENT "Copying ${name}" VERBATIM)
    list(APPEND fonts ${CMAKE_BINARY_DIR}/fonts/${name})
endforeach()
add_custom_target(clothlab_fonts DEPENDS ${fonts})
