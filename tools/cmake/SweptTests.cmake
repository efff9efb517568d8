# How a test suite becomes its executables. Included by tests/CMakeLists.txt only.
include(GoogleTest)

# All suites with one label, to be built without the rest.
foreach(label quick quick_long parallel parallel_long)
    add_custom_target(swept_tests_${label})
endforeach()

# Reading gtest is half of what a small suite takes to compile, so it is read once for all of them, and once more for those
# that read JSON. The targets have the suites' compiler options and nothing of their own to compile.
function(swept_add_test_prelude name)
    set(nothing ${CMAKE_CURRENT_BINARY_DIR}/prelude.cpp)
    file(CONFIGURE OUTPUT ${nothing} CONTENT "// Compiled for its precompiled header only.\n")
    add_library(${name} OBJECT ${nothing})
    swept_configure_test(${name})
    target_compile_features(${name} PUBLIC cxx_std_20)
    target_compile_options(${name} PRIVATE -ffp-contract=off)
    target_link_libraries(${name} PRIVATE GTest::gtest)
    target_precompile_headers(${name} PRIVATE <gtest/gtest.h> <algorithm> <array> <cmath> <limits> <map> <random> <set>
                                              <sstream> <string> <vector> ${ARGN})
endfunction()

# What all test executables are compiled with.
function(swept_configure_test target)
    swept_warnings(${target})
    # What is tested is optimised fully; the tests themselves take longer to compile so than to run.
    # Not less with sanitizers: the oracles of the tests would take longer to run than is saved.
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
    endif()
endfunction()

# swept_add_test(NAME [READS_JSON] SOURCES file... LIBRARIES target... [LABELS label...])
# One executable, discovered by ctest. Labels: quick (also run with sanitizers), quick_long (the same in the long run only),
# parallel (also run with thread sanitizer), parallel_long (the same in the long run only), long (in the long run only).
function(swept_add_test name)
    cmake_parse_arguments(TEST "READS_JSON" "" "SOURCES;LIBRARIES;LABELS" ${ARGN})
    add_executable(${name} ${TEST_SOURCES})
    swept_configure_test(${name})
    swept_unite(${name})
    target_link_libraries(${name} PRIVATE ${TEST_LIBRARIES} GTest::gtest_main)
    if(TEST_READS_JSON)
        target_precompile_headers(${name} REUSE_FROM swept_test_json_prelude)
        target_link_libraries(${name} PRIVATE nlohmann_json::nlohmann_json)
    else()
        target_precompile_headers(${name} REUSE_FROM swept_test_prelude)
    endif()
    foreach(label IN LISTS TEST_LABELS)
        if(TARGET swept_tests_${label})
            add_dependencies(swept_tests_${label} ${name})
        endif()
    endforeach()
    if(CMAKE_CROSSCOMPILING)  # an emulator takes longer to start than most tests to run
        add_test(NAME ${name} COMMAND ${name})
        return()
    endif()
    gtest_discover_tests(${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60)
    # PROPERTIES of the line above would take a list of labels apart, so they are set where ctest reads its files.
    set(labels_file ${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake)
    file(CONFIGURE OUTPUT ${labels_file} CONTENT [[
foreach(test IN LISTS @name@_TESTS)
    set_tests_properties(${test} PROPERTIES LABELS "@TEST_LABELS@")
endforeach()
]] @ONLY)
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${labels_file})
endfunction()

# swept_add_layer_test(NAME SOURCES file... [LAYERS layer...] [LIBRARIES target...] [LABELS label...])
# The same suite for both precisions: NAME_f32 and NAME_f64, linked to swept_LAYER_f32 and swept_LAYER_f64. What is
# quick or parallel in f32 is labelled quick_long or parallel_long in f64: sanitizers see the same sources twice only in the
# long run.
function(swept_add_layer_test name)
    cmake_parse_arguments(TEST "" "" "SOURCES;LAYERS;LIBRARIES;LABELS" ${ARGN})
    foreach(precision f32 f64)
        set(libraries ${TEST_LIBRARIES})
        foreach(layer IN LISTS TEST_LAYERS)
            list(APPEND libraries swept_${layer}_${precision})
        endforeach()
        set(labels ${TEST_LABELS})
        if(precision STREQUAL f64)
            list(TRANSFORM labels REPLACE "^(quick|parallel)$" "\\1_long")
        endif()
        swept_add_test(${name}_${precision} SOURCES ${TEST_SOURCES} LIBRARIES ${libraries} LABELS ${labels})
    endforeach()
endfunction()
