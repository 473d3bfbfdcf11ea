# The command itself, and what the commands share: help, completion, manual pages, results that are repeated.
set(models ${CMAKE_CURRENT_SOURCE_DIR}/data)
set(coarse --blade-elements 2 --tower-elements 2)
add_example_test(example_cardan_help cardan 0 "campbell .*repeat .*cardan COMMAND --help" --help)
add_example_test(example_cardan_version cardan 0 "^${PROJECT_VERSION}" --version)
add_example_test(example_cardan_help_word cardan 0 "Usage: cardan steady .*--azimuths" help steady)
add_example_test(example_cardan_unknown cardan 2 "there is no command 'campbel'.*Usage: cardan COMMAND" campbel)

# Modes, steady states, contents.
add_example_test(example_modes cardan 0
    "modes at 12.1 rpm.*lambda.*damped Hz.*1st tower fore-aft +0[.]3[0-9]+ .*1. tower fore-aft [0-9]+ %.*mesh: 2 elements.*shapes in example_modes/"
    modes nrel5mw --rpm 12.1 ${coarse} --shapes --out example_modes)
# By hand: the weight above the tower's foot is its mean axial force; means of TwrBsFzt and of the blades' root forces.
add_example_test(example_steady cardan 0 "harmonics.*mesh.*RotSpeed|rotor speed +1.26[0-9]+.*blade 1 root moment y.*72 azimuths"
    steady nrel5mw ${coarse} --out example_steady)
add_example_test(example_steady_backwards cardan 0 "rotor speed +-0[.]52[0-9]+.*files: example_steady_backwards[.]h5 .72 azimuths"
    steady nrel5mw --rpm -5 ${coarse} --out example_steady_backwards)
add_example_test(example_steady_wind cardan 0 "5296[.]61 kW on the rotor.*at 9 m/s, and with twice as many elements: power [0-9]+.*; thrust [0-9.]+, [0-9.]+ kN; tip out of the plane [0-9.]+, [0-9.]+ m; its twist -[0-9.]+, -[0-9.]+ deg.*8[.]000 +9[.]3[0-9]+ +0[.]0000 +18[0-9]+[.].*files: example_steady_wind[.]h5"
    steady nrel5mw --wind 8,9 --no-gravity --harmonics 2 ${coarse} --blade-stations 40 --out example_steady_wind)
add_example_test(example_steady_wind_windio cardan 0 "operation: tip-speed ratio.*8[.]000 .*files: example_steady_wind_windio[.]h5" steady
    ${models}/windio/small_v1.yaml --wind 8 --rated-power 90 --no-gravity --harmonics 2 ${coarse} --out example_steady_wind_windio)
add_example_test(example_steady_wind_air cardan 0 "air of the operating points: wake oye, airfoils unsteady, in equilibrium with the motion of every instant.*8[.]000 .*files: example_steady_wind_air[.]h5" steady ${models}/windio/small_v2.yaml
    --air ${models}/windio/small_v1.yaml --rated-rpm 60 --wind 8 --rated-power 90 --no-gravity --harmonics 2 ${coarse}
    --out example_steady_wind_air)
add_example_test(example_steady_wind_profiles cardan 1 "--air: value = none, and the machine has no airfoils" steady wt600 --wind 8)
add_example_test(example_steady_wind_bad cardan 1 "--wind: value = 9:8:1; allowed: numbers and FIRST:LAST:STEP" steady nrel5mw --wind 9:8:1)
add_example_test(example_steady_wind_rpm cardan 1 "--rpm: value = 3; allowed: none beside --wind" steady nrel5mw --wind 8 --rpm 3)
add_example_test(example_flutter cardan 0 "air of the blade: wake none, airfoils unsteady.*flutter of [12][a-z]+ blade [a-z]+ from 2[0-9.]+ rpm [(][+]-[0-9.]+: 2[0-9.]+ with 6 elements per blade, [23][0-9.]+ with 8[)], [0-9.]+ times the machine's, tip 1[0-9.]+ m/s.*files: example_flutter[.]h5" flutter nrel5mw
    --rpm 15:30 --steps 5 --blade-elements 4 --tower-elements 1 --out example_flutter)
add_example_test(example_flutter_bad cardan 1 "--rpm: value = 30:15; allowed: FIRST:LAST" flutter nrel5mw --rpm 30:15)
add_example_test(example_flutter_airfoils cardan 1 "--air: value = none, and the machine has no airfoils" flutter wt600)
add_example_test(example_steady_rest cardan 0 "at rest.*tower base force z +-6[.][0-9]+e.06" steady nrel5mw --rpm 0 --all ${coarse} --out
    example_steady_rest)
add_example_test(example_info_machine cardan 0 "blades +3, upwind\n.*rotor +12[56].*hub height +90 m.*air +19 sections, 8 airfoils with lags.*rated power +5296[.]61 kW.*efficiency 0[.]944.*total +[67][0-9.]+.*clamped.* 0.6[0-9]+ 1.0"
    info nrel5mw)
add_example_test(example_info_unknown cardan 1 "machine: name = nrel6mw; allowed: wt600" info nrel6mw)

