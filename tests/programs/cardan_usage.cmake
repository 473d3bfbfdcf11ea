# What a command line may be: the shortest ones, what is refused before any work, what options mean without another.
set(models ${CMAKE_CURRENT_SOURCE_DIR}/data)
set(few --blade-elements 1 --tower-elements 1)
add_example_test(usage_alone cardan 2 "^Wind turbines.*Usage: cardan COMMAND.*Examples:.*cardan campbell MODEL --wind 4:24:2 ")
add_example_test(usage_help_alone cardan 0 "Usage: cardan COMMAND" help)

# Speeds and winds in any order, some twice: files are those of the same numbers in order.
set(in_order_wind nrel5mw --no-gravity --harmonics 1 ${few})
add_example_test(usage_wind_in_order cardan 0 "files: usage_wind_in_order[.]h5, .csv, _sections.csv, .svg, .png" steady ${in_order_wind} --wind 8,10 --out
                 usage_wind_in_order)
add_example_test(usage_wind cardan 0 "wind speeds: in rising order, each once: 8, 10 m/s\n.*files: usage_wind[.]h5, .csv, _sections.csv, .svg, .png" steady
                 ${in_order_wind} --wind 10,8,10 --out usage_wind)
add_example_test(usage_rpm_in_order cardan 0 "files" campbell wt600 ${few} --rpm 0,10,20 --out usage_rpm_in_order)
add_example_test(usage_rpm cardan 0 "rotor speeds: in rising order, each once: 0, 10, 20 rpm\n.*files" campbell wt600 ${few} --rpm 20,0:10:10,10
                 --out usage_rpm)
foreach(one IN ITEMS wind rpm)
    set_tests_properties(usage_${one} usage_${one}_in_order PROPERTIES FIXTURES_SETUP usage_${one})
    add_test(NAME usage_${one}_same COMMAND ${CMAKE_COMMAND} -E compare_files usage_${one}_in_order.csv usage_${one}.csv
             WORKING_DIRECTORY ${test_output_dir})
    set_tests_properties(usage_${one}_same PROPERTIES FIXTURES_REQUIRED usage_${one})
endforeach()

# Told before the machine is read: there is none.
function(add_refusal name code says command)
    add_example_test(usage_${name} cardan ${code} "${says}" ${command} no/such.fst ${ARGN})
endfunction()
foreach(command IN ITEMS campbell modes steady simulate linearise flutter)
    if(NOT command STREQUAL "simulate")
        add_refusal(${command}_out 1 "the folder 'no/such' does not exist" ${command} --out no/such/x)
    endif()
    add_refusal(${command}_pitch 1 "--pitch: value = nan; allowed: finite" ${command} --pitch nan)
    add_refusal(${command}_generator_inertia 1 "--generator-inertia: value = -1; allowed: finite and >= 0" ${command} --generator-inertia=-1)
    add_refusal(${command}_blade_damping 1 "--blade-damping: value = -1; allowed: finite and >= 0" ${command} --blade-damping=-1)
    add_refusal(${command}_pitch_stiffness 1 "--pitch-stiffness: value = 0; allowed: finite and > 0" ${command} --pitch-stiffness 0)
endforeach()
foreach(command IN ITEMS campbell modes linearise flutter)
    add_refusal(${command}_max_frequency 1 "--max-frequency: value[^=]*= 0; allowed: finite and > 0" ${command} --max-frequency 0)
endforeach()
foreach(command IN ITEMS campbell steady linearise)
    add_refusal(${command}_wind 1 "--wind: value = 8,x; allowed: numbers and FIRST:LAST:STEP" ${command} --wind 8,x)
    add_refusal(${command}_wind_below 1 "--wind: value .m/s. = -3; allowed: finite and >= 0" ${command} --wind=-3)
    add_refusal(${command}_wind_rpm 1 "--rpm: value = 5; allowed: none beside --wind" ${command} --wind 8 --rpm 5)
    add_refusal(${command}_density 1 "--density: value = 0; allowed: finite and > 0" ${command} --wind 8 --density 0)
    add_refusal(${command}_rated_power 1 "--rated-power: value = -5; allowed: finite and > 0" ${command} --wind 8 --rated-power=-5)
    add_refusal(${command}_schedule 1 "--schedule: file = x.csv; allowed: none beside" ${command} --wind 8 --schedule x.csv --min-rpm 3)
    # Nothing is ignored in silence.
    foreach(option IN ITEMS shear=0.2 density=1.1 no-tower no-skew wake=none rated-power=5000 schedule=x.csv tip-speed-ratio=8)
        string(REGEX REPLACE "=.*" "" name ${option})
        add_refusal(${command}_${name}_alone 2 "--${name}: only with --wind" ${command} --${option})
    endforeach()
