add_example_test(example_nrel5mw nrel5mw_campbell 0
    "1st Tower FA.*beside OpenFAST.*12.1 rpm.*1st Blade Flap .Regressive.*files: example_nrel5mw.h5" --rpm 0,12.1 --blade-elements 3
    --tower-elements 3 --max-frequency 3 --modes --out example_nrel5mw)
add_example_test(example_nrel5mw_gravity nrel5mw_campbell 0 "mean over the azimuth.*1st Tower FA.*6 rpm.*gravity.*the mean leaves out.*_families.png" --gravity --variant beamdyn --rpm 0,6
                 --blade-elements 2 --tower-elements 2 --out example_nrel5mw_gravity)
add_example_test(example_nrel5mw_free nrel5mw_campbell 0 "1st blade flap .backward.*files" --generator-free --variant fast --names descriptive
                 --rpm 0:12:4,13 --blade-elements 2 --tower-elements 2 --undamped --out example_nrel5mw_free)
add_example_test(example_nrel5mw_large nrel5mw_campbell 0 "lengths times 1.73205" --power 15 --rpm 6 --pitch-actuator --summary
                 --blade-elements 3 --tower-elements 2 --out example_nrel5mw_large)
add_example_test(example_nrel5mw_tower nrel5mw_campbell 0 "tower alone.*1st Tower FA.*2nd Tower SS.*1st Tower Torsion +1[12][.][0-9]+ [(]  1.00[)].*under gravity.*tower with a rigid top.*1st Tower FA.*1st Tower Torsion +1.4[0-9]+ [(]  0.1[0-9][)]" --tower
                 --tower-elements 3 --blade-elements 1)
add_example_test(example_nrel5mw_help nrel5mw_campbell 0 "--variant" --help)
add_example_test(example_nrel5mw_unknown_option nrel5mw_campbell 2 "--nonsense" --nonsense)
add_example_test(example_nrel5mw_variant nrel5mw_campbell 2 "--variant" --variant hawc2)
add_example_test(example_nrel5mw_gravity_free nrel5mw_campbell 2 "excludes --g" --gravity --generator-free)
add_example_test(example_nrel5mw_bad_rpm nrel5mw_campbell 1 "--rpm: value = 0:x:1; allowed: numbers and FIRST:LAST:STEP" --rpm 0:x:1)
add_example_test(example_nrel5mw_two_rpm nrel5mw_campbell 1 "--rpm: value = 0:5; allowed" --rpm 0:5)
add_example_test(example_nrel5mw_falling_rpm nrel5mw_campbell 1 "FIRST <= LAST" --rpm 6:0:1 --blade-elements 1)
add_example_test(example_nrel5mw_elements nrel5mw_campbell 1 "number of elements = 0; allowed: 1 ... 1000" --blade-elements 0)
add_example_test(example_nrel5mw_power nrel5mw_campbell 1 "--power: value .MW. = -15; allowed: finite and > 0" --power=-15)
add_example_test(example_nrel5mw_unwritable nrel5mw_campbell 1 "the folder 'no/such/folder' does not exist" --blade-elements 1 --out
                 no/such/folder/x)
add_example_test(example_nrel5mw_no_data nrel5mw_campbell 1 "no_such_folder/nrel5mw_blade.csv: cannot be read" --data no_such_folder)
