# Wide kernels by Highway. Included by the top-level list file only.

if(SWEPT_SIMD)
    set(SWEPT_HIGHWAY hwy::hwy)
    if(TARGET hwy::hwy)
        # of the project that this one is part of
    elseif(SWEPT_WASM OR (CMAKE_CROSSCOMPILING AND (CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64 OR (MINGW AND SWEPT_BUILD_TESTS))))
        # Headers are all that is needed of Highway where one instruction set is of use, so that nothing is chosen at run time;
        # tests for Windows choose by what stands beside them. Those of this machine do, seen through a link so that nothing
        # else beside them is.
        find_path(SWEPT_HIGHWAY_HEADERS hwy/highway.h PATHS /usr/local/include /usr/include NO_CMAKE_FIND_ROOT_PATH)
        if(SWEPT_HIGHWAY_HEADERS)
            file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/highway)
            swept_link_folder(${SWEPT_HIGHWAY_HEADERS}/hwy ${PROJECT_BINARY_DIR}/highway/hwy)
            add_library(hwy::hwy INTERFACE IMPORTED GLOBAL)
            target_include_directories(hwy::hwy INTERFACE ${PROJECT_BINARY_DIR}/highway)
            if(NOT MINGW)  # Highway from 1.0.4 on knows NEON of several kinds, and would ask its library which one there is.
                target_compile_definitions(hwy::hwy INTERFACE HWY_COMPILE_ONLY_STATIC)
            endif()
            set(SWEPT_HIGHWAY $<BUILD_INTERFACE:hwy::hwy>)  # nothing for who links what is installed
        endif()
    else()
        find_package(hwy QUIET)
    endif()
    if(NOT TARGET hwy::hwy)
        message(STATUS "Swept2D: Highway (libhwy-dev) is not there, so kernels are scalar")
        set(SWEPT_SIMD OFF)
    endif()
endif()

# swept_add_wide_kernels(LAYER SOURCES file...)
# Sources that Highway compiles once for each instruction set: its foreach_target.h reads the file again by its name, hence
# the include path. Without Highway the layer is left as it is; with it, SWEPT_SIMD is defined while it is compiled.
function(swept_add_wide_kernels layer)
    if(NOT SWEPT_SIMD)
        return()
    endif()
    cmake_parse_arguments(KERNELS "" "" "SOURCES" ${ARGN})
    swept_compile_alone(${KERNELS_SOURCES})
    foreach(precision f32 f64)
        set(target swept_${layer}_${precision})
        target_sources(${target} PRIVATE ${KERNELS_SOURCES})
        target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
        target_compile_definitions(${target} PRIVATE SWEPT_SIMD $<$<BOOL:${SWEPT_SIMD_FEW}>:SWEPT_SIMD_FEW>)
        target_link_libraries(${target} PRIVATE ${SWEPT_HIGHWAY})
    endforeach()
    if(SWEPT_HIGHWAY STREQUAL hwy::hwy)
        set_property(GLOBAL APPEND PROPERTY SWEPT_FOREIGN_PACKAGES hwy)
    endif()
endfunction()
