add_example_test(example_blade nrel5mw_blade_modes 0 "files: example_blade.csv.*0.1 %: reached" --out example_blade)
add_example_test(example_blade_refined nrel5mw_blade_modes 0 "0.5 %: reached" --refined --rpm 0,12.1 --out example_blade_refined)
add_example_test(example_blade_convergence nrel5mw_blade_modes 0 "segment masses, equal elements, 12.1 rpm.*static moments" --convergence
               --rpm 12.1)
add_example_test(example_blade_convergence_others nrel5mw_blade_modes 0 "compliance Gauss points, equal elements.*mean differences, equal"
               --convergence --rpm 0)
add_example_test(example_blade_gauss nrel5mw_blade_modes 0 "4 elements, compliance Gauss points" --partition gauss --elements 4 --rpm 0
               --out example_blade_gauss)
add_example_test(example_blade_mean nrel5mw_blade_modes 0 "4 elements, mean differences" --partition mean-difference --elements 4 --rpm 12
               --out example_blade_mean)
add_example_test(example_blade_too_fast nrel5mw_blade_modes 0 "warning: 24 rpm is above half of the 31" --partition mean-difference
               --elements 2 --rpm 24 --out example_blade_fast)
add_example_test(example_blade_delta_unused nrel5mw_blade_modes 2 "--delta excludes --partition gauss" --partition gauss --delta 0.2)
add_example_test(example_blade_condensed nrel5mw_blade_modes 0 "0.7290.*1.0943" --no-extension --rpm 12.1 --out example_blade_condensed)
add_example_test(example_blade_other nrel5mw_blade_modes 0 "delta 0.166667, static moments.* - +[|] +-" --partition static --elements 12
    --mass-factor 1 --shear-ratio 20 --no-mass-offset --rpm 3,15 --out example_blade_other)
add_example_test(example_blade_boundaries nrel5mw_blade_modes 0 "ends, m from the root: 0 20 40 50 61.5" --boundaries 0,20,40,50,61.5 --rpm 0 --out
    example_blade_boundaries)
add_example_test(example_blade_delta_given nrel5mw_blade_modes 0 "delta 0.2, segment masses" --delta 0.2 --rpm 0 --out example_blade_delta)
add_example_test(example_blade_negative_inertia nrel5mw_blade_modes 1 "inertia .* = -.*; allowed: >= 0" --partition static --delta 0.2
               --elements 12)
add_example_test(example_blade_help nrel5mw_blade_modes 0 "--partition" --help)
add_example_test(example_blade_unknown_option nrel5mw_blade_modes 2 "--nonsense" --nonsense)
add_example_test(example_blade_bad_partition nrel5mw_blade_modes 2 "--partition" --partition both)
add_example_test(example_blade_refined_excludes nrel5mw_blade_modes 2 "--refined" --refined --elements 8)
add_example_test(example_blade_bad_rpm nrel5mw_blade_modes 1 "--rpm: value = 0,x; allowed: numbers" --rpm 0,x)
add_example_test(example_blade_falling_rpm nrel5mw_blade_modes 1 "increasing" --rpm 6,0)
add_example_test(example_blade_nan_rpm nrel5mw_blade_modes 1 "--rpm: value = nan" --rpm nan)
add_example_test(example_blade_bad_boundaries nrel5mw_blade_modes 1 "from 0 to the length 61.5" --boundaries 0,60)
add_example_test(example_blade_elements nrel5mw_blade_modes 1 "number of elements = 0; allowed: >= 1" --elements 0)
add_example_test(example_blade_delta nrel5mw_blade_modes 1 "delta = 0.5; allowed: 0 < delta < 0.5" --delta 0.5)
add_example_test(example_blade_delta_zero nrel5mw_blade_modes 1 "--delta: value = 0; allowed: 0 < delta < 0.5" --delta 0)
add_example_test(example_blade_mass_factor nrel5mw_blade_modes 1 "mass factor = -1; allowed: finite and > 0" --mass-factor=-1)
add_example_test(example_blade_unwritable nrel5mw_blade_modes 1 "the folder 'no/such/folder' does not exist" --out no/such/folder/x)
add_example_test(example_blade_no_data nrel5mw_blade_modes 1 "no_such_folder/nrel5mw_blade.csv: cannot be read" --data no_such_folder)
