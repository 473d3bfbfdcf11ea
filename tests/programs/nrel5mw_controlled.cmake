# The NREL 5 MW machine under its controller.
set(small_controlled --blade-elements 1 --tower-elements 1)
add_example_test(example_controlled_steps nrel5mw_controlled 0
    "time, s +wind.*30.0 +13.0 +12.10.*60.0 +13.5 +12.[01].*energy lost.*ok.*files: example_controlled.h5" steps ${small_controlled} --winds 13,13.5
    --every 30 --out example_controlled)
add_example_test(example_controlled_not_settled nrel5mw_controlled 3 "9.0 .*not settled" steps ${small_controlled} --winds 8,9 --every 5
    --out example_controlled_short)
add_example_test(example_controlled_loop nrel5mw_controlled 0 "gains alone.*15.0 +10.45 +0.58.*eigenvalue.*15.0 +10.45 .*files: example_controlled_loop.svg" loop ${small_controlled}
    --winds 15 --out example_controlled_loop)
add_example_test(example_controlled_damper nrel5mw_controlled 0 "without damper.*with damper.*files: example_controlled_damper.svg" damper
    ${small_controlled} --duration 3 --out example_controlled_damper)
add_example_test(example_controlled_campbell nrel5mw_controlled 0
    "pitch and torque held.*1st tower fore-aft.*under its controller.*generator azimuth.*motions of states.*files: example_controlled_campbell_open.svg" campbell
    --blade-elements 4 --tower-elements 2 --winds 13,15,18 --out example_controlled_campbell)
# Bad usage.
add_example_test(example_controlled_help nrel5mw_controlled 0 "steps.*loop.*damper" --help)
add_example_test(example_controlled_no_study nrel5mw_controlled 2 "subcommand is required" --variant fast)
add_example_test(example_controlled_wind nrel5mw_controlled 1 "--winds: wind speed .m/s. = 30; allowed: 7 ... 25" steps --winds 30)
add_example_test(example_controlled_words nrel5mw_controlled 1 "--winds: value = 8,x; allowed: wind speeds" steps --winds 8,x)
add_example_test(example_controlled_below nrel5mw_controlled 1 "--winds: wind speed .m/s. = 10; allowed: > 11.4" loop --winds 10)
add_example_test(example_controlled_change nrel5mw_controlled 1 "--change: of the wind .m/s. = 0" loop --change 0)
add_example_test(example_controlled_gain nrel5mw_controlled 1 "--gain: value .N m s/rad. = 0" damper --gain 0)
add_example_test(example_controlled_unwritable nrel5mw_controlled 1 "the folder 'no/such' does not exist" loop ${small_controlled} --out
    no/such/x)
add_example_test(example_controlled_sag nrel5mw_controlled 0 "doubly-fed generator power.*energy lost by the fields.*ok.*start in equilibrium.*ok.*files: example_controlled_sag.h5" sag
    ${small_controlled} --duration 1.6 --out example_controlled_sag)
add_example_test(example_controlled_sag_depth nrel5mw_controlled 1 "depth of a sag = -1; allowed: 0 to 1" sag --depth -1)
