# The 600 kW machine in time.
set(coarse --blade-elements 1 --tower-elements 1)
add_example_test(example_time_fixed wt600_time_history 0
              "connected at synchronous speed.*3P.*generator torque.*against the balance of torques.*ok" ${coarse}
              --mode fixed --pitch-rate 6 --duration 40 --tolerance 1e-5 --step 0.05 --out example_time_fixed)
add_example_test(example_time_variable wt600_time_history 0 "variable speed.*against the balance of torques.*ok"
              ${coarse} --mode variable --pitch-rate 6 --duration 60 --tolerance 1e-5 --step 0.05 --out
              example_time_variable)
# The speed has not settled yet: a check that does not hold is the exit code.
add_example_test(example_time_short wt600_time_history 1 "against the balance of torques[^\n]* FAILED" ${coarse} --mode variable
              --pitch-rate 6 --duration 31 --tolerance 1e-5 --step 0.05 --out example_time_short)
add_example_test(example_time_platform wt600_time_history 0
              "energy lost.*ok.*platform's drives.*ok.*example_time_platform.h5.*, _energy.png, _spectrum.png" ${coarse} --surge
              amplitude=1,period=8,phase=20 --heave velocity=0.5 --pitch mean=-2,amplitude=1,period=5 --duration 15 --tolerance 1e-5
              --out example_time_platform)
add_example_test(example_time_revolutions wt600_time_history 1 "--surge: revolutions of a rotor at = 0 rpm or at changing speed"
              --surge amplitude=1,revolutions=2)
add_example_test(example_time_alpha wt600_time_history 0 "fixed speed.*ok.*ok" --method alpha --duration 5
              --tolerance 1e-6 --out example_time_alpha)
# Connected within the first stretch: the second one must know.
set(resumed ${coarse} --mode fixed --pitch-rate 6 --tolerance 1e-5 --step 0.05 --out example_time_resume)
add_example_test(example_time_begin wt600_time_history 0 "connected at synchronous speed.*ok" ${resumed} --duration 25)
add_example_test(example_time_resume wt600_time_history 0
              "connected at synchronous speed.*against the balance of torques.*ok.*files: [^ ]* .801 samples" ${resumed}
              --duration 40 --resume)
add_example_test(example_time_resume_other wt600_time_history 1
              "--resume: run of example_time_resume.h5 = .*; allowed: that of this run: .*9 m/s"
              ${resumed} --duration 41 --resume --wind 9)
add_example_test(example_time_resume_none wt600_time_history 1 "no_such_run.h5" --resume --out no_such_run)
set_tests_properties(example_time_begin PROPERTIES FIXTURES_SETUP begun_run)
set_tests_properties(example_time_resume PROPERTIES FIXTURES_REQUIRED begun_run FIXTURES_SETUP resumed_run)
set_tests_properties(example_time_resume_other PROPERTIES FIXTURES_REQUIRED "begun_run;resumed_run")
add_example_test(example_time_help wt600_time_history 0 "--pitch-rate" --help)
add_example_test(example_time_mode wt600_time_history 2 "--mode" --mode both)
add_example_test(example_time_method wt600_time_history 2 "--method" --method euler)
add_example_test(example_time_duration wt600_time_history 1 "--duration: value = -1" --duration=-1)
add_example_test(example_time_step wt600_time_history 1 "--step: value = 0" --step 0)
add_example_test(example_time_order wt600_time_history 1 "highest order = 9; allowed: 0 ... 5" --method bdf --order 9)
add_example_test(example_time_unwritable wt600_time_history 1 "the folder 'no/such' does not exist" --out no/such/x)
add_example_test(example_time_no_data wt600_time_history 1 "no_such_folder/wt600_[a-z]+.csv: cannot be read" --data
              no_such_folder)
add_example_test(example_time_resume_help wt600_time_history 0 "bit for bit with dirk, erk and alpha, within the tolerance" --help)
foreach(tolerance nan inf -1)
    add_example_test(example_time_tolerance_${tolerance} wt600_time_history 1 "relative tolerance = ${tolerance}; allowed: finite and > 0"
                  --tolerance=${tolerance} --duration 1 --out example_time_tolerance_${tolerance})
endforeach()
add_test(NAME example_time_interrupted COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/programs/interrupted_runs.sh
         $<TARGET_FILE:wt600_time_history> $<TARGET_FILE:cardan> --mode fixed --pitch-rate 6 ${coarse}
         --tolerance 1e-5 --step 0.05 WORKING_DIRECTORY ${test_output_dir})
