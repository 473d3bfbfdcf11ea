set(one_element --blade-elements 1 --tower-elements 1)
add_example_test(example_teetered teetered_campbell 0
    "yaw .rigid.*teeter .locked at 1 per rev and growing.*1st blade flap .antisymmetric.*stability margin.*unstable at.*files: example_teetered.h5.*mode shapes"
    ${one_element} --rpm 40:60:10 --modes --out example_teetered)
add_example_test(example_teetered_gravity teetered_campbell 0 "2nd blade flap .symmetric.*files: example_teetered_gravity.h5" --gravity --rigid-tower
    --no-teeter --max-per-rev 25 --blade-elements 2 --rpm 57.5 --out example_teetered_gravity)
add_example_test(example_teetered_help teetered_campbell 0 "--tower-ratio" --help)
add_example_test(example_teetered_unknown_option teetered_campbell 2 "--nonsense" --nonsense)
add_example_test(example_teetered_rpm teetered_campbell 1 "--rpm: value = 0:x:1; allowed: numbers and FIRST:LAST:STEP" --rpm 0:x:1)
add_example_test(example_teetered_negative_rpm teetered_campbell 1 ">= 0, FIRST <= LAST" --rpm=-10:10:5 ${one_element})
add_example_test(example_teetered_ratio teetered_campbell 1 "ratio of tower to blade rigidity = -2; allowed: finite and > 0" --tower-ratio=-2)
add_example_test(example_teetered_excludes teetered_campbell 2 "excludes" --rigid-tower --tower-ratio 10)
add_example_test(example_teetered_limits teetered_campbell 2 "excludes" --max-per-rev 3 --max-frequency 10)
add_example_test(example_teetered_elements teetered_campbell 1 "number of elements = 0" --blade-elements 0)
add_example_test(example_teetered_many_elements teetered_campbell 1
    "number of unknowns = 4502; allowed: <= 1500 .all eigenvalues of a full matrix.*take fewer elements per part"
    --blade-elements 300 --tower-elements 300)
add_example_test(example_teetered_harmonics teetered_campbell 1 "number of harmonics = -1" --harmonics=-1 --rpm 50 ${one_element})
add_example_test(example_teetered_frequency teetered_campbell 1 "largest frequency .* = -1; allowed: > 0" --max-frequency=-1 --rpm 50 ${one_element})
add_example_test(example_teetered_no_data teetered_campbell 1 "no_such_folder/teetered.csv: cannot be read" --data no_such_folder)
add_example_test(example_teetered_unwritable teetered_campbell 1 "the folder 'no/such' does not exist" --out no/such/x)
# Ctrl-C: exit code 130, and what was computed is there.
add_test(NAME example_teetered_interrupted
         COMMAND ${CMAKE_COMMAND} -D PROGRAM=timeout
                 "-DARGUMENTS=--preserve-status;--signal=INT;1.5;$<TARGET_FILE:teetered_campbell>;--blade-elements;1;--tower-elements;1;--rpm;20:100:0.01;--out;example_teetered_interrupted"
                 -D CODE=130 "-DSAYS=the sweep was interrupted.*files: example_teetered_interrupted.h5" -P
                 ${CMAKE_CURRENT_SOURCE_DIR}/run_program.cmake
         WORKING_DIRECTORY ${test_output_dir})
