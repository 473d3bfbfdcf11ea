# Histories; two tests of test_solvers leave a finished one and one whose writer was killed in a flush.
add_test(NAME example_history_files COMMAND test_solvers "history: files for the program history"
         WORKING_DIRECTORY ${test_output_dir})
set_tests_properties(example_history_files PROPERTIES FIXTURES_SETUP histories)
add_example_test(example_history_info cardan 0 "history 'chain', finished.*BDF.*rows +301, 0 [.][.][.] 3 s.*hinge 1 rate"
                 info history_finished.h5)
add_example_test(example_history_description cardan 0 "input description:.*three pendulums" info history_finished.h5
                 --description)
add_example_test(example_history_export cardan 0 "history[.]csv: 101 rows of 2 channels" convert history_finished.h5
                 history.csv --channel "hinge 2" --channel "kinetic energy" --to 1)
add_example_test(example_history_broken cardan 0 "broken off.*repair +needed" info history_broken.h5)
add_example_test(example_history_repair cardan 0 "broken off, was completed; 16 rows" repair history_broken.h5)
add_example_test(example_history_repaired cardan 0 "in order, nothing was changed" repair history_finished.h5)
set_tests_properties(example_history_repair PROPERTIES DEPENDS example_history_broken)
add_example_test(example_history_help cardan 0 "campbell" --help)
add_example_test(example_history_no_command cardan 2 "cardan info MODEL " "")
add_example_test(example_history_unknown_option cardan 2 "--nonsense" info history_finished.h5 --nonsense)
add_example_test(example_history_no_file cardan 1 "no/such.h5: cannot be opened: No such file" info no/such.h5)
add_example_test(example_history_no_history cardan 1 "cannot be opened as an HDF5 file" repair ${CMAKE_CURRENT_LIST_FILE})
add_example_test(example_history_channel cardan 1 "'hinge 9'; allowed: one of 'hinge 1'" convert history_finished.h5
                 history.csv --channel "hinge 9")
add_example_test(example_history_unwritable cardan 1 "the folder 'no/such' does not exist" convert history_finished.h5
                 no/such/x.csv)
set_tests_properties(
    example_history_info
    example_history_description
    example_history_export
    example_history_broken
    example_history_repair
    example_history_repaired
    example_history_help
    example_history_no_command
    example_history_unknown_option
    example_history_no_file
    example_history_no_history
    example_history_channel
    example_history_unwritable
    PROPERTIES FIXTURES_REQUIRED histories)