# A result once more, to the last digit: the machine, the command and the options are in its file.
foreach(case IN ITEMS campbell simulate linearise)
    set(arguments wt600 ${coarse} --out example_first_${case})
    if(case STREQUAL "campbell")
        list(APPEND arguments --rpm 0:30:10 --pitch-schedule 0:4,20:1,30:0.5 --tower fore-aft)
    elseif(case STREQUAL "simulate")
        list(APPEND arguments --duration 1 --generator-torque 500 --blades rigid)
    else()
        list(APPEND arguments --rpm 27 --azimuths 9 --lin)
    endif()
    add_example_test(example_first_${case} cardan 0 "files" ${case} ${arguments})
    add_example_test(example_again_${case} cardan 0 "cardan ${case} example_first_${case}.h5 --.*files" repeat example_first_${case}.h5 --out
                     example_again_${case})
    set_tests_properties(example_first_${case} PROPERTIES FIXTURES_SETUP first_${case})
    set_tests_properties(example_again_${case} PROPERTIES FIXTURES_REQUIRED first_${case} FIXTURES_SETUP again_${case})
endforeach()
foreach(times IN ITEMS first again)
    add_example_test(example_${times}_simulate_csv cardan 0 "rows of" convert example_${times}_simulate.h5 example_${times}_simulate.csv)
    set_tests_properties(example_${times}_simulate_csv PROPERTIES FIXTURES_REQUIRED ${times}_simulate FIXTURES_SETUP csv_${times})
endforeach()
foreach(file IN ITEMS campbell.csv simulate.csv linearise.3.lin)
    string(REGEX REPLACE "[.].*" "" case ${file})
    add_test(NAME example_same_${case} COMMAND ${CMAKE_COMMAND} -E compare_files example_first_${file} example_again_${file}
             WORKING_DIRECTORY ${test_output_dir})
    set_tests_properties(example_same_${case} PROPERTIES FIXTURES_REQUIRED "first_${case};again_${case};csv_first;csv_again")
endforeach()
add_example_test(example_repeat_show cardan 0 "cardan campbell example_first_campbell.h5 --rpm=0:30:10 --pitch-schedule=0:4,20:1,30:0.5 .*--tower=fore-aft"
                 repeat example_first_campbell.h5 --show)
add_example_test(example_result_machine cardan 0 "1st blade flap" campbell example_first_linearise.h5 --rpm 0 ${coarse} --out example_result_machine)
set_tests_properties(example_repeat_show PROPERTIES FIXTURES_REQUIRED first_campbell)
set_tests_properties(example_result_machine PROPERTIES FIXTURES_REQUIRED first_linearise)

# Pitch over the rotor speed, what the tower stands on, tip masses.
add_example_test(example_pitch_schedule cardan 1 "--pitch-schedule: value = 0:1,0:2; allowed: RPM:DEG" campbell wt600 --pitch-schedule 0:1,0:2)
file(WRITE ${test_output_dir}/soft.yaml "stiffness:\n"
     "- [1.0e8, 0, 0, 0, -1.0e9, 0]\n- [0, 1.0e8, 0, 1.0e9, 0, 0]\n- [0, 0, .inf, 0, 0, 0]\n- [0, 1.0e9, 0, 2.0e10, 0, 0]\n"
     "- [-1.0e9, 0, 0, 0, 2.0e10, 0]\n- [0, 0, 0, 0, 0, .inf]\n")
add_example_test(example_foundation cardan 0 "platform pitch +0[.]19" campbell nrel5mw --rpm 0 --foundation soft.yaml ${coarse}
                 --out example_foundation)
add_example_test(example_foundation_bad cardan 1 "soft.yaml.*small_v1.yaml|small_v1.yaml:[0-9]+.*unknown key; allowed: stiffness" campbell nrel5mw --rpm 0
                 --foundation ${models}/windio/small_v1.yaml ${coarse})

# Completion: what bash offers.
add_test(NAME example_completion COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/programs/completion.sh
         ${PROJECT_SOURCE_DIR}/programs/cardan/completion.bash $<TARGET_FILE:cardan>)
get_property(manual GLOBAL PROPERTY CARDAN_MANUAL)
if(manual)
    add_test(NAME example_manual COMMAND grep -q "max.*frequency" ${PROJECT_BINARY_DIR}/programs/manual/cardan-campbell.1)
endif()

# Stations along blades and tower, in all that has channels.
add_example_test(example_stations_simulate cardan 0 "tower at 43.8 m force z +TwHt1FLzt.*blade 2 at 40 m moment y +Spn2MLyb2 +N m" simulate nrel5mw
                 ${coarse} --blade-stations 20,40 --tower-stations 43.8 --list)
add_example_test(example_stations_steady cardan 0 "blade 1 at 20 m accelerometer z" steady nrel5mw ${coarse} --blade-stations 20 --all --out
                 example_stations_steady)
add_example_test(example_stations_linear cardan 0 "71 outputs.*blade at 20 m moment y .collective" linearise nrel5mw ${coarse} --blade-stations 20 --order 6 --out
                 example_stations_linear)
add_example_test(example_stations_bad cardan 1 "--blade-stations: value = 20,; allowed: numbers separated by commas" steady nrel5mw ${coarse}
                 --blade-stations 20,)
add_example_test(example_stations_beyond cardan 1 "station.*70.*allowed" steady nrel5mw ${coarse} --blade-stations 70)
