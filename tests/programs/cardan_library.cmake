# The same by the command and by the library: tests/regression/test_library_and_command.cpp.
# add_library_test(<name> <test case> <command> <options>...): the file of the command, example_library_<name>.h5, beside the
# library's numbers.
function(add_library_test name case)
    set(out example_library_${name})
    add_example_test(${out} cardan 0 "files" ${ARGN} --blade-elements 2 --tower-elements 1 --out ${out})
    add_test(NAME ${out}_beside COMMAND test_regression "cardan ${case}: the file of the command*"
             WORKING_DIRECTORY ${test_output_dir})
    set_tests_properties(${out} PROPERTIES FIXTURES_SETUP ${out})
    set_tests_properties(${out}_beside PROPERTIES FIXTURES_REQUIRED ${out})
endfunction()
add_library_test(simulate simulate simulate nrel5mw --wind 12 --controller baseline --duration 1 --step 0.05)
add_library_test(campbell campbell campbell nrel5mw)
add_library_test(campbell_wind "campbell in the wind" campbell nrel5mw --wind 8,12 --max-frequency 3)
add_library_test(linearise linearise linearise nrel5mw --wind 15 --max-frequency 3 --azimuths 8 --wake equilibrium
                 --airfoils steady)
