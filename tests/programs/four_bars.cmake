add_example_test(example_four_bars four_bars 0 "x 0[.]32845[0-9]+, y 0[.]94451[0-9]+, rate -1[.]50664[0-9]+ .by energy -1[.]50664")
add_example_test(example_four_bars_none four_bars 1 "number of windows = 0; allowed: 1 ... 100" 0)
