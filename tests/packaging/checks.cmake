# Functions shared by the packaging tests.

# Runs a command that must succeed. Its output is in `output` and `errors`.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        string(JOIN " " command ${ARGN})
        message(FATAL_ERROR "${command}\nended with ${status}\n${output}\n${errors}")
    endif()
    set(output "${output}" PARENT_SCOPE)
    set(errors "${errors}" PARENT_SCOPE)
endfunction()

# Runs a command that must fail.
function(run_failing)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(status EQUAL 0)
        string(JOIN " " command ${ARGN})
        message(FATAL_ERROR "${command}\nshould have failed\n${output}\n${errors}")
    endif()
    string(REGEX REPLACE "[ \n]+" " " errors "${errors}")
    set(errors "${errors}" PARENT_SCOPE)
endfunction()

function(expect text)
    foreach(part ${ARGN})
        string(FIND "${text}" "${part}" at)
        if(at EQUAL -1)
            message(FATAL_ERROR "\"${part}\" is not in\n${text}")
        endif()
    endforeach()
endfunction()
