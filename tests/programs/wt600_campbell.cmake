add_example_test(example_wt600 wt600_campbell 0 "files: example_wt600.h5" --rpm 0:30:15 --out example_wt600 --modes)
add_example_test(example_wt600_frozen wt600_campbell 0 "warning: frozen azimuth" --rpm 0:30:15 --frozen-azimuth --undamped
                 --shaft-beam --generator locked --blade-elements 2 --tower-elements 2 --out example_frozen)
add_example_test(example_wt600_slip wt600_campbell 0 "1st drive-train torsion +1.4286 . 52.14. . +1.4290 . 52.24. ." --rpm 0:27:27
                 --generator slip --paper --out example_wt600_slip)
# One number for library, command, program and example: that of tests/turbines/reference_turbines/wt600/test_wt600_default_mesh and of
# examples.cmake.
add_example_test(example_wt600_mesh wt600_campbell 0 "2nd blade flap .collective. +5[.]6394 .*mesh: 5 elements per blade, 3 in the tower; " --rpm 0
                 --out example_wt600_mesh)
add_example_test(example_wt600_mesh_command cardan 0 "2nd blade flap .collective. +5[.]6394 .*mesh: 5 elements per blade, 3 in the tower; " campbell wt600
                 --rpm 0 --out example_wt600_mesh_command)
add_example_test(example_wt600_paper wt600_campbell 0 "elements of the paper.*2nd blade flap .collective. +5[.]3759 .*mesh: 3 elements per blade, 3 in the tower, as given"
                 --rpm 0 --paper --out example_wt600_paper)
add_example_test(example_wt600_paper_excludes wt600_campbell 2 "excludes" --paper --blade-elements 4)
add_example_test(example_wt600_generator wt600_campbell 2 "--generator" --generator grid)
add_example_test(example_wt600_generator_torque wt600_campbell 1 "--generator-torque: value .N m. = 100; allowed: 0, or --generator slip"
                 --generator-torque 100)
add_example_test(example_one_speed wt600_campbell 0 "files: example_one_speed.h5, .csv, .svg, .png\n" --rpm 0 --blade-elements 1
                 --tower-elements 1 --out example_one_speed)
add_example_test(example_help wt600_campbell 0 "--blade-elements" --help)
add_example_test(example_unknown_option wt600_campbell 2 "--nonsense" --nonsense)
add_example_test(example_bad_rpm wt600_campbell 1 "--rpm: value = 0:x:1; allowed: numbers and FIRST:LAST:STEP" --rpm 0:x:1)
add_example_test(example_nan_rpm wt600_campbell 1 "FIRST:LAST:STEP" --rpm 0:nan:1)
add_example_test(example_endless_rpm wt600_campbell 1 "at most 100000" --rpm 0:40:1e-320)
add_example_test(example_negative_rpm wt600_campbell 1 ">= 0, FIRST <= LAST" --rpm=-10:10:5)
add_example_test(example_max_frequency wt600_campbell 1 "largest frequency" --rpm 0 --max-frequency 0)
add_example_test(example_unwritable wt600_campbell 1 "the folder 'no/such/folder' does not exist" --rpm 0 --out no/such/folder/x)
string(REPEAT long_name_ 40 long_name)
add_example_test(example_long_folder wt600_campbell 1 "File name too long" --rpm 0 --out ${long_name}/x)
add_example_test(example_long_file wt600_campbell 1 "File name too long" --rpm 0 --out ${long_name})
add_example_test(example_no_file_name wt600_campbell 1 "ends in a file name" --rpm 0 --out ./)
add_example_test(example_no_data wt600_campbell 1 "no_such_folder/wt600_[a-z]+.csv: cannot be read" --data no_such_folder)
add_example_test(example_gravity_in_rotation wt600_campbell 1 "--gravity: rotor speed .rev.min. = 10; allowed: 0, or --floquet" --gravity --rpm 10)
add_example_test(example_elements wt600_campbell 1 "number of elements = 0; allowed: 1 ... 1000" --blade-elements 0)
add_example_test(example_wt600_floquet wt600_campbell 0
    "stability margin.*Floquet .principal frequencies.*against Coleman.*mean over the azimuth.*1st tower fore-aft.*files: .*example_floquet.*_difference.svg"
    --floquet --gravity --rpm 0:24:12 --blade-elements 1 --tower-elements 1 --out example_floquet)
add_example_test(example_wt600_floquet_frozen wt600_campbell 2 "--frozen-azimuth excludes --floquet" --floquet --frozen-azimuth)
