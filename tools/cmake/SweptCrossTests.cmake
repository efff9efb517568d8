# GoogleTest for a machine that is not this one, from the sources that its package has. Included by tests/CMakeLists.txt only.
find_path(SWEPT_GTEST_SOURCES src/gtest-all.cc PATHS /usr/src/googletest/googletest NO_CMAKE_FIND_ROOT_PATH REQUIRED)
add_library(swept_gtest STATIC ${SWEPT_GTEST_SOURCES}/src/gtest-all.cc)
add_library(swept_gtest_main STATIC ${SWEPT_GTEST_SOURCES}/src/gtest_main.cc)
target_include_directories(swept_gtest SYSTEM PUBLIC ${SWEPT_GTEST_SOURCES}/include PRIVATE ${SWEPT_GTEST_SOURCES})
target_compile_features(swept_gtest PUBLIC cxx_std_20)
if(SWEPT_WASM)
    # Programs there cannot fork, and have one thread.
    target_compile_definitions(swept_gtest PUBLIC GTEST_HAS_PTHREAD=0 GTEST_HAS_EXCEPTIONS=0 GTEST_HAS_DEATH_TEST=0
                                                  GTEST_HAS_STREAM_REDIRECTION=0)
endif()
target_link_libraries(swept_gtest_main PUBLIC swept_gtest)
if(SWEPT_SIMD)
    # What is asked of Highway's library, of which the headers alone are here.
    target_sources(swept_gtest PRIVATE ${PROJECT_SOURCE_DIR}/tests/portability/targets.cpp)
    target_link_libraries(swept_gtest PRIVATE hwy::hwy)
endif()
add_library(GTest::gtest ALIAS swept_gtest)
add_library(GTest::gtest_main ALIAS swept_gtest_main)
