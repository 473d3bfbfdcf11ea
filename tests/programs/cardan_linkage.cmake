# A machine whose blades are pitched by actuators with push rods and cranks: loops in all commands. Frequencies are those
# of springs of 9.5614e6 N m/rad in the bearings of the blades, k (dz/dphi)^2 from geometry, but for 3 kg of actuators:
# 3.3448, 5.5392, 14.1368 Hz.
file(READ ${PROJECT_SOURCE_DIR}/examples/data/own_turbine.yaml own_turbine)
string(REPLACE "  pitch: rigid\n" "  pitch: free\n  linkage:\n    crank_pin: [0.1, 0.5, 0.2]\n    actuator_pin: [0, 0.45, -0.9]\n    direction: [0.1, 0, 1]\n    actuator: {stiffness: 4.0e+7, damping: 1.0e+5}\n    mass: 1\n"
       linked_pitch "${own_turbine}")
file(WRITE ${test_output_dir}/linked_pitch.yaml "${linked_pitch}")
set(coarse --blade-elements 2 --tower-elements 1)
add_example_test(example_linkage_campbell cardan 0
    "1st blade flap .sine. +3[.]34[45].*1st blade edge .sine. +5[.]539.*2nd blade flap .cosine. +14[.]13[67].*mesh: [5-9] elements" campbell
    linked_pitch.yaml --rpm 0 --out example_linkage_campbell)
add_example_test(example_linkage_modes cardan 0 "1st blade edge .forward.*files" modes linked_pitch.yaml --rpm 20 ${coarse} --out example_linkage_modes)
add_example_test(example_linkage_simulate cardan 0 "energy lost.*ok" simulate linked_pitch.yaml ${coarse} --duration 1 --out example_linkage_simulate)
add_example_test(example_linkage_steady cardan 0 "blade 1 root moment y.*files" steady linked_pitch.yaml --rpm 20 ${coarse} --out example_linkage_steady)
add_example_test(example_linkage_linearise cardan 0 "modes of A and of the Campbell.*24 files" linearise linked_pitch.yaml --lin --rpm 20 ${coarse}
                 --out example_linkage_linearise)
