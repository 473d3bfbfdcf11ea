set(coarse_spar --variant fast --blade-elements 2 --tower-elements 2)
add_example_test(example_floating_modes nrel5mw_floating 0
                 "Platform Surge.*equilibrium under gravity.*platform modes.*Platform Yaw.*free spar, spar held.*nearest in shape.*1st Tower FA.*files: example_floating.h5.*_difference.png"
                 modes ${coarse_spar} --rpm 0,12.1 --max-frequency 2 --out example_floating)
add_example_test(example_floating_decay nrel5mw_floating 0
                 "energy lost.*ok.*Platform Heave +1 m +30.*Platform Yaw +2 deg +8[.0-9]+ +8[.0-9]+ +-?0[.0-9]+ %.*files: example_floating_decay_heave.h5" decay ${coarse_spar} --from heave=1
                 --from yaw=2 --cycles 3 --out example_floating_decay)
add_example_test(example_floating_motion nrel5mw_floating 0
                 "energy lost.*ok.*surge 1 m at 8 s, pitch 2 deg at 8 s.*blade 1 tip out-of-plane deflection.*files: example_floating_motion.csv"
                 motion ${coarse_spar} --surge amplitude=1,period=8 --pitch amplitude=2,period=8 --settle 8 --periods 3 --out
                 example_floating_motion)
add_example_test(example_floating_two_periods nrel5mw_floating 0
                 "surge 1 m at 12 s, pitch 1 deg at 20 s .mean 2 deg, phase 90 deg.*at 12 s +at 20 s +half range +rest.*tower top"
                 motion ${coarse_spar} --surge amplitude=1,period=12 --pitch amplitude=1,period=20,mean=2,phase=90 --settle 10
                 --periods 2 --out example_floating_two_periods)
add_example_test(example_floating_motion_parked nrel5mw_floating 0 "0 rpm: still.*energy lost.*ok.*surge 1 m at 12 s.*energy lost.*ok"
                 motion ${coarse_spar} --rpm 0 --surge amplitude=1,period=12 --settle 5 --periods 1 --out
                 example_floating_motion_parked)
# Amplitudes must not depend on where the stretch lies that is looked at: 0.0909 Hz beside 0.1108 Hz, rotor less pitch.
add_test(NAME example_floating_settle
         COMMAND sh -c
                 "for settle in 60 90; do $<TARGET_FILE:nrel5mw_floating> motion --variant fast --blade-elements 2 --tower-elements 2 --pitch amplitude=1,period=11 --settle $settle --out example_floating_settle_$settle > example_floating_settle.txt 2>&1 || { cat example_floating_settle.txt; exit 1; }; done; \
awk -F, 'NR == FNR {first[$3] = $(NF-2); next} /OoPDefl1|IPDefl1|RootMyc1|TTDspFA|TwrBsMyt/ {n++; d = $(NF-2) / first[$3] - 1; if (d < 0) d = -d; if (!(d < 5e-4)) {print $3, d; bad = 1}} END {exit bad || n != 5}' example_floating_settle_60.csv example_floating_settle_90.csv"
         WORKING_DIRECTORY ${test_output_dir})
# A yaw damping a hundred times as large: nothing oscillates.
add_test(NAME example_floating_overdamped
         COMMAND sh -c
                 "mkdir -p example_floating_data && cp ${CMAKE_CURRENT_SOURCE_DIR}/../turbines/data/*.csv example_floating_data && sed -i 's/^damping_yaw,N m s.rad,/&100/' example_floating_data/oc3_hywind_platform.csv && $<TARGET_FILE:nrel5mw_floating> decay --variant fast --blade-elements 2 --tower-elements 2 --data example_floating_data --from yaw=2 --from heave=1 --cycles 1 --out example_floating_overdamped"
         WORKING_DIRECTORY ${test_output_dir})
set_tests_properties(example_floating_overdamped PROPERTIES PASS_REGULAR_EXPRESSION
                     "overdamped or not found: no linear value.*Platform Heave.*too few cycles to judge.*files:")
add_example_test(example_floating_far nrel5mw_floating 3 "Platform Roll +60 deg.*MORE THAN 1 %" decay ${coarse_spar} --from roll=60
                 --cycles 4 --out example_floating_far)
# Ctrl-C: exit code 130, and what was computed is there.
add_test(NAME example_floating_interrupted
         COMMAND ${CMAKE_COMMAND} -D PROGRAM=${CMAKE_CURRENT_SOURCE_DIR}/programs/interrupt.sh
                 "-DARGUMENTS=example_floating_interrupted_pitch.h5;$<TARGET_FILE:nrel5mw_floating>;decay;--variant;fast;--blade-elements;4;--tower-elements;2;--tolerance;1e-9;--from;pitch=3;--cycles;1000;--out;example_floating_interrupted"
                 -D CODE=130 "-DSAYS=files: example_floating_interrupted_pitch.h5" -P ${CMAKE_CURRENT_SOURCE_DIR}/run_program.cmake
         WORKING_DIRECTORY ${test_output_dir})
