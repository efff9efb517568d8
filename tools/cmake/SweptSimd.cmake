# Wide kernels by Highway. Included by the top-level list file only.

if(SWEPT_SIMD)
    find_package(hwy QUIET)
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
        target_link_libraries(${target} PRIVATE hwy::hwy)
    endforeach()
    set_property(GLOBAL APPEND PROPERTY SWEPT_FOREIGN_PACKAGES hwy)
endfunction()
