# How a test suite becomes its executables. Included by tests/CMakeLists.txt only.
include(GoogleTest)

# To start 2300 processes, and to ask each executable for its tests, takes three tenths of the time of all of them.
option(SWEPT_TESTS_APART "ctest knows every test by itself, not only executables" ON)

# All suites with one label, to be built without the rest.
foreach(label quick quick_long parallel parallel_long)
    add_custom_target(swept_tests_${label})
endforeach()

# Reading gtest is half of what a small suite takes to compile, so it is read once for all of them; and once more for those
# that read JSON, or work hard, where they are compiled file by file. The targets have the suites' compiler options and nothing of their own to
# compile. OPTIONS as of swept_configure_test.
function(swept_add_test_prelude name)
    cmake_parse_arguments(PRELUDE "" "" "OPTIONS" ${ARGN})
    swept_add_prelude(${name} <gtest/gtest.h> <algorithm> <array> <cmath> <limits> <map> <random> <set> <sstream> <string>
                      <vector> ${PRELUDE_UNPARSED_ARGUMENTS})
    swept_configure_test(${name} ${PRELUDE_OPTIONS})
    target_compile_options(${name} PRIVATE ${SWEPT_NO_FUSING})
    target_link_libraries(${name} PRIVATE GTest::gtest)
endfunction()

# swept_configure_test(TARGET [HAS_ORACLE]): what all test executables are compiled with.
function(swept_configure_test target)
    swept_warnings(${target})
    # What is tested is optimised fully; the tests themselves take longer to be optimised than to run, but for oracles that
    # work hard, and where an emulator runs them. (`None`, the configuration of the presets with sanitizers, has -O1.)
    if("HAS_ORACLE" IN_LIST ARGN OR CMAKE_CROSSCOMPILING)
        target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    else()
        target_compile_options(${target} PRIVATE $<$<CONFIG:Release,None>:-O0>)
    endif()
endfunction()

# swept_add_test(NAME [READS_JSON] [HAS_ORACLE] SOURCES file... LIBRARIES target... [LABELS label...])
# One executable. HAS_ORACLE: most of its time it computes what it compares with. Labels: quick (also run with
# sanitizers), quick_long (the same in the long run only), parallel (also run with thread sanitizer), parallel_long (the
# same in the long run only), long (in the long run only).
function(swept_add_test name)
    cmake_parse_arguments(TEST "READS_JSON;HAS_ORACLE" "" "SOURCES;LIBRARIES;LABELS" ${ARGN})
    add_executable(${name} ${TEST_SOURCES})
    set(options "")
    set(prelude swept_test_prelude)
    if(TEST_READS_JSON)
        if(TARGET swept_test_json_prelude)
            set(prelude swept_test_json_prelude)
        endif()
        target_link_libraries(${name} PRIVATE nlohmann_json::nlohmann_json)
    endif()
    if(TEST_HAS_ORACLE AND NOT CMAKE_CROSSCOMPILING)  # there all are compiled like these
        set(prelude swept_test_oracle_prelude)
        set(options HAS_ORACLE)
    endif()
    swept_configure_test(${name} ${options})
    swept_share_prelude(${name} ${prelude})
    swept_unite(${name})
    target_link_libraries(${name} PRIVATE ${TEST_LIBRARIES} GTest::gtest_main)
    foreach(label IN LISTS TEST_LABELS)
        if(TARGET swept_tests_${label})
            add_dependencies(swept_tests_${label} ${name})
        endif()
    endforeach()
    if("long" IN_LIST TEST_LABELS AND NOT SWEPT_LONG_TESTS)
        set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
        return()
    endif()
    if(CMAKE_CROSSCOMPILING OR CMAKE_BUILD_TYPE STREQUAL None OR NOT SWEPT_TESTS_APART)
        # One process for all: an emulator, or a sanitizer, takes longer to start than most tests to run.
        add_test(NAME ${name} COMMAND ${name})
        set_tests_properties(${name} PROPERTIES LABELS "${TEST_LABELS}" ENVIRONMENT GTEST_BRIEF=1)
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

# swept_add_layer_test(NAME [HAS_ORACLE] [SHORT_IN_BOTH] SOURCES file... [LAYERS layer...] [LIBRARIES target...] [LABELS label...])
# The same suite for both precisions: NAME_f32 and NAME_f64, linked to swept_LAYER_f32 and swept_LAYER_f64. In f64 it is of
# the long run, for sanitizers (quick_long, parallel_long) as for all, since few changes break only one precision.
# SHORT_IN_BOTH: but this one is not, as rounding decides there, or as it runs whole scenes.
function(swept_add_layer_test name)
    cmake_parse_arguments(TEST "HAS_ORACLE;SHORT_IN_BOTH" "" "SOURCES;LAYERS;LIBRARIES;LABELS" ${ARGN})
    set(options "")
    if(TEST_HAS_ORACLE)
        set(options HAS_ORACLE)
    endif()
    foreach(precision f32 f64)
        set(libraries ${TEST_LIBRARIES})
        foreach(layer IN LISTS TEST_LAYERS)
            list(APPEND libraries swept_${layer}_${precision})
        endforeach()
        set(labels ${TEST_LABELS})
        if(precision STREQUAL f64)
            list(TRANSFORM labels REPLACE "^(quick|parallel)$" "\\1_long")
            if(NOT TEST_SHORT_IN_BOTH)
                list(APPEND labels long)
            endif()
        endif()
        swept_add_test(${name}_${precision} ${options} SOURCES ${TEST_SOURCES} LIBRARIES ${libraries} LABELS ${labels})
    endforeach()
endfunction()

# swept_test_wide_kernels(NAME): a suite of both precisions that tries the wide kernels of each instruction set by itself.
function(swept_test_wide_kernels name)
    if(NOT SWEPT_SIMD)
        return()
    endif()
    foreach(precision f32 f64)
        target_compile_definitions(${name}_${precision} PRIVATE SWEPT_SIMD $<$<BOOL:${SWEPT_SIMD_FEW}>:SWEPT_SIMD_FEW>)
        target_link_libraries(${name}_${precision} PRIVATE hwy::hwy)
    endforeach()
endfunction()
