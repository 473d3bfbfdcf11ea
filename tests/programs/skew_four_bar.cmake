add_example_test(example_skew_four_bar skew_four_bar 0 "out of plane, um +26[.]966[89] +26[.]9668.*force, N +-1[.]8566[89][0-9]? +-1[.]85669.*moment, N m +0[.]43822[01] +0[.]438221")
