add_example_test(example_platform nrel5mw_platform 0
              "energy lost.*ok.*reference case: pitch.*1 deg: reached.*files: example_platform.h5 .[0-9]+ samples of 117 channels., .svg, .png, _energy.png, _spectrum.png, .csv"
              --case pitch --elements 8 --tolerance 1e-6 --out example_platform)
add_example_test(example_platform_history cardan 0
              "pitch amplitude=5,revolutions=2', finished.*checkpoint +at.*kinetic energy.*blade 1 tip flap.*platform pitch drive"
              info example_platform.h5)
set_tests_properties(example_platform PROPERTIES FIXTURES_SETUP platform_history)
set_tests_properties(example_platform_history PROPERTIES FIXTURES_REQUIRED platform_history)
# Ctrl-C: exit code 130, and what was computed is there.
add_test(NAME example_platform_interrupted
         COMMAND ${CMAKE_COMMAND} -D PROGRAM=${CMAKE_CURRENT_SOURCE_DIR}/programs/interrupt.sh
                 "-DARGUMENTS=example_platform_interrupted.h5;$<TARGET_FILE:nrel5mw_platform>;--elements;64;--tolerance;1e-9;--out;example_platform_interrupted"
                 -D CODE=130 "-DSAYS=interrupted at .*files: example_platform_interrupted.h5" -P
                 ${CMAKE_CURRENT_SOURCE_DIR}/run_program.cmake
         WORKING_DIRECTORY ${test_output_dir})
add_example_test(example_platform_interrupted_history cardan 0 "broken off.*rows +[0-9]+, 0 .*checkpoint +at" info
              example_platform_interrupted.h5)
set_tests_properties(example_platform_interrupted PROPERTIES FIXTURES_SETUP platform_interrupted)
set_tests_properties(example_platform_interrupted_history PROPERTIES FIXTURES_REQUIRED platform_interrupted)
add_example_test(example_platform_heave nrel5mw_platform 0 "reference case: none.*reached" --heave velocity=1 --elements 8 --tolerance
                  1e-6 --out example_platform_heave)
add_example_test(example_platform_coarse nrel5mw_platform 3 "reference case: none.*MISSED" --elements 2 --tolerance 1e-6 --out
                  example_platform_coarse)
add_example_test(example_platform_all nrel5mw_platform 0 "3 blade.*periods of 29.752.*periodic.*A2 +.phase.\n" --blades 3 --elements 2 --settled
    1e-3 --harmonics 2 --method alpha --tolerance 1e-4 --surge mean=2,amplitude=1,revolutions=2,phase=30 --sway
    amplitude=1,revolutions=3 --heave amplitude=0.5,velocity=0.1,revolutions=1 --roll amplitude=2,revolutions=2 --yaw
    amplitude=1,revolutions=6 --nacelle-yaw mean=10 --blade-pitch 3 --out example_platform_all)
add_example_test(example_platform_at_rest nrel5mw_platform 0 "energy lost.*exchanged.*ok" --rpm 0 --surge amplitude=1,period=20
                 --elements 8 --damping 0.02 --out example_platform_at_rest)
add_example_test(example_platform_unsettled nrel5mw_platform 3 "NOT PERIODIC.*more --periods" --elements 1 --tolerance 1e-5 --periods
                  3 --out example_platform_unsettled)
add_example_test(example_platform_undamped nrel5mw_platform 3 "NOT PERIODIC.*some damping" --elements 1 --tolerance 1e-5 --damping 0
                  --out example_platform_undamped)
add_example_test(example_platform_help nrel5mw_platform 0 "--nacelle-yaw" --help)
add_example_test(example_platform_unknown_option nrel5mw_platform 2 "--nonsense" --nonsense)
add_example_test(example_platform_case_excludes nrel5mw_platform 2 "--case excludes --heave" --case pitch --heave velocity=1)
add_example_test(example_platform_key nrel5mw_platform 1 "--pitch: value = wobble=5; allowed: mean=M" --pitch wobble=5)
add_example_test(example_platform_number nrel5mw_platform 1 "--pitch: value = amplitude=x,period=3; allowed" --pitch
                  amplitude=x,period=3)
add_example_test(example_platform_twice nrel5mw_platform 1 "--yaw: value = mean=1,mean=2; allowed" --yaw mean=1,mean=2)
add_example_test(example_platform_no_period nrel5mw_platform 1 "--pitch: amplitude without = a period" --pitch amplitude=5)
add_example_test(example_platform_period nrel5mw_platform 1 "--roll: period .s. = -3; allowed: finite and > 0" --roll
                  amplitude=5,period=-3)
add_example_test(example_platform_parked nrel5mw_platform 1 "--roll: revolutions of a rotor at = 0 rpm" --rpm 0 --roll
                  amplitude=5,revolutions=1)
add_example_test(example_platform_still nrel5mw_platform 1 "none that oscillates" --rpm 0)
add_example_test(example_platform_common nrel5mw_platform 1 "common period: periods .s. = 4.958677686, 7.3; allowed" --heave
                  amplitude=1,period=7.3)
add_example_test(example_platform_rpm nrel5mw_platform 1 "--rpm: value = -1; allowed" --rpm=-1)
add_example_test(example_platform_blades nrel5mw_platform 1 "number of blades = 4; allowed: 1 ... 3" --blades 4)
add_example_test(example_platform_elements nrel5mw_platform 1 "number of elements = 0; allowed: >= 1" --elements 0)
add_example_test(example_platform_tolerance nrel5mw_platform 1 "relative tolerance = -1; allowed" --tolerance=-1)
add_example_test(example_platform_unwritable nrel5mw_platform 1 "the folder 'no/such/folder' does not exist" --out
                  no/such/folder/x)
