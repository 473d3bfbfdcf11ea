add_example_test(example_assumed nrel5mw_assumed_modes 0
    "1st flap.*15 rpm +0.8983 +0.8979 +0.7591 +0.7549.*Table 1[^\n]*reached\n.*Table 2[^\n]*reached\n.*Coriolis[^\n]*reached\n.*platform:[^\n]*reached\n.*files: example_assumed_frequencies.csv"
    --elements 8 --out example_assumed)
add_example_test(example_assumed_coarse nrel5mw_assumed_modes 3 "response on the platform: [^\n]*MISSED" --elements 4 --modes 1 --out
                 example_assumed_coarse)
add_example_test(example_assumed_help nrel5mw_assumed_modes 0 "--harmonics" --help)
add_example_test(example_assumed_unknown_option nrel5mw_assumed_modes 2 "--nonsense" --nonsense)
add_example_test(example_assumed_harmonics nrel5mw_assumed_modes 2 "--harmonics" --harmonics 2)
add_example_test(example_assumed_elements nrel5mw_assumed_modes 1 "number of elements = 0; allowed: >= 1" --elements 0)
add_example_test(example_assumed_unwritable nrel5mw_assumed_modes 1 "the folder 'no/such/folder' does not exist" --out no/such/folder/x)
