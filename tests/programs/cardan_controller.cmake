# Machines under a controller: cardan simulate --controller, --rotor-torque.
set(models ${CMAKE_CURRENT_SOURCE_DIR}/data)
set(small nrel5mw-fast --blade-elements 1 --tower-elements 1 --tolerance 1e-5 --step 0.05 --no-gravity)
set(driven --rotor-torque 4.18e6)
add_example_test(example_controller_baseline cardan 0
    "rotor free, 3 s.*energy lost.*ok.*recorded power of generator, rotor torque against its work.*ok.*example_controller_baseline.h5 .61 samples"
    simulate ${small} ${driven} --controller baseline --generator-efficiency 0.944 --duration 3 --pitch 5 --out example_controller_baseline)
set_tests_properties(example_controller_baseline PROPERTIES FIXTURES_SETUP controlled_run)
add_example_test(example_controller_channels cardan 0
    "pitch demand .*torque demand .*generator torque +GenTq.*generator power.*electrical power +GenPwr.*rotor torque " simulate
    ${small} ${driven} --controller baseline --list)
add_example_test(example_controller_repeat cardan 0 "--controller=baseline.*energy lost.*ok" repeat
    example_controller_baseline.h5 --out example_controller_repeated)
set_tests_properties(example_controller_repeat PROPERTIES FIXTURES_REQUIRED controlled_run)
# Further, from the end of a run: the same as a run in one piece.
set(resumed ${small} ${driven} --controller baseline --out example_controller_resume)
add_example_test(example_controller_begin cardan 0 "41 samples" simulate ${resumed} --duration 2)
add_example_test(example_controller_resume cardan 0 "energy lost.*ok.*61 samples" simulate ${resumed} --duration 3 --resume)
add_example_test(example_controller_resume_other cardan 1 "--resume: run of .* = rotor torque: [0-9.e+]+ N m; allowed: that of this run: rotor torque: [0-9.e+]+ N m" simulate
    ${small} --rotor-torque 4e6 --controller baseline --out example_controller_resume --duration 4 --resume)
set_tests_properties(example_controller_begin PROPERTIES FIXTURES_SETUP begun_controlled_run)
set_tests_properties(example_controller_resume PROPERTIES FIXTURES_REQUIRED begun_controlled_run FIXTURES_SETUP resumed_controlled_run)
set_tests_properties(example_controller_resume_other PROPERTIES FIXTURES_REQUIRED "begun_controlled_run;resumed_controlled_run")
# A controller in a library; what it reads, and its failures.
set(library --controller $<TARGET_FILE:test_controller>)
foreach(word IN ITEMS follow individual nan fail off warn brake yaw)
    file(WRITE ${test_output_dir}/${word} "")
endforeach()
add_example_test(example_controller_library cardan 0 "energy lost.*ok.*files: example_controller_library.h5" simulate ${small} ${driven}
    ${library} --controller-input follow --duration 1 --out example_controller_library)
# The pitch: prescribed without springs in the model, also of blades of ElastoDyn without inertia about their axes; by
# the model's drive; by actuators where they are asked for.
set(small_air --rpm 40 --wind 8 --air ${models}/aerodyn/small_AeroDyn.dat --blade-elements 1 --tower-elements 1 --tolerance 1e-5)
set(goes_on "energy lost.*ok.*recorded power of generator, air against its work.*ok")
add_example_test(example_controller_elastodyn cardan 0 "controller: pitch prescribed, one period behind the demand.*${goes_on}" simulate
    ${models}/openfast/small.fst ${small_air} ${library} --controller-input follow --duration 0.5 --out example_controller_elastodyn)
add_example_test(example_controller_beamdyn cardan 0
    "controller: pitch on the spring of its bearing, 2000000 N m/rad and 5000 N m s/rad, which rests at the demand.*${goes_on}" simulate
    ${models}/openfast/small_BeamDyn.fst ${small_air} ${library} --controller-input follow --duration 0.5 --out example_controller_beamdyn)
add_example_test(example_controller_actuator cardan 0
    "controller: pitch actuator of second order, 2 Hz, damping 0.6, at most 8 deg/s, before the spring of the bearing.*energy lost.*ok"
    simulate ${small} ${driven} --controller baseline --pitch-actuator 2:0.6:8 --duration 0.5 --out example_controller_actuator)
add_example_test(example_controller_actuator_words cardan 1 "--pitch-actuator: value = 2:0; allowed: HZ.:DAMPING.:DEG/S" simulate ${small}
    --controller baseline --pitch-actuator 2:0)
add_example_test(example_controller_actuator_alone cardan 1 "--pitch-actuator: pitch frequency .rad/s. = 12[.]566[0-9]+; allowed: 0: there is no controller to follow" simulate ${small}
    --pitch-actuator 2)
add_example_test(example_controller_actuator_inertia cardan 1 "inertia of the blades about their pitch axes .kg m.2. = 0.*can be prescribed"
    simulate ${models}/openfast/small.fst ${library} --pitch-actuator 2 --rpm 40 --out example_controller_actuator_inertia)
# What a library is told of the pitch, by the option or by the model: alike, or each blade for itself.
add_example_test(example_controller_individual cardan 0 "controller: individual pitch; pitch prescribed.*energy lost.*ok" simulate ${small}
    ${driven} ${library} --controller-input individual --pitch-control individual --duration 0.2 --out example_controller_individual)
