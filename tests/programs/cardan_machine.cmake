# A machine with all that belongs to it, in one file: as our own YAML and in results. What is computed from it is what its
# source gives, to the last digit, wherever it is and whatever has become of the files that were read beside it.
set(models ${CMAKE_CURRENT_SOURCE_DIR}/data)
set(machine_folder ${test_output_dir}/machine)
set(few --blade-elements 2 --tower-elements 1)
file(COPY ${models}/openfast/ ${models}/aerodyn/ DESTINATION ${machine_folder})
file(READ ${models}/openfast/small.fst main)
string(REPLACE "\"unused\"    AeroFile" "\"small_AeroDyn.dat\"    AeroFile" main "${main}")
file(WRITE ${machine_folder}/with_air.fst "${main}")
file(WRITE ${machine_folder}/operation.csv "wind[m/s],rotor_speed[rpm],pitch[deg]\n7,40,1\n9,45,2\n")
file(WRITE ${machine_folder}/gust.csv "time[s],speed[m/s]\n0,8\n0.2,9\n0.5,7\n")

# add_test_in_folder(<name> <what it says> <arguments>...): cardan where the files are.
function(add_test_in_folder name says)
    add_test(NAME ${name}
             COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:cardan> "-DARGUMENTS=${ARGN}" -D CODE=0 "-DSAYS=${says}" -P
                     ${CMAKE_CURRENT_SOURCE_DIR}/run_program.cmake
             WORKING_DIRECTORY ${machine_folder})
endfunction()
# add_same_test(<name> <first> <second> <fixtures>): two files, byte for byte.
function(add_same_test name first second fixtures)
    add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E compare_files ${first} ${second} WORKING_DIRECTORY ${test_output_dir})
    set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED "${fixtures}")
endfunction()

# Converted, then computed.
set(source_openfast machine/with_air.fst)
set(source_windio ${models}/windio/small_v1.yaml)
set(options_steady --wind 8 --rated-power 90 --harmonics 2)
set(options_campbell --wind 8 --rated-power 90 --harmonics 2 --max-frequency 8)
set(options_linearise --wind 8 --rated-power 90 --harmonics 2 --azimuths 8 --lin)
set(options_simulate --wind 8 --duration 0.5 --shear 0.2)
foreach(source IN ITEMS openfast windio)
    add_example_test(example_machine_${source} cardan 0 "machine_${source}.yaml: " convert ${source_${source}} machine_${source}.yaml)
    set_tests_properties(example_machine_${source} PROPERTIES FIXTURES_SETUP machine_${source})
endforeach()
foreach(case IN ITEMS openfast_steady.csv openfast_campbell.csv openfast_linearise.1.lin openfast_simulate.csv windio_steady.csv)
    string(REGEX MATCH "^([a-z]+)_([a-z]+)[.](.*)$" all ${case})
    set(source ${CMAKE_MATCH_1})
    set(command ${CMAKE_MATCH_2})
    set(name example_machine_${source}_${command})
    add_example_test(${name}_model cardan 0 "files" ${command} ${source_${source}} ${options_${command}} ${few} --out ${name}_model)
    add_example_test(${name}_yaml cardan 0 "files" ${command} machine_${source}.yaml ${options_${command}} ${few} --out ${name}_yaml)
    set_tests_properties(${name}_model PROPERTIES FIXTURES_SETUP ${name})
    set_tests_properties(${name}_yaml PROPERTIES FIXTURES_REQUIRED machine_${source} FIXTURES_SETUP ${name})
    if(command STREQUAL "simulate")
        foreach(one IN ITEMS model yaml)
            add_example_test(${name}_${one}_csv cardan 0 "rows of" convert ${name}_${one}.h5 ${name}_${one}.csv)
            set_tests_properties(${name}_${one}_csv PROPERTIES FIXTURES_REQUIRED ${name} FIXTURES_SETUP ${name}_csv)
        endforeach()
    endif()
    add_same_test(${name}_same ${name}_model.${CMAKE_MATCH_3} ${name}_yaml.${CMAKE_MATCH_3} "${name};${name}_csv")
endforeach()
add_example_test(example_machine_without_air cardan 0 "note: without air: the airfoils of the model cannot be read .*unused" convert
                 ${models}/openfast/small.fst machine_without_air.yaml)
