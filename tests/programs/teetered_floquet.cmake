set(one_beam_each --blade-elements 1 --tower-elements 1)
add_example_test(example_machine teetered_floquet 0
    "yaw .rigid.*teeter .locked at 1 per rev and growing.*1st blade flap .antisymmetric.*files: example_machine.h5, .csv, _harmonics.csv, .svg, .png"
    ${one_beam_each} --max 12 --out example_machine)
add_example_test(example_machine_rigid teetered_floquet 0 "1st blade flap .symmetric. +3.40.* 3.4015 .* 0.802 .*goal.*mode shapes in" --rigid-tower
                 --max 12 --modes --out example_machine_rigid)
add_example_test(example_machine_goals teetered_floquet 0 "second modes .*: reached" --no-pictures --out example_machine_goals)
set_tests_properties(example_machine_goals PROPERTIES LABELS slow)
add_example_test(example_machine_other teetered_floquet 0 "4.5 rad/s.*files: example_machine_other.h5, .csv, _harmonics.csv\n" ${one_beam_each}
                 --speed 4.5 --tower-ratio 30 --no-teeter --max 12 --no-pictures --out example_machine_other)
add_example_test(example_machine_gravity teetered_floquet 0 "1st tower fore-aft +0.69.*1st blade flap .antisymmetric.*files: example_machine_gravity.h5" ${one_beam_each} --gravity
                 --harmonics 9 --max 12 --no-pictures --out example_machine_gravity)
add_example_test(example_machine_help teetered_floquet 0 "--tower-ratio" --help)
add_example_test(example_machine_unknown_option teetered_floquet 2 "--nonsense" --nonsense)
add_example_test(example_machine_excludes teetered_floquet 2 "--tower-ratio excludes --rigid-tower" --rigid-tower --tower-ratio 10)
add_example_test(example_machine_speed teetered_floquet 1 "--speed: value .rad/s. = 0; allowed: > 0" --speed 0)
add_example_test(example_machine_ratio teetered_floquet 1 "ratio of tower to blade rigidity = -2; allowed: finite and > 0" --tower-ratio=-2)
add_example_test(example_machine_max teetered_floquet 1 "--max: frequency per revolution = -1; allowed: > 0" --max=-1)
add_example_test(example_machine_elements teetered_floquet 1 "number of elements = 0" --blade-elements 0)
add_example_test(example_machine_unwritable teetered_floquet 1 "the folder 'no/such' does not exist" --out no/such/x)
