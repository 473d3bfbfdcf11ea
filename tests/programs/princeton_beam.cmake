add_example_test(example_princeton_beam princeton_beam 0 "13.345 N at 30 deg: side, mm +117[.]8[0-9]+ +117[.]9016.*twist, mrad +45[.][678][0-9]+ +45[.]8706")
