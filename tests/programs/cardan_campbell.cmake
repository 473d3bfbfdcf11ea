# Models of other programs.
set(models ${CMAKE_CURRENT_SOURCE_DIR}/data)
set(coarse --blade-elements 2 --tower-elements 2)
add_example_test(example_openfast cardan 0
    "notes: [0-9]+ entries of 5 files are not used.*1st tower fore-aft.*files: example_openfast.h5.*left out, [^\n]*FlStTunr.2." campbell
    ${models}/openfast/small.fst --out example_openfast)
add_example_test(example_openfast_yaml cardan 0 "degrees of freedom: .*example_openfast.yaml: Fictitious 100 kW machine" convert ${models}/openfast/small.fst
    example_openfast.yaml)
add_example_test(example_openfast_own cardan 0 "1st tower fore-aft.*files" campbell example_openfast.yaml --rpm 45 ${coarse}
                 --out example_openfast_own)
set_tests_properties(example_openfast_yaml PROPERTIES FIXTURES_SETUP own_yaml)
set_tests_properties(example_openfast_own PROPERTIES FIXTURES_REQUIRED own_yaml)
add_example_test(example_elastodyn cardan 0 "note: [^\n]*YawDOF = True: stiffness.*Echo, Method, DT.*1st blade edge" campbell
                 ${models}/openfast/small_ElastoDyn.dat --rpm 0 --gravity --notes --max-frequency 12 ${coarse}
                 --out example_elastodyn)
add_example_test(example_beamdyn cardan 0 "blade 1 pitch inertia[^\n]* 20.*1st blade flap" campbell ${models}/openfast/small_BeamDyn.fst
                 --rpm 0:40:40 --undamped --max-frequency 12 --summary ${coarse} --out example_beamdyn)
add_example_test(example_windio cardan 0 "note: [^\n]*torsional stiffness.*the drive train is rigid.*1st tower" campbell
                 ${models}/windio/small_v1.yaml --rpm 0 --notes ${coarse} --out example_windio)
add_example_test(example_windio_rpm cardan 0 "rotor speed: 0, the model names none.*1st tower" campbell
                 ${models}/windio/small_v2.yaml ${coarse} --out example_windio_rpm)
add_example_test(example_openfast_help cardan 0 "--max-frequency" campbell --help)
add_example_test(example_openfast_no_model cardan 2 "model is required" campbell --rpm 0)
add_example_test(example_openfast_no_file cardan 1 "no/such.fst: cannot be read: No such file" campbell no/such.fst)
add_example_test(example_openfast_not_one cardan 1 "[.]cmake:1: neither a main file of OpenFAST" campbell
                 ${CMAKE_CURRENT_LIST_FILE})
add_example_test(example_openfast_bad_rpm cardan 1 "--rpm: value = 1:x; allowed: numbers and FIRST" campbell ${models}/openfast/small.fst
                 --rpm 1:x)
add_example_test(example_openfast_elements cardan 2 "--blade-elements: Value 0 not in range 1 to 1000" campbell
                 ${models}/openfast/small.fst --blade-elements 0)
add_example_test(example_openfast_unwritable cardan 1 "the folder 'no/such' does not exist" campbell
                 ${models}/openfast/small.fst --rpm 0 --out no/such/x)
add_example_test(example_openfast_save cardan 1 "to: file = example.dat; allowed: one that ends in .yaml" convert
                 ${models}/openfast/small.fst example.dat)
add_example_test(example_openfast_pitched cardan 0 "1st blade flap" campbell ${models}/openfast/small.fst --rpm 45 --pitch 10
                 --max-frequency 12 ${coarse} --out example_openfast_pitched)
add_example_test(example_openfast_gravity cardan 0 "mean over the azimuth.*1st tower fore-aft" campbell
                 ${models}/openfast/small.fst --rpm 0,45 --gravity ${coarse} --out example_openfast_gravity)
# Degrees of freedom of the file, and what replaces them. A locked generator has drive-train torsion of the rotor alone.
file(READ ${models}/openfast/small_ElastoDyn.dat elastodyn)
file(COPY ${models}/openfast/ DESTINATION ${test_output_dir}/locked)
string(REPLACE "True   GenDOF" "False   GenDOF" elastodyn_locked "${elastodyn}")
string(REPLACE "True   YawDOF" "False   YawDOF" elastodyn_locked "${elastodyn_locked}")
file(WRITE ${test_output_dir}/locked/small_ElastoDyn.dat "${elastodyn_locked}")
add_example_test(example_openfast_locked cardan 0 "degrees of freedom: generator locked, yaw bearing locked\n.*drive-train torsion +2[.].*mesh: 2 elements per blade, 2 in the tower; with twice as many no frequency at rest up to [0-9.]+ Hz changes by more than" campbell
                 locked/small.fst --rpm 0,45 ${coarse} --out example_openfast_locked)
add_example_test(example_openfast_locked_yaml cardan 0 "generator locked" convert locked/small.fst example_openfast_locked.yaml)
# The YAML has what the description holds: the generator, the speed.
add_example_test(example_openfast_locked_own cardan 0 "degrees of freedom: generator locked, yaw bearing locked\n.*drive-train torsion +2[.]" campbell
                 example_openfast_locked.yaml ${coarse} --out example_openfast_locked_own)