file(COPY ${models}/openfast/ DESTINATION ${test_output_dir}/individual_pitch)
file(READ ${models}/openfast/small_ServoDyn.dat servodyn)
file(WRITE ${test_output_dir}/individual_pitch/small_ServoDyn.dat "${servodyn}  1   Ptch_Cntrl   - (switch)\n")
add_example_test(example_controller_individual_model cardan 0 "controller: individual pitch; pitch prescribed" simulate
    individual_pitch/small.fst ${small_air} ${library} --controller-input individual --duration 0.1 --out example_controller_individual_model)
add_example_test(example_controller_individual_baseline cardan 1 "--pitch-control: value = individual; allowed: collective" simulate ${small}
    --controller baseline --pitch-control individual)
# What it switches, turns and says.
add_example_test(example_controller_off cardan 0 "energy lost.*ok" simulate ${small} ${driven} ${library} --controller-input off
    --duration 0.7 --out example_controller_off)
add_example_test(example_controller_warn cardan 0
    "at 0.5 s: the wind vane shakes[^a-z]*controller: at 0.5125 s: the oil is cold.*energy lost.*ok" simulate ${small} ${driven} ${library}
    --controller-input warn --duration 0.7 --out example_controller_warn)
add_example_test(example_controller_brake cardan 0 "controller: at 0.5 s: it applies the shaft brake .record 36.: the machine has none" simulate
    ${small} ${driven} ${library} --controller-input brake --duration 0.7 --out example_controller_brake)
add_example_test(example_controller_no_yaw cardan 0 "controller: at 0 s: it turns the nacelle .record 48.*--yaw driven lets it" simulate ${small}
    ${driven} ${library} --controller-input yaw --duration 0.2 --out example_controller_no_yaw)
# 0.02 rad/s: at 1 s the mean of the demands of samples 79 and 78, 0.02 0.0125 (80 + 79) / 2 rad.
add_example_test(example_controller_yaw cardan 0 "yaw prescribed.*yaw +0.019875 .*energy lost.*ok" simulate ${small} ${driven} ${library}
    --controller-input yaw --yaw driven --duration 1 --out example_controller_yaw)
add_example_test(example_controller_nan cardan 1 "controller .*: at 0.5 s it demands a generator torque of nan" simulate ${small} ${library}
    --controller-input nan --duration 1 --out example_controller_nan)
add_example_test(example_controller_fail cardan 1 "at 0.5 s it reports a failure .-1.: the pitch sensor is dead after 41 calls" simulate
    ${small} ${library} --controller-input fail --duration 1 --out example_controller_fail)
add_example_test(example_controller_library_resume cardan 1 "--resume: controller = .*allowed: baseline: a library keeps its memory" simulate
    ${small} ${library} --resume --out example_controller_library)
set_tests_properties(example_controller_library PROPERTIES FIXTURES_SETUP library_run)
set_tests_properties(example_controller_library_resume PROPERTIES FIXTURES_REQUIRED library_run)
# Torque over time.
file(WRITE ${test_output_dir}/rotor_torque.csv "time[s],torque[N m]\n0,3e6\n1,3e6\n1.2,4e6\n")
file(WRITE ${test_output_dir}/rotor_torque_back.csv "time[s],torque[N m]\n0,3e6\n0,4e6\n")
add_example_test(example_controller_rotor_torque cardan 0
    "energy lost.*ok.*recorded power of generator, rotor torque against its work.*ok" simulate ${small} --rotor-torque rotor_torque.csv
    --generator-torque 3e4 --duration 2 --out example_controller_rotor_torque)
# Bad usage.
add_example_test(example_controller_other_machine cardan 1
    "air = none: the machine has no airfoils; allowed: airfoils" simulate wt600 --controller baseline)
add_example_test(example_controller_no_library cardan 1 "no/such.so: no controller: " simulate ${small} --controller no/such.so --out
    example_controller_no_library)
add_example_test(example_controller_no_such_library cardan 1 "no controller: .*(ELF|too short)" simulate ${small} --controller
    ${CMAKE_CURRENT_LIST_FILE} --out example_controller_no_library)
add_example_test(example_controller_no_input cardan 1 "no_such_input: cannot be read" simulate ${small} ${library} --controller-input
    no_such_input)
add_example_test(example_controller_baseline_input cardan 1 "--controller-input: file = follow; allowed: only with a library" simulate
    ${small} --controller baseline --controller-input follow)
add_example_test(example_controller_period cardan 1 "--controller-period: value .s. = 0" simulate ${small} --controller baseline
    --controller-period 0)
add_example_test(example_controller_efficiency cardan 1 "--generator-efficiency: value = 94.4" simulate ${small} --controller
    baseline --generator-efficiency 94.4)
add_example_test(example_controller_locked cardan 1 "--controller: rotor = driven.*--generator free" simulate ${small} --controller
    baseline --generator locked)
add_example_test(example_controller_slope cardan 1 "--generator-slope: value = 20; allowed: none beside --controller" simulate ${small}
    --controller baseline --generator-slope 20)
add_example_test(example_controller_torque_nan cardan 1 "--rotor-torque: value .N m. = nan; allowed: finite" simulate ${small}
    --rotor-torque nan)
add_example_test(example_controller_torque_file cardan 1 "no_such.csv: cannot be read" simulate ${small} --rotor-torque no_such.csv)
add_example_test(example_controller_torque_back cardan 1 "load 'rotor torque', row 2: time .s. = 0; allowed: > 0" simulate ${small}
    --rotor-torque rotor_torque_back.csv)
