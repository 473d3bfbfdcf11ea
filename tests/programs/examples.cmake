# The short examples: what is computed, and the closed form beside it.
add_example_test(example_first_script first_script 0 "1st tower fore-aft")
add_example_test(example_double_pendulum double_pendulum 0
              "g_11 +3.946707 +3.946707.*Gamma_211 +0.358678 +0.358678.*Q_2 +-4.724639 +-4.724639.*qdd_2 +-13.991535")
add_example_test(example_slider_crank slider_crank 0
              "slider +0[.]353200 +0[.]353200.*acceleration +-1166[.]22548[0-9] +-1166[.]22548[0-9].*pin along x +-87[.]466911 +-87[.]466911")
add_example_test(example_cantilever cantilever 0 "1 +7.0255 +7.0255.*3 +123.27[0-9]+ +123.2790")
add_example_test(example_rotating_blade rotating_blade 0 "12 +20.83[0-9]+ +20.8239 +8.5973 +8.5973")
add_example_test(example_decay_test decay_test 0 "decrement +0.06283[0-9], of the damping ratio 0.062835.*frequency +1.1351")
add_example_test(example_own_state own_state 0 "a motion of the state.*4[.]0 ")
add_example_test(example_levitated_ball levitated_ball 0 "[-][0-9.]+ +[+-][0-9.]+ i +[0-9.]+e-(0[89]|1[0-9]).*gap at the end -?0[.]00")
add_example_test(example_plunger plunger 0 "position -3[.][0-9]+ mm, current (3[.]99|4[.]00).*error")
add_example_test(example_motor_arm motor_arm 0 "angle 50[.].*by hand 50[.].*residual [0-9]e-(0[89]|1[0-9])")
add_example_test(example_own_force own_force 0 "1.00 +0.482578[0-9]+ +0.48257800")
add_example_test(example_robot_arm robot_arm 0 "shoulder +-302.84 +-302.84.*modes, Hz +14.60 ")
add_example_test(example_unequal_shaft unequal_shaft 0 "2000 +0.2253 +11.5461 +11.5461 +67.1217 +67.1217")
add_example_test(example_free_yaw free_yaw 0 "chosen: two blades.*yaw .rigid. +0.0000 .* 0.0000 .* 0.0000 .*45.0 +[-0.]+[0-9]+ .0.000000 i  yaw .rigid.")
add_example_test(example_wing_flutter wing_flutter 0 "flutter +from 13[678][.].*divergence +from 25[0-4][.].*torsion.*137.335 m/s")
add_example_test(example_own_turbine own_turbine 0 "at rest: 1.22[0-9] Hz.*1st blade flap .backward.")
add_example_test(example_own_turbine_no_file own_turbine 1 "no/such.yaml: cannot be read" no/such.yaml)
add_example_test(example_loaded_beam loaded_beam 0
    "uniform +50[.]0000 +50[.]0000 +16[.]6667 +16[.]6667 +8[.]0000 +8[.]0000.*falling +13[.]3333 +13[.]3333 +4[.]1667 +4[.]1667 +2[.]6667 +2[.]6667.*outer half +42[.]7083 +42[.]7083 +14[.]5833 +14[.]5833 +6[.]0000 +6[.]0000")
add_example_test(example_end_stop end_stop 0
    "0[.]10 +0[.]006694 +0[.]006694 +-0[.]100000.*1[.]50 +0[.]043040 +0[.]043040 +-1[.]500000.*5[.]00 +0[.]121654 +0[.]121654 +-5[.]000000")
add_example_test(example_tumbling_book tumbling_book 0
    "3 +3[.]9650 +0[.](50000|49999)[0-9] +-(12[.]00000|11[.]99999)[0-9] +-0[.](20000|19999)[0-9] +0[.]500000 +-12[.]000000 +-0[.]200000.*[1-9] changes of joints")
add_example_test(example_neighbouring_motions neighbouring_motions 0
    "1[.]0 +-1[.]506010 +-1[.]5060[0-9]+ +0[.]65146141 +0[.]65146141.*2[.]0 +3[.]76735[0-9] +3[.]767[0-9]+ +1[.]2168906[0-9] +1[.]2168906[0-9]")
add_example_test(example_open_phase open_phase 0
    "0[.]04 +9[.]144[0-9] +9[.]1443 +11[.]61[67][0-9] +11[.]6168.*-0[.]08 +-25[.]16[67][0-9] +-25[.]1663 +26[.]77[01][0-9] +26[.]7714")
add_example_test(example_grid_sag grid_sag 0
    "before +0[.]250 +1722[.]130 +1722[.]130 +0[.]000.*in the sag +0[.]440 +126[78][.][0-9]+ +1267[.]611 +45[45][.][0-9]+ +454[.]519.*after +1[.]000 +1722[.]1[0-9]+ +1722[.]130 +0[.]000")
add_example_test(example_arm_torques arm_torques 0 "work 244[.]028224[0-9] J, by heights 244[.]0282248 J; one thread: the same torques")
# Means of the last 10 s; the pitch of the steady state, by harmonic balance, is 8.544 deg (cardan steady --wind 14).
add_example_test(example_wind_and_controller wind_and_controller 0
    "rotor speed, rpm +12[.]10[0-9] +12[.]100.*pitch, deg +8[.]5[45][0-9] +8[.]700.*electrical power, MW +5[.]00[0-9] +5[.]000")
add_example_test(example_emergency_stop emergency_stop 0 "5[.]000 s  grid lost\n +6[.]14[78] s  overspeed\n +17[.]92[67] s  brake")
add_example_test(example_floquet_diagram floquet_diagram 0
    "margin, 1/s +[-0-9. ]+ -0[.]2724 .*1st tower fore-aft +0[.]7025 .*1st tower side-side +0[.]7112 .*1st blade edge .symmetric. +3[.]091.*1st blade flap .symmetric. +3[.]557.*1st blade edge .antisymmetric. +3[.]44[67]")
add_example_test(example_floating_spar floating_spar 0
    "platform heave +0[.]0325 .*platform yaw +0[.]1204 .*1st tower side-side +0[.]4532 .*1st tower fore-aft +0[.]4673 .*held.*1st tower side-side +0[.]3613 .*1st tower fore-aft +0[.]3656 .*period of the pitch 30[.]")
# The converged number is that of `cardan campbell wt600`, see tests/programs/wt600_campbell.cmake.
add_example_test(example_campbell_diagram campbell_diagram 0
    "2nd blade flap .collective. +5[.]6394 .*mesh: 5 elements per blade.*at rest, Hz.*2nd blade flap .collective. +5[.]6394 +5[.]3759")
