set(history ${CMAKE_CURRENT_SOURCE_DIR}/data/history.csv)
add_example_test(example_plot plot_history 0 "example_plot.svg, example_plot.png: 2 channels in 2 panels.*fore-aft: -0.2"
                 ${history} --channel "tower top*" --from 2 --to 8 --mark 5=half --out example_plot)
add_example_test(example_plot_spectrum plot_history 0
    "1 panel\n.*amplitude spectra, 3 segments of 5 s.*side-side: peaks 0.4 Hz = 2P [(]0.1 m[)].*fore-aft: peaks 1.2 Hz"
    ${history} --channel "*side-side" --channel "*fore-aft" --together --spectrum --segment 5 --rpm 12 --format svg
    --out example_plot_spectrum)
add_example_test(example_plot_density plot_history 0 "power spectral densities, 1 segment of 10.05 s" ${history} --channel
                 "rotor speed" --density --linear-trend --max-frequency 3 --radians --format pdf --out
                 example_plot_density)
add_example_test(example_plot_energy plot_history 0 "example_plot_energy_energy.svg: energies" ${history} --energy --format
                 svg --out example_plot_energy)
add_example_test(example_plot_units plot_history 0 "rotor speed: 11.4[0-9]* to 11.9[0-9]* rpm.*pitch: -5.7[0-9]* to 5.7[0-9]* deg"
                 ${history} --channel "rotor speed" --channel "blade*" --format svg --out example_plot_units)
add_example_test(example_plot_list plot_history 0 "10 channels, 201 samples from 0 to 10 s.*rotor speed .rad s-1." ${history}
                 --list)
add_example_test(example_plot_help plot_history 0 "--channel" --help)
add_example_test(example_plot_unknown_option plot_history 2 "--nonsense" ${history} --nonsense)
add_example_test(example_plot_no_file_given plot_history 2 "file is required" --list)
add_example_test(example_plot_no_channels plot_history 1 "--channel: channels = none; allowed: at least one" ${history})
add_example_test(example_plot_unknown_channel plot_history 1 "channel = 'tower'; allowed: one of 'tower top fore-aft'"
                 ${history} --channel tower)
add_example_test(example_plot_no_match plot_history 1 "name = gear[*]; allowed: one that matches" ${history} --channel "gear*")
add_example_test(example_plot_mark plot_history 1 "--mark: value = x=1; allowed: TIME=LABEL" ${history} --channel "rotor*"
                 --mark x=1)
add_example_test(example_plot_window plot_history 1 "from, to .s. = 20, inf; allowed: two samples at least between 0 and 10"
                 ${history} --channel "rotor*" --from 20)
add_example_test(example_plot_no_file plot_history 1 "no/such.csv: cannot be read" no/such.csv --list)
add_example_test(example_plot_ending plot_history 1 "[.]cmake: a history ends in .h5 or .csv" ${CMAKE_CURRENT_LIST_FILE} --list)
add_example_test(example_plot_no_time plot_history 1 "first column = span_fraction.-.; allowed: time.s."
                 ${PROJECT_SOURCE_DIR}/turbines/data/nrel5mw_blade.csv --list)
add_example_test(example_plot_unwritable plot_history 1 "the folder 'no/such/folder' does not exist" ${history} --channel
                 "rotor*" --out no/such/folder/x)
