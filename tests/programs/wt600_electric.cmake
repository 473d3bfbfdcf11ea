# The 600 kW machine with its circuit.
set(small_electric --blade-elements 1 --tower-elements 1)
add_example_test(example_electric_start wt600_electric 0
    "largest.*generator current.*energy lost by the integration.*ok.*energy lost by the fields.*ok.*files: example_electric_start.h5" start ${small_electric}
    --duration 1 --out example_electric_start)
add_example_test(example_electric_loss wt600_electric 0
    "fields, kJ.*start in equilibrium.*ok.*files: example_electric_loss.h5" loss ${small_electric} --duration 2 --out example_electric_loss)
add_example_test(example_electric_sag wt600_electric 0
    "energy lost by the fields.*ok.*files: example_electric_sag.h5" sag ${small_electric} --duration 1.5 --out example_electric_sag)
add_example_test(example_electric_sag_third wt600_electric 0
    "start in equilibrium.*ok.*files: example_electric_third.h5" sag ${small_electric} --order 3 --duration 1.5 --out example_electric_third)
add_example_test(example_electric_sag_first wt600_electric 0
    "start in equilibrium.*ok.*files: example_electric_first.h5" sag ${small_electric} --order 1 --duration 1.5 --out example_electric_first)
add_example_test(example_electric_damping wt600_electric 0
    "steady curve.*fifth order.*30.0.*motions of states.*files: example_electric_damping.svg" damping ${small_electric} --speeds 20,30
    --out example_electric_damping)
add_example_test(example_electric_help wt600_electric 0 "start.*loss.*sag.*damping" --help)
add_example_test(example_electric_no_study wt600_electric 2 "subcommand is required" --blade-elements 1)
add_example_test(example_electric_order wt600_electric 1 "--order: order of the generator's model = 4; allowed: 5, 3 or 1" sag --order 4)
add_example_test(example_electric_depth wt600_electric 1 "depth of a sag = 1.5; allowed: 0 to 1" sag --depth 1.5)
add_example_test(example_electric_speed wt600_electric 1 "--speeds: rotor speed .rpm. = -3" damping --speeds -3)