add_example_test(example_floating_interrupted_history cardan 0 "decay of platform pitch.*broken off" info
                 example_floating_interrupted_pitch.h5)
set_tests_properties(example_floating_interrupted PROPERTIES FIXTURES_SETUP floating_interrupted)
set_tests_properties(example_floating_interrupted_history PROPERTIES FIXTURES_REQUIRED floating_interrupted)
add_example_test(example_floating_help nrel5mw_floating 0 "modes.*decay.*motion" --help)
add_example_test(example_floating_decay_help nrel5mw_floating 0 "--cycles" decay --help)
add_example_test(example_floating_no_study nrel5mw_floating 2 "subcommand is required" --variant fast)
add_example_test(example_floating_other_study nrel5mw_floating 2 "subcommand is required|not expected" flutter)
add_example_test(example_floating_unknown_option nrel5mw_floating 2 "--nonsense" modes --nonsense)
add_example_test(example_floating_other_option nrel5mw_floating 2 "--surge" modes --surge amplitude=1,period=3)
add_example_test(example_floating_variant nrel5mw_floating 2 "--variant" modes --variant hawc2)
add_example_test(example_floating_rpm nrel5mw_floating 1 "--rpm: value = 0,x; allowed: numbers and FIRST:LAST:STEP" modes --rpm 0,x)
add_example_test(example_floating_coordinate nrel5mw_floating 1 "--from: coordinate = sink; allowed: surge, sway" decay --from sink=1)
add_example_test(example_floating_value nrel5mw_floating 1 "--from: value = pitch=x; allowed: COORDINATE=VALUE" decay --from pitch=x)
add_example_test(example_floating_zero nrel5mw_floating 1 "--from: displacement = pitch=0; allowed: not zero" decay --from pitch=0)
add_example_test(example_floating_cycles nrel5mw_floating 1 "--cycles: value = -1; allowed: finite and > 0" decay --cycles=-1)
add_example_test(example_floating_step nrel5mw_floating 1 "--step: value = 0; allowed: finite and > 0" motion --step 0)
add_example_test(example_floating_steady nrel5mw_floating 1 "--surge: motion = velocity=1; allowed: one that oscillates" motion --surge
                 velocity=1)
add_example_test(example_floating_key nrel5mw_floating 1 "--pitch: value = wobble=5; allowed: mean=M" motion --pitch wobble=5)
add_example_test(example_floating_amplitude nrel5mw_floating 1 "--amplitude: value .m or deg. = -1; allowed" motion --amplitude=-1)
add_example_test(example_floating_in_turn nrel5mw_floating 2 "excludes" motion --surge amplitude=1,period=12 --period 3)
add_example_test(example_floating_beat nrel5mw_floating 1
                 "stretch that is looked at .s. = 60; allowed: at least 600, to tell 0.1 Hz from 0.10166.*the difference to the rotor's"
                 motion --pitch amplitude=1,period=10)
add_example_test(example_floating_coarse_step nrel5mw_floating 1 "--step: value .s. = 30; allowed: at most 0.3" motion --step 30)
add_example_test(example_floating_tilted nrel5mw_floating 1 "--roll: displacement .deg. = 91; allowed: at most 89" motion --roll
                 mean=90,amplitude=1,period=12)
add_example_test(example_floating_tolerance nrel5mw_floating 1 "--tolerance: value = 10; allowed: at most 1e-4" decay --tolerance 10)
add_example_test(example_floating_from_far nrel5mw_floating 1 "--from surge: displacement .m. = 1000000; allowed: at most 100" decay
                 --from surge=1e6)
add_example_test(example_floating_from_angle nrel5mw_floating 1 "--from pitch: displacement .deg. = 91; allowed: at most 89" decay --from
                 pitch=91)
add_example_test(example_floating_from_twice nrel5mw_floating 1 "--from: coordinate = surge=2; allowed: each once" decay --from all --from
                 surge=2)
add_example_test(example_floating_elements nrel5mw_floating 1 "number of elements = 0; allowed: 1 ... 1000" decay --blade-elements 0)
add_example_test(example_floating_unwritable nrel5mw_floating 1 "the folder 'no/such/folder' does not exist" modes ${coarse_spar} --out
                 no/such/folder/x)
add_example_test(example_floating_no_data nrel5mw_floating 1 "no_such_folder/oc3_hywind_platform.csv: cannot be read" modes --data
                 no_such_folder)
