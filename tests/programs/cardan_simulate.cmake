# Any machine in time.
set(models ${CMAKE_CURRENT_SOURCE_DIR}/data)
set(options --blade-elements 1 --tower-elements 1 --tolerance 1e-5 --step 0.05)
set(coarse ${options} --duration 3)
add_example_test(example_turbine_time_wt600 cardan 0
    "generator and yaw bearing free\n.*from 32.9229 rpm, rotor free, 3 s.*blade 3 root moment y.*energy lost.*ok.*example_turbine_time_wt600.h5 .61 samples.*_energy.png" simulate
    wt600 ${coarse} --out example_turbine_time_wt600)
add_example_test(example_turbine_time_generator cardan 0
    "generator torque.*energy lost.*ok.*recorded power of generator against its work.*ok" simulate
    wt600 ${coarse} --rpm 20 --generator-torque 500 --generator-slope 20 --out example_turbine_time_generator)
# The same by the library's own calls, written by hand: tests/regression/test_simulate.cpp.
add_test(NAME example_turbine_time_by_hand COMMAND test_regression "cardan simulate: the file of the program*"
         WORKING_DIRECTORY ${test_output_dir})
set_tests_properties(example_turbine_time_generator PROPERTIES FIXTURES_SETUP turbine_generator_run)
set_tests_properties(example_turbine_time_by_hand PROPERTIES FIXTURES_REQUIRED turbine_generator_run)
add_example_test(example_turbine_time_teetered cardan 0
    "from 57.4868 rpm, rotor driven.*teeter angle.*blade 2 root moment x.*energy lost.*ok" simulate teetered ${coarse}
    --out example_turbine_time_teetered)
add_example_test(example_turbine_time_teetered_free cardan 0 "rotor free.*yaw .*energy lost.*ok.*files" simulate teetered
    ${coarse} --generator free --azimuth 30 --q yaw=0.1 --qd teeter=0.01 --out example_turbine_time_teetered_free)
add_example_test(example_turbine_time_nrel5mw cardan 0 "from 12.1 rpm.*energy lost.*ok" simulate nrel5mw ${coarse}
    --out example_turbine_time_nrel5mw)
add_example_test(example_turbine_time_spar cardan 0 "OC3-Hywind spar.*energy lost.*ok" simulate nrel5mw-spar ${coarse}
    --rpm 6 --out example_turbine_time_spar)
add_example_test(example_turbine_time_openfast cardan 0 "Blade.dat:[0-9]+: FlStTunr.*rpm, rotor driven.*energy lost.*ok" simulate
    ${models}/openfast/small.fst ${coarse} --notes --generator locked --method alpha --out example_turbine_time_openfast)
# A machine at rest in its equilibrium stays there; without gravity nothing moves at all.
add_example_test(example_turbine_time_rest cardan 0 "rotor speed +[-.0-9e]+e-[01][0-9] .*of the maximum exchanged.*ok" simulate
    wt600 ${coarse} --rpm 0 --out example_turbine_time_rest)
add_example_test(example_turbine_time_own cardan 0 "from 33.42[0-9]* rpm.*energy lost.*ok" simulate
    ${PROJECT_SOURCE_DIR}/examples/data/own_turbine.yaml ${coarse} --out example_turbine_time_own)
# A blade that is missing, and all.
file(READ ${PROJECT_SOURCE_DIR}/examples/data/own_turbine.yaml own_turbine)
file(WRITE ${test_output_dir}/missing_blade.yaml "${own_turbine}own_blades: {1: missing}\n")
string(REPLACE "blades: 3" "blades: 0" hub_alone "${own_turbine}")
file(WRITE ${test_output_dir}/hub_alone.yaml "${hub_alone}")
add_example_test(example_turbine_time_missing cardan 0 "blade 3 root moment x.*energy lost.*ok.*_spectrum.png" simulate
    missing_blade.yaml ${options} --duration 8 --out example_turbine_time_missing)
add_example_test(example_turbine_time_hub_alone cardan 0 "rotor speed +3.5 .*energy lost.*ok" simulate hub_alone.yaml
    ${coarse} --out example_turbine_time_hub_alone)
add_example_test(example_turbine_time_plot cardan 0 "example_turbine_time_plot.h5.*, .svg, .png" simulate wt600 ${coarse}
    --no-gravity --start undeformed --undamped --plot TTDspFA+TTDspSS --plot RotSpeed --out example_turbine_time_plot)
add_example_test(example_turbine_time_list cardan 0 "blade 2 root moment y +RootMyb2 +N m" simulate missing_blade.yaml --list)
# Further, from the end of a run.
set(resumed teetered ${options} --out example_turbine_time_resume)
add_example_test(example_turbine_time_begin cardan 0 "61 samples" simulate ${resumed} --duration 3)
add_example_test(example_turbine_time_resume cardan 0 "energy lost.*ok.*81 samples" simulate ${resumed} --duration 4 --resume)
add_example_test(example_turbine_time_resume_other cardan 1 "--resume: run of .*azimuth 0 deg; .*: azimuth 10 deg" simulate
    ${resumed} --duration 5 --resume --azimuth 10)
