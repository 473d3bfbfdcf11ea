add_example_test(example_linear wt600_linear_model 0
    "7 inputs, 20 outputs, 12 azimuths.*modes of A and of the Campbell.*1st drive-train torsion.*balanced model: order 56 and 2 .*yaw moment +[0-4].[0-9]* %.*pitch moment .collective. +[0-4].[0-9]* %.*example_linear.1.lin ... 12 files"
    --lin --blade-elements 3 --tower-elements 3 --out example_linear)
set_tests_properties(example_linear PROPERTIES FIXTURES_SETUP linear_wt600)
add_example_test(example_linear_gravity wt600_linear_model 0 "periodic remainder.*modes of A\n.*order 6 and 0 " --gravity --rpm 20
                 --azimuths 9 --order 6 --generator locked --blade-elements 1 --tower-elements 1 --out example_linear_gravity)
add_example_test(example_linear_still wt600_linear_model 0 "1 azimuths.*1 files" --lin --rpm 0 --blade-elements 1 --tower-elements 1
                 --out example_linear_still)
add_example_test(example_linear_slip wt600_linear_model 0 "5[0-3].[0-9]* .*1st drive-train torsion.*order 16 and 1 states that are not stable"
                 --generator slip --order 16 --blade-elements 3 --tower-elements 3 --out example_linear_slip)
add_example_test(example_linear_error wt600_linear_model 1 "--error: value .%. = nan; allowed: finite and > 0" --error nan)
add_example_test(example_linear_help wt600_linear_model 0 "--azimuths" --help)
add_example_test(example_linear_unknown_option wt600_linear_model 2 "--nonsense" --nonsense)
add_example_test(example_linear_rpm wt600_linear_model 1 "--rpm: value = -1; allowed: >= 0" --rpm=-1)
add_example_test(example_linear_azimuths wt600_linear_model 1 "number of azimuths = 2; allowed: >= 3" --azimuths 2)
add_example_test(example_linear_order wt600_linear_model 1 "order = 1000" --order 1000 --blade-elements 1 --tower-elements 1
                 --azimuths 4)
add_example_test(example_linear_blade_azimuths wt600_linear_model 1 "number of azimuths = 6; allowed: one at which" --azimuths 6
                 --blade-elements 1 --tower-elements 1)
add_example_test(example_linear_unwritable wt600_linear_model 1 "the folder 'no/such' does not exist" --out no/such/x)
add_example_test(example_linear_many_elements wt600_linear_model 1
    "number of unknowns = [0-9]+; allowed: <= 1500 .all eigenvalues of a full matrix.*take fewer elements per part"
    --blade-elements 80 --tower-elements 80 --out example_linear_many_elements)
