# cmake -D PROGRAM=... -D ARGUMENTS=a;b;c -D CODE=0|1|2 -D SAYS=regex -P run_program.cmake
# Runs a program as a user does: its exit code and what it says must both be as expected.
execute_process(COMMAND ${PROGRAM} ${ARGUMENTS} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
if(NOT code EQUAL CODE)
    message(FATAL_ERROR "exit code ${code}, expected ${CODE}\n${out}${err}")
endif()
if(NOT "${out}${err}" MATCHES "${SAYS}")
    message(FATAL_ERROR "said:\n${out}${err}\nexpected: ${SAYS}")
endif()
