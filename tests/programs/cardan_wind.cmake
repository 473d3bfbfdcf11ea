# Turbulent wind: made and read back, the same for the same seed, looked at, simulated in; what is refused.
set(small --points 5x5 --duration 60 --step 0.05)
add_example_test(example_wind cardan 0
    "hub at 90 m, rotor of 126 m.*ntm of class I B: standard deviation of u 2[.]044 m/s.*5 x 5 points, 151[.]2 x 151[.]2 m.*1200 planes 0[.]05 s apart: 60 s, periodic.*checksum +[0-9a-f]+\nnote +Cardan: kaimal, V 12 m/s.*mean at the hub, 90 m +12[.]0.*files: example_wind[.]bts, [.]svg"
    wind nrel5mw --speed 12 --wind-class IB ${small} --seed 5 --out example_wind)
set_tests_properties(example_wind PROPERTIES FIXTURES_SETUP wind_box)
add_example_test(example_wind_again cardan 0 "files: example_wind_again[.]bts\n" wind --hub-height 90 --diameter 126 --speed 12 --wind-class
                 IB ${small} --seed 5 --threads 2 --no-picture --out example_wind_again)
set_tests_properties(example_wind_again PROPERTIES FIXTURES_SETUP wind_box_again)
add_test(NAME example_wind_same_seed COMMAND ${CMAKE_COMMAND} -E compare_files example_wind.bts example_wind_again.bts
         WORKING_DIRECTORY ${test_output_dir})
set_tests_properties(example_wind_same_seed PROPERTIES FIXTURES_REQUIRED "wind_box;wind_box_again")
add_example_test(example_wind_look cardan 0
    "TurbSim [.]bts\n.*points of the tower.*note +Cardan: kaimal.*seed 5\n.*files: example_wind_look[.]svg, beside Kaimal's spectrum" wind
    example_wind.bts --rpm 12.1 --diameter 126 --out example_wind_look)
add_example_test(example_wind_look_without_speed cardan 0 "files: example_wind_still[.]svg" wind example_wind.bts --out example_wind_still)
add_example_test(example_wind_simulate cardan 0 "turbulence: example_wind[.]bts, TurbSim [.]bts; 5 x 5 points.*seed 5" simulate nrel5mw --wind
                 example_wind.bts --duration 0.2 --blades rigid --tower rigid --out example_wind_simulate)
add_example_test(example_wind_making_option cardan 1 "--seed: use = example_wind.bts; allowed: only with --speed" wind example_wind.bts
                 --seed 3 --out example_wind_none)
set_tests_properties(example_wind_look example_wind_look_without_speed example_wind_simulate example_wind_making_option
                     PROPERTIES FIXTURES_REQUIRED wind_box)
# Scaled: exactly what is asked for, in a file of 16 bits.
add_example_test(example_wind_mann cardan 0 "Mann's tensor, standard deviation of u 2 m/s.*first plane first, scaled\n.*standard deviation there +(2[.]0000|1[.]9999)" wind
                 --hub-height 90 --diameter 126 --speed 12 --deviation 2 --scaled --spectrum mann --plane-order first-first
                 --points 5x5 --duration 20 --step 0.25 --no-picture --out example_wind_mann)
add_example_test(example_wind_extreme cardan 0 "ewm50 of class II A: standard deviation of u 4[.]675 m/s, 11 % of 42[.]5 m/s.*exponent 0[.]11" wind
                 wt600 --turbulence ewm50 --wind-class IIA --points 3x4 --duration 10 --step 0.5 --no-picture --out example_wind_extreme)
add_example_test(example_wind_of_others cardan 0 "TurbSim.*files: example_wind_others[.]svg, beside Kaimal's with its deviations" wind
                 ${CMAKE_CURRENT_SOURCE_DIR}/data/wind/box8.bts --out example_wind_others)
add_example_test(example_wind_help cardan 0 "--plane-order" wind --help)
add_example_test(example_wind_no_speed cardan 1 "nrel5mw: --speed is needed to make turbulence for a machine" wind nrel5mw)
add_example_test(example_wind_nothing cardan 1 "cardan wind: --speed is needed" wind)
add_example_test(example_wind_no_machine cardan 1 "a machine, or --hub-height and --diameter" wind --speed 12)
add_example_test(example_wind_no_file cardan 1 "no/such.bts: " wind no/such.bts)
add_example_test(example_wind_points cardan 1 "--points: value = 31; allowed: NUMBERxNUMBER, 2x2 to 1024x1024" wind nrel5mw --speed 12 --points 31)
add_example_test(example_wind_two_speeds cardan 1 "--speed: value .m/s. = 12; allowed: none beside --turbulence ewm1" wind nrel5mw --speed 12
                 --turbulence ewm1)
add_example_test(example_wind_two_deviations cardan 2 "excludes" wind nrel5mw --speed 12 --deviation 2 --turbulence etm)
add_example_test(example_wind_class cardan 1 "--wind-class: .*IV" wind nrel5mw --speed 12 --wind-class IV)
add_example_test(example_wind_low cardan 1 "height .m. = 200; allowed: at least 126, the rotor's diameter, and below 180" wind nrel5mw --speed
                 12 --height 200)
add_example_test(example_wind_steady cardan 1 "wind = a table, without turbulence; allowed: a turbulent wind" wind ${history})
add_example_test(example_wind_info cardan 1 "box8.bts: is a wind and no machine" info ${CMAKE_CURRENT_SOURCE_DIR}/data/wind/box8.bts)
add_example_test(example_wind_look_result cardan 0 "files: example_wind_result[.]svg" wind example_wind_simulate.h5 --out example_wind_result)
set_tests_properties(example_wind_simulate PROPERTIES FIXTURES_SETUP wind_history)
set_tests_properties(example_wind_look_result PROPERTIES FIXTURES_REQUIRED "wind_box;wind_history")