endforeach()
add_refusal(campbell_rpm 1 "--rpm: value = 12:0:1; allowed: numbers and FIRST:LAST:STEP separated by commas, rev/min, >= 0" campbell --rpm 12:0:1)
add_refusal(campbell_floquet_alone 2 "--floquet: only with --wind" campbell --floquet)
add_refusal(modes_rpm 1 "--rpm: value = -1; allowed: finite and >= 0" modes --rpm=-1)
add_refusal(steady_stations 1 "--blade-stations: value = 20,x; allowed: numbers separated" steady --blade-stations 20,x)
add_refusal(steady_all 1 "--all: value = given; allowed: none beside --wind" steady --wind 8 --all)
add_refusal(linearise_azimuths 1 "--azimuths: value = 721; allowed: 1 ... 720" linearise --azimuths 721)
add_refusal(flutter_rpm 1 "--rpm: value = 20:10; allowed: FIRST:LAST" flutter --rpm 20:10)
add_example_test(usage_convert_unwritable cardan 1 "the folder 'no/such' does not exist" convert no/such.fst no/such/x.yaml)
# Before the mesh is chosen: beyond the ends of the blade, of a schedule.
file(WRITE ${test_output_dir}/usage_schedule.csv "wind[m/s],rotor_speed[rpm],pitch[deg]\n7,10,0\n9,11,2\n")
add_example_test(usage_schedule_ends cardan 1 "schedule of operation: wind speed .m/s. = 12; allowed: 7 ... 9" steady nrel5mw --wind 12 --schedule
                 usage_schedule.csv)
add_example_test(usage_min_rpm cardan 1 "--min-rpm: minimum rotor speed .rpm. = 20; allowed: at most 12.1" campbell nrel5mw --wind 8 --min-rpm 20)
add_example_test(usage_renamed cardan 1 "note: --least-rpm is --min-rpm now.*--min-rpm: minimum rotor speed .rpm. = 20" campbell nrel5mw --wind 8 --least-rpm=20)

# What is in a model's files and not in the machine is counted, and listed on demand; what the model asks for and does
# not get stands behind the result. Blades with files of their own that are alike are told of once.
add_example_test(usage_notes cardan 0
    "^notes: [1-9][0-9]* entries of 5 files are not used, [0-9]+ (is|are) used otherwise, [0-9]+ (is|are) left out, though the model asks for (it|them); --notes lists them\ndegrees of freedom.*total.*\nleft out, though the model asks for it: [^\n]*FlStTunr.2.[^\n]*; --notes says why\n$" info
    ${models}/openfast/small.fst)
add_example_test(usage_notes_all cardan 0 "note: [^ ]*small_Blade.dat:[0-9]+: FlStTunr.2. = 1.02: tunes.*left out, [^\n]*; see the notes\n$" info
    ${models}/openfast/small.fst --notes)
set(alike ${test_output_dir}/blades_alike)
file(COPY ${models}/openfast/ DESTINATION ${alike})
foreach(number IN ITEMS 2 3)
    configure_file(${models}/openfast/small_Blade.dat ${alike}/small_Blade${number}.dat COPYONLY)
endforeach()
file(READ ${models}/openfast/small_ElastoDyn.dat elastodyn)
foreach(number IN ITEMS 2 3)
    string(REGEX REPLACE "\"small_Blade.dat\"( +BldFile.?${number})" "\"small_Blade${number}.dat\"\\1" elastodyn "${elastodyn}")
endforeach()
file(WRITE ${alike}/small_ElastoDyn.dat "${elastodyn}")
add_example_test(usage_notes_alike cardan 0 "small_Blade.dat:[0-9]+: FlStTunr.2. = 1.02: [^\n]*likewise small_Blade2.dat, small_Blade3.dat" info blades_alike/small.fst
                 --notes)

# Files of OpenFAST's linearisation on demand only.
add_example_test(usage_lin cardan 0 "files: usage_lin.h5, .mat, usage_lin.1.lin ... 4 files" linearise wt600 --rpm 27 --azimuths 4 --order 4 ${few} --lin
                 --out usage_lin)
add_example_test(usage_no_lin cardan 0 "files: usage_no_lin.h5, .mat\n" linearise wt600 --rpm 27 --azimuths 4 --order 4 ${few} --out usage_no_lin)

add_example_test(usage_few_azimuths cardan 1 "number of azimuths = 6; allowed: one at which the rotor of 3 blades stands in 3 different ways .4, 9." linearise
                 nrel5mw --azimuths 6)

