# Builds a small project that uses the library, and runs it.
#   SOURCE_DIR, WORK_DIR      the project, and where it is built (cleared first)
#   GENERATOR, COMPILER, LAUNCHER, FLAGS   as in the tree under test
#   PREFIX, SWEPT_ROOT        where the package and the sources are
#   CONSUME, PRECISION, ONLY_LAYERS, MISMATCH, MAIN, COMPONENTS   handed on; see consumer/CMakeLists.txt
#   SWEPT_SIMD                where it is built from sources, with all else that makes that fast
#   PAGE                      a markdown file: each of its C++ blocks is a program, which must print what its comments
#                             `// prints: ...` say, if it has any
#   PRECOMPILED               a header that each program of the page includes, read once for all
#   MISMATCH                  the link must fail, for want of names of the other precision
file(REMOVE_RECURSE ${WORK_DIR})

# split_off(TEXT BEGIN END RESULT): what stands between the first BEGIN of a text and the END after it goes to RESULT, and
# TEXT keeps what follows; RESULT is NOTFOUND where there is no BEGIN. (Lists would trip over semicolons and brackets.)
function(split_off text begin end result)
    string(FIND "${${text}}" "${begin}" at)
    if(at EQUAL -1)
        set(${result} NOTFOUND PARENT_SCOPE)
        return()
    endif()
    string(LENGTH "${begin}" length)
    math(EXPR at "${at} + ${length}")
    string(SUBSTRING "${${text}}" ${at} -1 rest)
    string(FIND "${rest}" "${end}" at)
    string(SUBSTRING "${rest}" 0 ${at} inside)
    string(SUBSTRING "${rest}" ${at} -1 rest)
    set(${result} "${inside}" PARENT_SCOPE)
    set(${text} "${rest}" PARENT_SCOPE)
endfunction()

set(programs consumer)
if(PAGE)
    set(MAIN "")
    set(programs "")
    file(READ ${PAGE} page)
    split_off(page "```cpp\n" "```" program)
    while(NOT program STREQUAL NOTFOUND)
        list(LENGTH MAIN count)
        set(name consumer)
        if(count GREATER 0)
            set(name consumer_${count})
        endif()
        file(WRITE ${WORK_DIR}/${name}.cpp "${program}")
        if(PRECOMPILED AND NOT program MATCHES "#include ${PRECOMPILED}\n")
            message(FATAL_ERROR "a program of ${PAGE} does not include ${PRECOMPILED}:\n${program}")
        endif()
        list(APPEND MAIN ${WORK_DIR}/${name}.cpp)
        list(APPEND programs ${name})
        set(prints_${name} "")
        split_off(program "// prints: " "\n" line)
        while(NOT line STREQUAL NOTFOUND)
            string(APPEND prints_${name} "${line}\n")
            split_off(program "// prints: " "\n" line)
        endwhile()
        split_off(page "```cpp\n" "```" program)
    endwhile()
    if(NOT MAIN)
        message(FATAL_ERROR "${PAGE} has no C++ block")
    endif()
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR} -G ${GENERATOR}
                        -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
                        "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_BUILD_TYPE=None -DCMAKE_PREFIX_PATH=${PREFIX}
                        -DSWEPT_ROOT=${SWEPT_ROOT} -DCONSUME=${CONSUME} -DPRECISION=${PRECISION}
                        -DONLY_LAYERS=${ONLY_LAYERS} -DMISMATCH=${MISMATCH} "-DMAIN=${MAIN}"
                        -DCOMPONENTS=${COMPONENTS} -DSWEPT_SIMD=${SWEPT_SIMD}
                        -DSWEPT_SIMD_FEW=ON -DSWEPT_UNITY=ON -DSWEPT_PRECOMPILE=ON
                        "-DPRECOMPILED=${PRECOMPILED}"
                OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "configuring the project failed:\n${output}")
endif()

execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR} --target programs
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

foreach(name IN LISTS programs)
    execute_process(COMMAND ${WORK_DIR}/${name} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "the program ${name} ended with ${result}:\n${output}")
    endif()
    if(prints_${name} AND NOT output STREQUAL prints_${name})
        message(FATAL_ERROR "the program ${name} should print\n${prints_${name}}and prints\n${output}")
    endif()
    message(STATUS "${output}")
endforeach()
