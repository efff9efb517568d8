# Builds a small project that uses the library, and runs it.
#   SOURCE_DIR, WORK_DIR      the project, and where it is built (cleared first)
#   GENERATOR, COMPILER, LAUNCHER, FLAGS   as in the tree under test
#   PREFIX, SWEPT_ROOT        where the package and the sources are
#   CONSUME, PRECISION, ONLY_LAYERS, MISMATCH, MAIN, COMPONENTS   handed on; see consumer/CMakeLists.txt
#   SWEPT_SIMD                where it is built from sources, with all else that makes that fast
#   PAGE                      a markdown file: each of its C++ blocks is a program, which must print what its comments
#                             `// prints: ...` say, if it has any
#   TOGETHER                  all programs of the page as one, which is given their number: less than half of the work
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

# add_together(PROGRAM NUMBER): into a namespace of its own, with its headers before all else. Only main functions may end
# without a value.
set(together_headers "#include <cstdlib>\n")
set(together "")
set(together_calls "")
function(add_together program number)
    string(REGEX MATCHALL "#include [^\n]*\n" headers "${program}")
    string(REGEX REPLACE "#include [^\n]*\n" "" program "${program}")
    string(FIND "${program}" "int main() {\n" at)
    if(at EQUAL -1)
        message(FATAL_ERROR "program ${number} of ${PAGE} has no main function")
    endif()
    string(SUBSTRING "${program}" 0 ${at} before)
    split_off(program "int main() {\n" "\n}\n" main)
    string(APPEND together_headers ${headers})
    string(APPEND together "namespace program_${number} {\n${before}int run() {\n${main}\n    return 0;${program}}\n")
    string(APPEND together_calls "        case ${number}: return program_${number}::run();\n")
    foreach(text together_headers together together_calls)
        set(${text} "${${text}}" PARENT_SCOPE)
    endforeach()
endfunction()

set(programs consumer)
if(PAGE)
    set(MAIN "")
    set(programs "")
    file(READ ${PAGE} page)
    split_off(page "```cpp\n" "```" program)
    while(NOT program STREQUAL NOTFOUND)
        list(LENGTH programs count)
        set(name consumer)
        if(count GREATER 0)
            set(name consumer_${count})
        endif()
        if(TOGETHER)
            add_together("${program}" ${count})
        else()
            file(WRITE ${WORK_DIR}/${name}.cpp "${program}")
            list(APPEND MAIN ${WORK_DIR}/${name}.cpp)
        endif()
        list(APPEND programs ${name})
        set(prints_${name} "")
        split_off(program "// prints: " "\n" line)
        while(NOT line STREQUAL NOTFOUND)
            string(APPEND prints_${name} "${line}\n")
            split_off(program "// prints: " "\n" line)
        endwhile()
        split_off(page "```cpp\n" "```" program)
    endwhile()
    if(NOT programs)
        message(FATAL_ERROR "${PAGE} has no C++ block")
    endif()
    if(TOGETHER)
        file(WRITE ${WORK_DIR}/consumer.cpp "${together_headers}${together}int main(int, char** arguments) {
    switch (std::atoi(arguments[1])) {
${together_calls}    }
    return 1;
}
")
        set(MAIN ${WORK_DIR}/consumer.cpp)
    endif()
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR} -G ${GENERATOR}
                        -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
                        "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_BUILD_TYPE=None -DCMAKE_PREFIX_PATH=${PREFIX}
                        -DSWEPT_ROOT=${SWEPT_ROOT} -DCONSUME=${CONSUME} -DPRECISION=${PRECISION}
                        -DONLY_LAYERS=${ONLY_LAYERS} -DMISMATCH=${MISMATCH} "-DMAIN=${MAIN}"
                        -DCOMPONENTS=${COMPONENTS} -DSWEPT_SIMD=${SWEPT_SIMD}
                        -DSWEPT_SIMD_FEW=ON -DSWEPT_UNITY=ON -DSWEPT_PRECOMPILE=OFF
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

set(number 0)
foreach(name IN LISTS programs)
    set(command ${WORK_DIR}/${name})
    if(TOGETHER)
        set(command ${WORK_DIR}/consumer ${number})
    endif()
    math(EXPR number "${number} + 1")
    execute_process(COMMAND ${command} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "the program ${name} ended with ${result}:\n${output}")
    endif()
    if(prints_${name} AND NOT output STREQUAL prints_${name})
        message(FATAL_ERROR "the program ${name} should print\n${prints_${name}}and prints\n${output}")
    endif()
    message(STATUS "${output}")
endforeach()