# Several results in one picture.
add_example_test(usage_plot_histories cardan 0 "svg: 1 channel in 1 panel\n  first: rotor speed: .*\n  second: rotor speed: " plot first.csv second.csv
                 --channel "rotor speed" --format svg --out usage_plot_histories)
file(WRITE ${test_output_dir}/first.csv "time[s],rotor speed[rad s-1]\n0,1\n1,1.1\n2,1.2\n")
file(WRITE ${test_output_dir}/second.csv "time[s],rotor speed[rad s-1]\n0,1\n1.5,1.3\n3,1.2\n")
add_example_test(usage_plot_winds cardan 0 "usage_plot_winds.svg: operating points at 2 winds" plot usage_wind.h5 usage_wind_in_order.h5 --format svg --out
                 usage_plot_winds)
add_example_test(usage_plot_diagrams cardan 0 "usage_plot_diagrams.svg: Campbell diagram, [0-9]+ modes" plot usage_rpm.h5 usage_rpm_in_order.h5 --format
                 svg --out usage_plot_diagrams)
add_example_test(usage_plot_kinds cardan 1 "first.csv: kind = a history; allowed: a Campbell diagram, as usage_rpm.h5" plot usage_rpm.h5 first.csv)
set_tests_properties(usage_plot_winds PROPERTIES FIXTURES_REQUIRED usage_wind)
set_tests_properties(usage_plot_diagrams usage_plot_kinds PROPERTIES FIXTURES_REQUIRED usage_rpm)

# By name what else would ask for another file, and again from the result.
add_example_test(usage_damping cardan 0 "1st tower fore-aft +[0-9.]+ +[0-9.]+ +2[.]9[0-9]+ " modes wt600 --tower-damping 3 --blades rigid ${few} --out usage_damping)
add_example_test(usage_damping_again cardan 0 "--tower-damping=3 .*1st tower fore-aft +[0-9.]+ +[0-9.]+ +2[.]9[0-9]+ " repeat usage_damping.h5
                 --out usage_damping_again)
set_tests_properties(usage_damping PROPERTIES FIXTURES_SETUP usage_damping)
set_tests_properties(usage_damping_again PROPERTIES FIXTURES_REQUIRED usage_damping)

# Signals, and what is said of long work.
add_test(NAME usage_long_work COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/programs/long_work.sh $<TARGET_FILE:cardan> WORKING_DIRECTORY ${test_output_dir})
# What a shell makes of an empty variable.
add_refusal(empty_rpm 2 "--rpm=: followed by an empty word" simulate --rpm=)
add_refusal(empty_out 2 "--out=: followed by an empty word" modes --out=)
# Numbers in another unit, and those with which everything would be right.
add_example_test(usage_fast_rotor cardan 1 "at 1e[+]06 rpm: tip speed .m/s. = 2[.0-9]+e[+]06; allowed: at most 1000" campbell wt600
                 ${few} --rpm 1e6)
add_example_test(usage_many_turns cardan 1 "pitch .deg. = 1e[+]09; allowed: at most a turn" simulate wt600 --pitch 1e9)
add_refusal(simulate_wind 1 "--wind: value .m/s. = -1; allowed: finite and >= 0" simulate --wind=-1)
add_refusal(simulate_duration 1 "--duration: steps of the output = [0-9.e+]+; allowed: at most 100000000" simulate --duration 1e300)
add_refusal(simulate_out 1 "--out: prefix = [.]; allowed: a path that ends in a file name" simulate --out .)
add_example_test(usage_simulate_stations cardan 1 "blade" simulate wt600 --blade-stations -1)
add_example_test(usage_rated_power_unit cardan 1 "--rated-power KW: value .kW. = 1.5e[+]07; allowed: at most [0-9]+, all that the rotor can take" steady
                 nrel5mw --wind 8 --rated-power 15e6)
add_example_test(usage_no_tolerance cardan 1 "--tolerance: value = 1e[+]10; allowed: > 0, at most 0.1" simulate wt600 --tolerance 1e10)
add_example_test(usage_long_step cardan 1 "--step: value .s. = 5; allowed: at most the duration, 1 s" simulate wt600 ${few} --step 5
                 --duration 1)
# A result is a machine as well; it is not replaced by what is computed from it.
add_example_test(usage_own_input_made cardan 0 "files" modes wt600 ${few} --out usage_own_input)
add_example_test(usage_own_input cardan 1 "file = usage_own_input.h5; allowed: another one than what is read" campbell usage_own_input.h5
                 --out usage_own_input)
set_tests_properties(usage_own_input_made PROPERTIES FIXTURES_SETUP usage_own_input)
set_tests_properties(usage_own_input PROPERTIES FIXTURES_REQUIRED usage_own_input)
