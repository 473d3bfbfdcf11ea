set(history ${CMAKE_CURRENT_SOURCE_DIR}/data/history.csv)
add_example_test(example_plot cardan 0 "example_plot.svg, example_plot.png: 2 channels in 2 panels.*fore-aft: -0.2" plot
                 ${history} --channel "tower top*" --from 2 --to 8 --mark 5=half --out example_plot)
add_example_test(example_plot_spectrum cardan 0
    "1 panel\n.*amplitude spectra, 3 segments of 5 s.*side-side: peaks 0.4 Hz = 2P [(]0.1 m[)].*fore-aft: peaks 1.2 Hz" plot
    ${history} --channel "*side-side" --channel "*fore-aft" --together --spectrum --segment 5 --rpm 12 --format svg
    --out example_plot_spectrum)
add_example_test(example_plot_density cardan 0 "power spectral densities, 1 segment of 10.05 s" plot ${history} --channel
                 "rotor speed" --density --linear-trend --max-frequency 3 --radians --format pdf --out
                 example_plot_density)
add_example_test(example_plot_energy cardan 0 "example_plot_energy_energy.svg: energies" plot ${history} --energy --format
                 svg --out example_plot_energy)
add_example_test(example_plot_units cardan 0 "rotor speed: 11.4[0-9]* to 11.9[0-9]* rpm.*pitch: -5.7[0-9]* to 5.7[0-9]* deg" plot
                 ${history} --channel "rotor speed" --channel "blade*" --format svg --out example_plot_units)
add_example_test(example_plot_list cardan 0 "10 channels, 201 samples from 0 to 10 s.*rotor speed .rad s-1." plot ${history}
                 --list)
add_example_test(example_plot_help cardan 0 "--channel" plot --help)
add_example_test(example_plot_unknown_option cardan 2 "--nonsense" plot ${history} --nonsense)
add_example_test(example_plot_no_file_given cardan 2 "file is required" plot --list)
add_example_test(example_plot_no_channels cardan 0 "the usual channels; --list shows all.*svg: [1-9] channels? in" plot ${history} --format svg --out
                 example_plot_no_channels)
add_example_test(example_plot_unknown_channel cardan 1 "channel = 'tower'; allowed: one of 'tower top fore-aft'" plot
                 ${history} --channel tower)
add_example_test(example_plot_no_match cardan 1 "name = gear[*]; allowed: one that matches" plot ${history} --channel "gear*")
add_example_test(example_plot_mark cardan 1 "--mark: value = x=1; allowed: TIME=LABEL" plot ${history} --channel "rotor*"
                 --mark x=1)
add_example_test(example_plot_window cardan 1 "from, to .s. = 20, inf; allowed: two samples at least between 0 and 10" plot
                 ${history} --channel "rotor*" --from 20)
add_example_test(example_plot_no_file cardan 1 "no/such.csv: cannot be read" plot no/such.csv --list)
add_example_test(example_plot_ending cardan 1 "[.]cmake: a history ends in .h5 or .csv" plot ${CMAKE_CURRENT_LIST_FILE} --list)
add_example_test(example_plot_no_time cardan 1 "first column = span_fraction.-.; allowed: time.s." plot
                 ${PROJECT_SOURCE_DIR}/turbines/data/nrel5mw_blade.csv --list)
add_example_test(example_plot_unwritable cardan 1 "the folder 'no/such/folder' does not exist" plot ${history} --channel
                 "rotor*" --out no/such/folder/x)
# A Campbell diagram from its file.
add_example_test(example_plot_diagram cardan 0 "example_plot_diagram.svg: Campbell diagram, [1-9][0-9]* modes" plot example_first_campbell.h5
                 --max-frequency 4 --format svg --out example_plot_diagram)
add_example_test(example_plot_diagram_list cardan 0 "modes at 4 rotor speeds\n.*1st tower fore-aft" plot example_first_campbell.h5 --list)
set_tests_properties(example_plot_diagram example_plot_diagram_list PROPERTIES FIXTURES_REQUIRED first_campbell)