set_tests_properties(example_turbine_time_begin PROPERTIES FIXTURES_SETUP begun_turbine_run)
set_tests_properties(example_turbine_time_resume PROPERTIES FIXTURES_REQUIRED begun_turbine_run FIXTURES_SETUP resumed_turbine_run)
set_tests_properties(example_turbine_time_resume_other PROPERTIES FIXTURES_REQUIRED "begun_turbine_run;resumed_turbine_run")
add_test(NAME example_turbine_time_interrupted COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/programs/interrupted_runs.sh
         $<TARGET_FILE:cardan> $<TARGET_FILE:cardan> simulate ${test_output_dir}/hub_alone.yaml ${options} WORKING_DIRECTORY ${test_output_dir})
# What a file holds beyond the ranges of machines is said without --notes.
file(COPY ${models}/openfast/ DESTINATION ${test_output_dir}/unusual)
file(READ ${models}/openfast/small_ElastoDyn.dat elastodyn)
string(REPLACE "-4.0   ShftTilt" "-25.0   ShftTilt" elastodyn "${elastodyn}")
file(WRITE ${test_output_dir}/unusual/small_ElastoDyn.dat "${elastodyn}")
add_example_test(example_turbine_time_unusual cardan 0
    "small_ElastoDyn.dat: angles and ratios = unusual: taken as they are: [^\n]*nacelle.tilt .rad. = 0.436.*energy lost.*ok" simulate
    unusual/small.fst ${coarse} --out example_turbine_time_unusual)
# Bad usage.
add_example_test(example_turbine_time_help cardan 0 "--generator-slope.*  teetered  " simulate --help)
add_example_test(example_turbine_time_no_machine cardan 2 "model is required" simulate)
add_example_test(example_turbine_time_unknown cardan 1
    "machine: name = wt60; allowed: wt600, teetered, nrel5mw, nrel5mw-fast, nrel5mw-beamdyn, nrel5mw-spar, or a file" simulate wt60)
add_example_test(example_turbine_time_no_file cardan 1 "no/such.yaml: cannot be read: No such file" simulate no/such.yaml)
add_example_test(example_turbine_time_not_one cardan 1 "[.]cmake:1: neither a main file of OpenFAST" simulate
    ${CMAKE_CURRENT_LIST_FILE})
add_example_test(example_turbine_time_unknown_option cardan 2 "--nonsense" simulate wt600 --nonsense)
add_example_test(example_turbine_time_channel cardan 1 "channel = 'RotSped'; allowed: one of 'RotSpeed'" simulate wt600 --plot
    RotSped --out example_turbine_time_channel)
add_example_test(example_turbine_time_coordinate cardan 1 "unknown coordinate 'jaw'" simulate wt600 --q jaw=1 --out
    example_turbine_time_coordinate)
add_example_test(example_turbine_time_duration cardan 1 "--duration: value = 0" simulate wt600 --duration 0)
add_example_test(example_turbine_time_rpm cardan 1 "--rpm: value = nan; allowed: finite" simulate wt600 --rpm nan)
add_example_test(example_turbine_time_unwritable cardan 1 "the folder 'no/such' does not exist" simulate wt600 --out no/such/x)
# In the air: a gust over time, with a controller, on a rotor that is driven; what is refused.
file(WRITE ${test_output_dir}/gust.csv "time[s],speed[m/s],direction[deg]\n0,10,0\n1,10,0\n1.5,12,5\n2.5,10,0\n")
file(WRITE ${test_output_dir}/gust_back.csv "time[s],speed[m/s]\n1,10\n0,12\n")
set(air nrel5mw ${coarse} --wind gust.csv --rpm 11 --out)
add_example_test(example_turbine_time_wind cardan 0
    "air of the run: wake oye, airfoils unsteady.*energy lost.*ok.*recorded power of generator, air against its work.*ok.*61 samples" simulate ${air} example_turbine_time_wind)
add_example_test(example_turbine_time_wind_controlled cardan 0 "energy lost.*ok.*recorded power of generator, air against.*ok" simulate
    ${air} example_turbine_time_wind_controlled --controller baseline)
add_example_test(example_turbine_time_wind_driven cardan 0 "rotor driven.*recorded power of air against.*ok" simulate
    ${air} example_turbine_time_wind_driven --generator locked)
add_example_test(example_turbine_time_wind_coarse cardan 0 "recorded power of air: outputs every 0.1 s are too far apart" simulate
    nrel5mw --blade-elements 2 --tower-elements 2 --wind 50 --wind-direction 180 --rpm 0 --pitch 90 --generator-torque 0 --step 0.1 --duration 4
    --out example_turbine_time_wind_coarse)
add_example_test(example_turbine_time_wind_list cardan 0 "wind speed +HorWindV.*aerodynamic power +RtAeroPwr" simulate nrel5mw --wind 9 --list)
add_example_test(example_turbine_time_wind_back cardan 1 "gust_back.csv:1: wind over time, row 2: time .s. = 0" simulate
    nrel5mw ${coarse} --wind gust_back.csv)
add_example_test(example_turbine_time_wind_word cardan 1 "--wind: value = strong; allowed: SPEED in m/s. or FILE" simulate
    nrel5mw ${coarse} --wind strong)
add_example_test(example_turbine_time_wind_profiles cardan 1 "--air: value = none" simulate wt600 ${coarse} --wind 9)
