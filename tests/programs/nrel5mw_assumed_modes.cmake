add_example_test(example_assumed nrel5mw_assumed_modes 0
    "Modes .FAST. +ADAMS +paper's model +its functions +the same untwisted +converged\n1st flap +0.6830 +0.6745 +0.6824 +0.6822 +0.6819 +0.6772\n1st edge +1.0968 +1.1033 +1.0925 +1.0924 +1.0958 +1.0855\n2nd flap +1.9909 +1.8394 +1.9921 +1.9911 +1.9857 +1.9516\n2nd edge +4.0714 +3.8997 +4.0464 +4.0452 +4.0637 +3.9963\n.*15 rpm +0.8983 +0.8979 +0.7591 +0.7549.*Table 1[^\n]*reached\n.*Table 2[^\n]*reached\n.*Coriolis[^\n]*reached\n.*platform:[^\n]*reached\n.*files: example_assumed_frequencies.csv"
    --elements 8 --out example_assumed)
add_example_test(example_assumed_coarse nrel5mw_assumed_modes 3 "response on the platform: [^\n]*MISSED" --elements 4 --modes 1 --out
                 example_assumed_coarse)
add_example_test(example_assumed_other_functions nrel5mw_assumed_modes 0
    "functions given: 7 polynomials for v and w each on each of 2 equal pieces, 4 polynomials for torsion on each of 2 equal pieces; they are not the paper's.*0 rpm +0.6824 +0.6781 +0.6781 +0.6772.*Table 1[^\n]*not judged.*Table 2[^\n]*not judged.*Coriolis[^\n]*reached\n.*functions given .*platform:[^\n]*reached\n"
    --bending 7 --torsion 4 --torsion-by polynomials --pieces 2 --elements 4 --out example_assumed_other_functions)
add_example_test(example_assumed_bending nrel5mw_assumed_modes 1 "--bending: polynomials per piece = 10; allowed: 2 ... 9" --bending 10)
add_example_test(example_assumed_sines nrel5mw_assumed_modes 1 "--torsion: sines = 41; allowed: 1 ... 40" --torsion 41)
add_example_test(example_assumed_torsion nrel5mw_assumed_modes 1 "--torsion: polynomials per piece = 10; allowed: 1 ... 9" --torsion 10
                 --torsion-by polynomials)
add_example_test(example_assumed_torsion_by nrel5mw_assumed_modes 2 "--torsion-by: cosines not in" --torsion-by cosines)
add_example_test(example_assumed_pieces nrel5mw_assumed_modes 1 "--pieces: number = 49; allowed: 0 ... 48" --pieces 49)
add_example_test(example_assumed_help nrel5mw_assumed_modes 0 "--harmonics" --help)
add_example_test(example_assumed_unknown_option nrel5mw_assumed_modes 2 "--nonsense" --nonsense)
add_example_test(example_assumed_harmonics nrel5mw_assumed_modes 2 "--harmonics" --harmonics 2)
add_example_test(example_assumed_elements nrel5mw_assumed_modes 1 "number of elements = 0; allowed: >= 1" --elements 0)
add_example_test(example_assumed_unwritable nrel5mw_assumed_modes 1 "the folder 'no/such/folder' does not exist" --out no/such/folder/x)