set_tests_properties(example_openfast_locked_yaml PROPERTIES FIXTURES_SETUP locked_yaml)
set_tests_properties(example_openfast_locked_own PROPERTIES FIXTURES_REQUIRED locked_yaml)
add_example_test(example_openfast_unlocked cardan 0 "degrees of freedom: generator and yaw bearing free\n" campbell locked/small.fst
                 --generator free --yaw free --rpm 45 ${coarse} --out example_openfast_unlocked)
add_example_test(example_openfast_yaw cardan 1 "--yaw: value = free; allowed: locked: the model gives no spring" campbell
                 ${models}/openfast/small_ElastoDyn.dat --yaw free)
add_example_test(example_openfast_one_mode cardan 0 "TwSSDOF2 = False: one mode cannot be switched off.*mode  " campbell
                 ${models}/openfast/small.fst --notes --rpm 0 ${coarse} --out example_openfast_one_mode)
# Products of inertia of the hub.
add_example_test(example_windio_unbalanced cardan 0 "mean over the azimuth.*1st tower fore-aft" campbell
                 ${models}/windio/small_v1.yaml ${coarse} --out example_windio_unbalanced)

file(COPY ${models}/openfast/ DESTINATION ${test_output_dir}/two_blades)
file(READ ${models}/openfast/small_ElastoDyn.dat elastodyn)
string(REPLACE " 3   NumBl" " 2   NumBl" elastodyn "${elastodyn}")
file(WRITE ${test_output_dir}/two_blades/small_ElastoDyn.dat "${elastodyn}")
add_example_test(example_openfast_two_blades cardan 0 "Floquet.*1st blade flap .antisymmetric" campbell two_blades/small.fst
                 --rpm 0,45 ${coarse} --out example_openfast_two_blades)
# Built-in machines have the numbers of their own programs (docs/wt600.md: 0.7129 Hz with other elements).
add_example_test(example_openfast_wt600 cardan 0 "1st tower fore-aft +0.7130 .*1st blade edge .sine. +3.70.*files" campbell wt600 --rpm 0 --blade-elements 3
                 --tower-elements 3 --out example_openfast_wt600)
add_example_test(example_openfast_unknown cardan 1 "machine: name = wt601; allowed: wt600, teetered, " campbell wt601)

# Elements by themselves, additions to a model, and a model that holds everything.
add_example_test(example_openfast_mesh cardan 0
    "rotor speeds: 0 to 54 rpm, 1.2 times 45 rpm .RotSpeed of small_ElastoDyn.dat.*changes by more than 0.[01]" campbell
    ${models}/openfast/small_ElastoDyn.dat --out example_openfast_mesh)
add_example_test(example_windio_set cardan 0 "1st tower fore-aft" campbell ${models}/windio/small_v2.yaml --rpm 0 --set
                 components.hub.elastic_properties.mass=1300 --with ${models}/windio/small_v1.yaml ${coarse} --out example_windio_set)
add_example_test(example_windio_set_what cardan 1 "--set: value = hub; allowed: KEY=VALUE" campbell ${models}/windio/small_v2.yaml
                 --set hub)
add_example_test(example_openfast_with cardan 1 "additions to the machine: value = .*none: it is no model of windIO" campbell
                 ${models}/openfast/small.fst --set a.b=1)
file(COPY ${models}/openfast/ DESTINATION ${test_output_dir}/held)
file(READ ${models}/openfast/small_ElastoDyn.dat elastodyn)
string(REGEX REPLACE "True( +[A-Za-z]+DOF[0-9]?)" "False\\1" elastodyn "${elastodyn}")
file(WRITE ${test_output_dir}/held/small_ElastoDyn.dat "${elastodyn}")
add_example_test(example_openfast_held cardan 0 "switches off all degrees of freedom.*1st blade flap" campbell held/small.fst --rpm 0
                 ${coarse} --out example_openfast_held)
# Names of another result, also through a file that is named from elsewhere.
add_example_test(example_like_base cardan 0 "1st tower fore-aft.*files" campbell ${models}/openfast/small.fst --rpm 0:40:20 ${coarse} --out
                 example_like_base)
add_example_test(example_like cardan 0 "names: those of Fictitious 100 kW machine .example_like_base.h5..*1st tower fore-aft.*files" modes
                 ${models}/openfast/small.fst --rpm 40 --blade-elements 3 --tower-elements 2 --like example_like_base.h5 --out example_like)
add_example_test(example_like_again cardan 0 "--like=/[^ ]*/example_like_base.h5 .*1st tower fore-aft.*files" repeat example_like.h5
                 --out example_like_again)
add_example_test(example_like_speed cardan 1 "number of rotor speeds that both diagrams have = 0" modes ${models}/openfast/small.fst --rpm 41
                 --like example_like_base.h5 ${coarse} --out example_like_speed)
set_tests_properties(example_like_base PROPERTIES FIXTURES_SETUP like_base)
set_tests_properties(example_like example_like_speed PROPERTIES FIXTURES_REQUIRED like_base)
set_tests_properties(example_like PROPERTIES FIXTURES_SETUP like_first)
set_tests_properties(example_like_again PROPERTIES FIXTURES_REQUIRED "like_base;like_first")
# One element per blade: its fourth mode is as much edge as torsion, and one or the other by the wind and from blade to blade.
add_example_test(example_few_elements cardan 0 "mode +8 +10 +12 .*1st tower fore-aft[^\n]*\n1st blade flap .backward.[^\n]*[0-9]" campbell nrel5mw
                 --wind 8,10,12 --blade-elements 1 --tower-elements 1 --max-frequency 3 --out example_few_elements)
