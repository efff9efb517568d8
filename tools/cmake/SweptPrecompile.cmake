# The standard headers, read once for each of our larger targets: they are most of what a file of ours takes to compile.
# Included by the top-level list file only.
#
# Off where the project is part of another. That a file includes the headers of what it uses, precompiled or not, is for
# tests/house.
option(SWEPT_PRECOMPILE "Precompile the standard headers" ${PROJECT_IS_TOP_LEVEL})

# swept_precompile(TARGET HEADER...): these headers and the common ones of the standard library.
function(swept_precompile target)
    if(NOT SWEPT_PRECOMPILE)
        return()
    endif()
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <functional> <limits> <memory> <optional> <span>
                                                <string> <vector> ${ARGN})
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
    endif()
endfunction()
