set(arm6 ${PROJECT_SOURCE_DIR}/examples/data/arm6.urdf)
add_example_test(example_inspect urdf_inspect 0 "robot 'arm6'.*waist.*revolute.*metric at q.*natural modes"
              ${arm6} --write arm6_written.urdf)
add_example_test(example_inspect_written urdf_inspect 0 "robot 'arm6'.*natural modes" arm6_written.urdf)
set_tests_properties(example_inspect PROPERTIES FIXTURES_SETUP arm6_written)
set_tests_properties(example_inspect_written PROPERTIES FIXTURES_REQUIRED arm6_written)
add_example_test(example_inspect_pose urdf_inspect 0 "100 % elbow" ${arm6} --q elbow=0.5 --q wrist_pitch=-0.3
              --stiffness 1e9 --stiffness elbow=1000 --undamped --modes 1)
add_example_test(example_inspect_free urdf_inspect 0 "none oscillates" ${arm6} --stiffness 0)
add_example_test(example_inspect_help urdf_inspect 0 "--stiffness" --help)
add_example_test(example_inspect_unknown_option urdf_inspect 2 "--nonsense" ${arm6} --nonsense)
add_example_test(example_inspect_modes urdf_inspect 1 "--modes: value = 0; allowed: finite and > 0" --modes 0)
add_example_test(example_inspect_no_file_given urdf_inspect 2 "FILE is required")
add_example_test(example_inspect_no_file urdf_inspect 1 "no/such.urdf: cannot be read: No such file" no/such.urdf)
add_example_test(example_inspect_not_urdf urdf_inspect 1 "[.]cmake:.*is not XML" ${CMAKE_CURRENT_LIST_FILE})
add_example_test(example_inspect_coordinate urdf_inspect 1 "unknown coordinate 'knee'" ${arm6} --q knee=1)
add_example_test(example_inspect_value urdf_inspect 1 "--q: value = elbow=x; allowed: COORDINATE=NUMBER"
              ${arm6} --q elbow=x)
add_example_test(example_inspect_stiffness urdf_inspect 1 "'elbow spring'.*-1" ${arm6} --stiffness=elbow=-1)
add_example_test(example_inspect_unwritable urdf_inspect 1 "the folder 'no/such' does not exist"
              ${arm6} --write no/such/x.urdf)
