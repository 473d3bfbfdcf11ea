add_example_test(example_bricard bricard 0 "5 equations of rank 4.*after 2[.]4958557[0-9]+ s .reference 2[.]495855757.*energy -29[.]4300000")
