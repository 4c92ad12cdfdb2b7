# How clothlab's own targets are made: C++20, warnings, sanitizers, sources by pattern.

# Sets OUT to the sources that match PATTERN...; `folder/**.cpp` also looks in the folders below, `folder/*.cpp` does
# not. Files under the folder named after EXCLUDE are left out. New files are found by the next build.
function(clothlab_glob out)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "EXCLUDE" "")
    set(sources)
    foreach(pattern IN LISTS arg_UNPARSED_ARGUMENTS)
        if(pattern MATCHES "^(.*)\\*\\*(.*)$")
            file(GLOB_RECURSE found CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${CMAKE_MATCH_1}*${CMAKE_MATCH_2})
        else()
            file(GLOB found CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${pattern})
        endif()
        list(APPEND sources ${found})
    endforeach()
    if(arg_EXCLUDE)
        list(FILTER sources EXCLUDE REGEX "^${CMAKE_SOURCE_DIR}/${arg_EXCLUDE}")
    endif()
    if(NOT sources) # a layer that has only headers so far
        file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/empty.cpp CONTENT "")
        set(sources ${CMAKE_BINARY_DIR}/empty.cpp)
    endif()
    set(${out} ${sources} PARENT_SCOPE)
endfunction()

function(clothlab_own target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    target_include_directories(${target} PUBLIC ${CMAKE_SOURCE_DIR}/src)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow)
    # GCC 12 takes std::string's operator+ for an overlapping copy (its bug 105651).
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
    if(CLOTHLAB_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    # The standard library's own checks (indices, empty optionals) wherever speed is not the point.
    target_compile_definitions(${target} PRIVATE $<$<NOT:$<CONFIG:Release,MinSizeRel>>:_GLIBCXX_ASSERTIONS>)
    if(CLOTHLAB_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=${CLOTHLAB_SANITIZE} -fno-omit-frame-pointer)
        # GCC's flow analysis reports false positives in instrumented code.
        target_compile_options(${target} PRIVATE
            "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-alloc-size-larger-than>")
        target_link_options(${target} PUBLIC -fsanitize=${CLOTHLAB_SANITIZE})
    endif()
    if(CMAKE_UNITY_BUILD)
        # Several sources of a target are compiled as one, which takes less time: so their anonymous namespaces must not
        # name two things alike. What one has in them does shadow what is local in the next, and to GCC they are headers.
        target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    endif()
endfunction()

function(clothlab_library target) # PATTERN... [EXCLUDE FOLDER]
    clothlab_glob(sources ${ARGN})
    add_library(${target} STATIC ${sources})
    clothlab_own(${target})
endfunction()

# What most sources include takes half of the time to compile many a one. From precompiled headers GCC 12 gives warnings of
# the standard library's own strings, which are wrong; the sanitizers' builds, which compile in batches, keep them on.
function(clothlab_precompile target) # HEADER...
    if(NOT CLOTHLAB_SANITIZE)
        target_precompile_headers(${target} PRIVATE
            <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <optional> <span>
            <stdexcept> <string> <thread> <utility> <variant> <vector> ${ARGN})
        target_compile_options(${target} PRIVATE
            "$<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>")
    endif()
endfunction()

# Where there is no arithmetic with pointers these checks take up to half the time to compile and find little: a null
# pointer ends in a signal anyway, and what others point to is checked.
function(clothlab_fewer_checks target)
    if(CLOTHLAB_SANITIZE MATCHES address)
        target_compile_options(${target} PRIVATE -fno-sanitize=null,alignment,pointer-overflow,object-size)
    endif()
endfunction()

# Leaves out the tests without a test case that the thread sanitizer's build runs.
function(clothlab_only_threads list)
    set(used)
    foreach(source IN LISTS ${list})
        file(STRINGS ${source} tagged REGEX "\\[threads\\]" LIMIT_COUNT 1)
        if(tagged OR NOT source MATCHES "_test\\.cpp$")
            list(APPEND used ${source})
        endif()
    endforeach()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${${list}})
    set(${list} ${used} PARENT_SCOPE)
endfunction()

function(clothlab_executable target) # PATTERN...
    clothlab_glob(sources ${ARGN})
    if(CLOTHLAB_SANITIZE MATCHES thread)
        clothlab_only_threads(sources)
    endif()
    if(CLOTHLAB_GUI AND CLOTHLAB_SANITIZE MATCHES address)
        list(APPEND sources ${CMAKE_SOURCE_DIR}/cmake/keep_libraries_loaded.cpp)
    endif()
    add_executable(${target} ${sources})
    clothlab_own(${target})
endfunction()

# A test binary: one ctest entry per Catch2 test case, found when ctest runs.
function(clothlab_tests target) # PATTERN... [PRECOMPILE HEADER...]
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PRECOMPILE")
    clothlab_executable(${target} ${arg_UNPARSED_ARGUMENTS})
    target_link_libraries(${target} PRIVATE Catch2::Catch2WithMain clothlab_exact_float clothlab_data_dir)
    target_compile_definitions(${target} PRIVATE CLOTHLAB_TEST_BINARY="$<TARGET_FILE:clothlab>")
    target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
    add_dependencies(${target} clothlab) # some tests run it
    clothlab_fewer_checks(${target})
    if(CLOTHLAB_SANITIZE MATCHES address)
        target_compile_options(${target} PRIVATE -fno-sanitize-address-use-after-scope)
    endif()
    # Their time goes into clothlab's code, which is optimised, and they are compiled as often as they are run.
    if(CLOTHLAB_SANITIZE)
        target_compile_options(${target} PRIVATE -O0)
    else()
        target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
    # What nearly every test includes takes a second of each one's time to compile.
    target_precompile_headers(${target} PRIVATE
        <catch2/catch_test_macros.hpp> <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional>
        <limits> <map> <memory> <mutex> <numbers> <optional> <set> <span> <sstream> <string> <thread> <utility> <variant>
        <vector> ${arg_PRECOMPILE})
    # Two tags of test cases are labels of ctest, too: some builds run nothing else.
    foreach(labels IN ITEMS "threads program" threads program "")
        set(tests)
        foreach(tag IN ITEMS threads program)
            if(NOT labels MATCHES ${tag})
                string(APPEND tests ~)
            endif()
            string(APPEND tests [${tag}])
        endforeach()
        set(properties TIMEOUT 300)
        if(labels)
            list(APPEND properties LABELS ${labels})
        endif()
        catch_discover_tests(${target} DISCOVERY_MODE PRE_TEST TEST_SPEC ${tests} PROPERTIES ${properties})
    endforeach()
endfunction()
