# The short examples: what is computed, and the closed form beside it.
add_example_test(example_first_script first_script 0 "1st tower fore-aft")
add_example_test(example_double_pendulum double_pendulum 0
              "g_11 +3.946707 +3.946707.*Gamma_211 +0.358678 +0.358678.*Q_2 +-4.724639 +-4.724639.*qdd_2 +-13.991535")
add_example_test(example_cantilever cantilever 0 "1 +7.0255 +7.0255.*3 +123.27[0-9]+ +123.2790")
add_example_test(example_rotating_blade rotating_blade 0 "12 +20.83[0-9]+ +20.8239 +8.5973 +8.5973")
add_example_test(example_decay_test decay_test 0 "decrement +0.06283[0-9], of the damping ratio 0.062835.*frequency +1.1351")
add_example_test(example_own_state own_state 0 "a motion of the state.*4[.]0 ")
add_example_test(example_own_force own_force 0 "1.00 +0.482578[0-9]+ +0.48257800")
add_example_test(example_robot_arm robot_arm 0 "shoulder +-302.84 +-302.84.*modes, Hz +14.60 ")
add_example_test(example_unequal_shaft unequal_shaft 0 "2000 +0.2253 +11.5461 +11.5461 +67.1217 +67.1217")
add_example_test(example_free_yaw free_yaw 0 "chosen: two blades.*yaw .rigid. +0.0000 .* 0.0000 .* 0.0000 .*45.0 +[-0.]+[0-9]+ .0.000000 i  yaw .rigid.")
add_example_test(example_own_turbine own_turbine 0 "at rest: 1.22[0-9] Hz.*1st blade flap .backward.")
add_example_test(example_own_turbine_no_file own_turbine 1 "no/such.yaml: cannot be read" no/such.yaml)
