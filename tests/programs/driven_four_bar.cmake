add_example_test(example_driven_four_bar driven_four_bar 0 "A y, N +-1[.]0968280[0-9] +-1[.]0968280[0-9].*M, N m +0[.]1579360[0-9] +0[.]1579360[0-9].*whole revolution: [0-9.]+e-(09|1[0-9]) N")
add_example_test(example_driven_four_bar_fast driven_four_bar 0 "whole revolution: [0-9.]+e-(0[6-9]|1[0-9]) N" --speed=200 --out=driven_four_bar_fast.png)
