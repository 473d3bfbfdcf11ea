add_example_test(example_arm urdf_arm 0 "all checks hold" --write arm6_flexible.urdf)
add_example_test(example_arm_pose urdf_arm 0 "all checks hold" --q shoulder=0.4 --q elbow=-0.9 --q wrist_pitch=1.2
              --elements 2 --stiffness wrist_roll=50000)
add_example_test(example_arm_help urdf_arm 0 "--elements" --help)
add_example_test(example_arm_unknown_option urdf_arm 2 "--nonsense" --nonsense)
add_example_test(example_arm_elements urdf_arm 1 "number of elements = 0; allowed: >= 1" --elements 0)
add_example_test(example_arm_factor urdf_arm 1 "--youngs-factor: value = 0; allowed: finite and > 0" --youngs-factor 0)
add_example_test(example_arm_coordinate urdf_arm 1 "unknown coordinate 'knee'" --q knee=1)
add_example_test(example_arm_no_file urdf_arm 1 "no/such.urdf: cannot be read" --file no/such.urdf)
