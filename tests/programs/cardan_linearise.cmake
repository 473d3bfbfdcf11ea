# Linear models of any machine. Modes, or exponents of the periodic A, beside those of the Campbell diagram.
set(models ${CMAKE_CURRENT_SOURCE_DIR}/data)
set(coarse --blade-elements 1 --tower-elements 1)
add_example_test(example_turbine_linear_wt600 cardan 0
    "generator and yaw bearing free\n.*7 inputs, 20 outputs, 12 azimuths.*modes of A and of the Campbell.* 1.9[0-9]+ +[0-9.]+ +1.9[0-9]+ +[0-9.]+  1st blade flap.*1st drive-train torsion.*balanced model: order 46 and 2 .*yaw moment +[0-4].[0-9]+ %.*pitch moment .collective. +[0-4].[0-9]+ %.*example_turbine_linear_wt600.1.lin ... 12 files" linearise
    wt600 --lin --rpm 27 --azimuths 12 --blade-elements 3 --tower-elements 3 --out example_turbine_linear_wt600)
add_example_test(example_turbine_linear_still cardan 0 "at 0 rpm: .* 1 azimuths.*1st tower fore-aft\n.*balanced model: order [0-9]+ and 2 .*1 files" linearise
    wt600 --lin --rpm 0 ${coarse} --out example_turbine_linear_still)
add_example_test(example_turbine_linear_nrel5mw cardan 0
    "at 12.1 rpm.*24 azimuths.*A [0-9.]+e-1[0-9].*balanced model: order 8 and 2 .*files: example_turbine_linear_nrel5mw.h5, .mat" linearise nrel5mw ${coarse} --order 8 --out
    example_turbine_linear_nrel5mw)
# Equal to rounding with 48 azimuths; the series converges as fast as the exponents do.
set(equal "[^\n]* +[0-9.]+e-1[0-9]  ")
add_example_test(example_turbine_linear_teetered cardan 0
    "two blades: the model is periodic[^\n]*48 azimuths[^\n]*frozen at the azimuth 30 deg.*\n${equal}1st tower side-side\n${equal}teeter .locked at 1 per rev and (decaying|growing).\n${equal}teeter .locked at 1 per rev and (growing|decaying).\n${equal}1st blade edge .symmetric.\n.*48 files" linearise
    teetered --lin --azimuths 48 --azimuth 33 --blade-elements 2 --tower-elements 2 --out example_turbine_linear_teetered)
add_example_test(example_turbine_linear_gravity cardan 0 "two blades.*\n${equal}1st tower side-side\n" linearise
    teetered --gravity --yaw locked --azimuths 48 ${coarse} --max-frequency 3 --out example_turbine_linear_gravity)
add_example_test(example_turbine_linear_missing cardan 0
    "blades that differ: the model is periodic.*\n${equal}1st tower fore-aft\n.*\n${equal}1st blade flap .antisymmetric.\n" linearise missing_blade.yaml
    --azimuths 48 ${coarse} --out example_turbine_linear_missing)
add_example_test(example_turbine_linear_missing_still cardan 0
    "1 azimuths.*the model is constant.*1st tower fore-aft.*balanced model.*1 files" linearise missing_blade.yaml --lin --rpm 0 ${coarse} --out
    example_turbine_linear_missing_still)
add_example_test(example_turbine_linear_hub_alone cardan 0
    "the model is constant.* 1.3235[0-9]+ +0.5000 +1.3235[0-9]+ +0.5000  1st tower fore-aft" linearise hub_alone.yaml
    --max-frequency 10 --out example_turbine_linear_hub_alone)
add_example_test(example_turbine_linear_openfast cardan 0
    "generator locked.* rpm: [0-9]+ states, 3 inputs, 17 outputs.*modes of A and of.*1st tower fore-aft\n.*balanced model: order [0-9]+ and 0 " linearise
    ${models}/openfast/small.fst ${coarse} --generator locked --out example_turbine_linear_openfast)
add_example_test(example_turbine_linear_openfast_gravity cardan 0 "periodic remainder.*modes of A\n.*order 4 and 0 " linearise ${models}/openfast/small.fst
    ${coarse} --gravity --generator locked --order 4 --out example_turbine_linear_openfast_gravity)
# Bad usage.
add_example_test(example_turbine_linear_help cardan 0 "--azimuths.*  teetered  " linearise --help)
add_example_test(example_turbine_linear_no_machine cardan 2 "model is required" linearise)
add_example_test(example_turbine_linear_unknown cardan 1 "machine: name = wt60; allowed: wt600, teetered" linearise wt60)
add_example_test(example_turbine_linear_unknown_option cardan 2 "--nonsense" linearise wt600 --nonsense)
add_example_test(example_turbine_linear_rpm cardan 1 "--rpm: value = -1; allowed: >= 0" linearise wt600 --rpm=-1)
add_example_test(example_turbine_linear_azimuths cardan 1 "number of azimuths = 2; allowed: 3 or more" linearise teetered --azimuths 2
                 --out example_turbine_linear_azimuths)
add_example_test(example_turbine_linear_error cardan 1 "--error: value .%. = nan; allowed: finite and > 0" linearise wt600 --error nan)
add_example_test(example_turbine_linear_order cardan 1 "order = 1000; allowed: 0 ... [0-9]+" linearise wt600 --order 1000 ${coarse} --azimuths 4
                 --out example_turbine_linear_order)
# At once: neither modes nor those of twice as many elements are computed before.
add_example_test(example_turbine_linear_many_elements cardan 1
    "mesh: 80 elements per blade, 80 in the tower, too many to be compared with twice as many\n.*number of unknowns = 1850; allowed: <= 1500 .all eigenvalues of a full matrix.*take fewer elements per part"
    linearise wt600 --blade-elements 80 --tower-elements 80 --out example_turbine_linear_many_elements)
add_example_test(example_turbine_linear_unwritable cardan 1 "the folder 'no/such' does not exist" linearise wt600 --out no/such/x)