add_example_test(example_machine_no_air cardan 1 "--air: value = none, and the airfoils of the model cannot be read .*unused" steady
                 ${models}/openfast/small.fst --wind 8)

# Repeated: a built-in machine in its own air; from another folder, what was read beside the machine.
add_example_test(example_machine_built_in cardan 0 "files" steady nrel5mw --wind 8 --no-gravity --harmonics 1 ${few} --out example_machine_built_in)
add_example_test(example_machine_built_in_again cardan 0 "files" repeat example_machine_built_in.h5 --out example_machine_built_in_again)
set_tests_properties(example_machine_built_in PROPERTIES FIXTURES_SETUP machine_built_in)
set_tests_properties(example_machine_built_in_again PROPERTIES FIXTURES_REQUIRED machine_built_in FIXTURES_SETUP machine_built_in_again)
add_same_test(example_machine_built_in_same example_machine_built_in.csv example_machine_built_in_again.csv
              "machine_built_in;machine_built_in_again")
set(beside small.fst --air small_AeroDyn.dat ${few})
add_test_in_folder(example_machine_beside "as scheduled over the wind, 7 to 9 m/s.*files" steady ${beside} --wind 8 --schedule operation.csv
                   --harmonics 2 --out beside)
add_example_test(example_machine_beside_again cardan 0 "files" repeat machine/beside.h5 --out example_machine_beside_again)
set_tests_properties(example_machine_beside PROPERTIES FIXTURES_SETUP machine_beside)
set_tests_properties(example_machine_beside_again PROPERTIES FIXTURES_REQUIRED machine_beside FIXTURES_SETUP machine_beside_again)
add_same_test(example_machine_beside_same machine/beside.csv example_machine_beside_again.csv "machine_beside;machine_beside_again")
add_test_in_folder(example_machine_gust "files" simulate ${beside} --wind gust.csv --duration 0.5 --out gust)
add_example_test(example_machine_gust_again cardan 0 "--wind=machine/gust.h5 .*files" repeat machine/gust.h5 --out example_machine_gust_again)
add_example_test(example_machine_gust_csv cardan 0 "rows of" convert machine/gust.h5 machine/gust_first.csv)
add_example_test(example_machine_gust_again_csv cardan 0 "rows of" convert example_machine_gust_again.h5 machine/gust_again.csv)
set_tests_properties(example_machine_gust PROPERTIES FIXTURES_SETUP machine_gust)
set_tests_properties(example_machine_gust_again PROPERTIES FIXTURES_REQUIRED machine_gust FIXTURES_SETUP machine_gust_again)
set_tests_properties(example_machine_gust_csv PROPERTIES FIXTURES_REQUIRED machine_gust FIXTURES_SETUP machine_gust_csv)
set_tests_properties(example_machine_gust_again_csv PROPERTIES FIXTURES_REQUIRED machine_gust_again FIXTURES_SETUP machine_gust_csv)
add_same_test(example_machine_gust_same machine/gust_first.csv machine/gust_again.csv machine_gust_csv)
add_example_test(example_machine_schedule_beside cardan 1 "--schedule: file = machine/operation.csv; allowed: none beside --rated-power" steady
                 nrel5mw --wind 8 --schedule machine/operation.csv --rated-power 5000)

# Gone on with from another folder; what differs is named.
set(elsewhere machine/small.fst --air machine/small_AeroDyn.dat ${few} --wind 8 --out machine/resumed)
add_test_in_folder(example_machine_begun "files" simulate ${beside} --wind 8 --duration 0.2 --out resumed)
add_example_test(example_machine_resumed cardan 0 "resumed.h5 .21 samples" simulate ${elsewhere} --duration 0.4 --resume)
add_example_test(example_machine_resumed_other cardan 1 "--resume: run of machine/resumed.h5 = wind 8; allowed: that of this run: wind 9" simulate
                 machine/small.fst --air machine/small_AeroDyn.dat ${few} --wind 9 --out machine/resumed --duration 0.6 --resume)
set_tests_properties(example_machine_begun PROPERTIES FIXTURES_SETUP machine_begun)
set_tests_properties(example_machine_resumed PROPERTIES FIXTURES_REQUIRED machine_begun FIXTURES_SETUP machine_resumed)
set_tests_properties(example_machine_resumed_other PROPERTIES FIXTURES_REQUIRED "machine_begun;machine_resumed")
