add_example_test(example_squeezer squeezer 0 "beta +15[.]810771[12][0-9] +15[.]81077119.*Theta +-15[.]7563710[0-9] +-15[.]75637105.*epsilon +1[.]048080[67][0-9] +1[.]04808074")
add_example_test(example_squeezer_tolerance squeezer 1 "--tolerance: value = -1; allowed: finite and > 0" --tolerance=-1)
