# Builds a small project that uses the library, and runs it.
#   SOURCE_DIR, WORK_DIR      the project, and where it is built (cleared first)
#   GENERATOR, COMPILER, LAUNCHER, FLAGS   as in the tree under test
#   PREFIX, SWEPT_ROOT        where the package and the sources are
#   CONSUME, PRECISION, ONLY_LAYERS, MISMATCH, MAIN, COMPONENTS   handed on; see consumer/CMakeLists.txt
#   SWEPT_SIMD                where it is built from sources, with all else that makes that fast
#   PAGE                      a markdown file whose first C++ block is the program
#   MISMATCH                  the link must fail, for want of names of the other precision
file(REMOVE_RECURSE ${WORK_DIR})

if(PAGE)
    file(READ ${PAGE} page)
    string(FIND "${page}" "```cpp\n" begin)
    if(begin EQUAL -1)
        message(FATAL_ERROR "${PAGE} has no C++ block")
    endif()
    math(EXPR begin "${begin} + 7")
    string(SUBSTRING "${page}" ${begin} -1 page)
    string(FIND "${page}" "```" end)
    string(SUBSTRING "${page}" 0 ${end} program)
    set(MAIN ${WORK_DIR}/example.cpp)
    file(WRITE ${MAIN} "${program}")
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR} -G ${GENERATOR}
                        -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
                        "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_BUILD_TYPE=None -DCMAKE_PREFIX_PATH=${PREFIX}
                        -DSWEPT_ROOT=${SWEPT_ROOT} -DCONSUME=${CONSUME} -DPRECISION=${PRECISION}
                        -DONLY_LAYERS=${ONLY_LAYERS} -DMISMATCH=${MISMATCH} -DMAIN=${MAIN}
                        -DCOMPONENTS=${COMPONENTS} -DSWEPT_SIMD=${SWEPT_SIMD}
                        -DSWEPT_SIMD_FEW=ON -DSWEPT_UNITY=ON
                OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "configuring the project failed:\n${output}")
endif()

execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR} --target consumer
                OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
if(MISMATCH)
    if(result EQUAL 0)
        message(FATAL_ERROR "a program of one precision was linked with a library of the other")
    elseif(NOT output MATCHES "undefined (reference|symbol)[^\n]*swept::f(32|64)::")
        message(FATAL_ERROR "the build failed, but not for want of names of the other precision:\n${output}")
    endif()
    return()
endif()
if(NOT result EQUAL 0)
    message(FATAL_ERROR "building the project failed:\n${output}")
endif()

execute_process(COMMAND ${WORK_DIR}/consumer OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "the program ended with ${result}:\n${output}")
endif()
message(STATUS "${output}")
