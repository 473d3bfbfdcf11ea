# Models of windIO as most public files are: without the masses of hub and nacelle, which design programs compute.
set(bare ${CMAKE_CURRENT_SOURCE_DIR}/data/windio/bare_v2.yaml)
set(few --blade-elements 2 --tower-elements 2)
set(masses --set components.hub.elastic_properties.mass=18000 --set components.drivetrain.elastic_properties.mass=80000)
set(lacks "the model lacks: mass of the hub; mass of nacelle and drive train; remedy: --set components[.]hub[.]elastic_properties[.]mass=MASS_kg --set components[.]drivetrain[.]elastic_properties[.]mass=MASS_kg\n$")
# Cantilevers by hand: 0.4874 and 0.9748, 0.5519 Hz (beta L = 1.875104).
add_example_test(example_windio_info cardan 0
    "rotor +80 m.*hub height +80 m.*rated power +2170[.]37 kW on the rotor.*tip speed +8 times.*blade 1 +6930.*tower +195000.*blade 1 clamped[^\n]*\n +0[.]4874 0[.]9748.*tower clamped[^\n]*\n +0[.]5519 0[.]5519.*${lacks}"
    info ${bare})
add_example_test(example_windio_modes cardan 0
    "isolated blade.*clamped at its root.*0[.]0 rpm +19[.]1 rpm.*1st blade flap +0[.]48.*tower alone.*without what it carries.*1st tower fore-aft +0[.]55.*modes of the parts only: ${lacks}"
    modes ${bare} ${few})
foreach(command IN ITEMS campbell steady linearise simulate)
    add_example_test(example_windio_${command} cardan 1 "cardan ${command}: [^ ]*bare_v2[.]yaml: fictitious machine without masses: ${lacks}" ${command} ${bare})
endforeach()
add_example_test(example_windio_convert cardan 1 "${lacks}" convert ${bare} example_windio.yaml)
add_example_test(example_windio_no_power cardan 1 "--rated-power KW: value = none, and the model names none; allowed: power of the air.*--schedule" steady ${bare}
                 ${masses} --set assembly.rated_power=0 --wind 8 ${few})
add_example_test(example_windio_no_speed cardan 1 "--rated-rpm: value = none, and the model names none; allowed: speed of the rotor" steady
                 ${bare} ${masses} --set control.torque.VS_maxspd=0 --set control.supervisory.maxTS=0 --wind 8 ${few})
# With the masses all works as it is typed: 8 x 8 / 40 rad/s.
add_example_test(example_windio_wind cardan 0
    "operation: tip-speed ratio 8[.]000, 8 to 19[.]0986 rpm, pitch -1 deg; 2170[.]37 kW on the rotor from rated wind on [(]bare_v2[.]yaml[)].*8[.]000 +15[.]2789 "
    steady ${bare} ${masses} --wind 8 --no-gravity --harmonics 2 ${few} --out example_windio_wind)
add_example_test(example_windio_whole cardan 0 "1st tower fore-aft.*files: example_windio_whole" modes ${bare} ${masses} ${few}
                 --out example_windio_whole)
